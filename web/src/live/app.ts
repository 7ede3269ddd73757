// Connects wire, hands, picture and instruments.
import { element } from "../dom";
import type { CameraMode } from "../scene/camera";
import type { Stage } from "../scene/stage";
import { Aids } from "./aids";
import { calibrate } from "./calibration";
import { Controls } from "./controls";
import { Dashboard } from "./dashboard";
import { Feedback } from "./feedback";
import type { LiveFrame } from "./frame";
import { Metronome } from "./gauge";
import { offerHooks } from "./hooks";
import { Identity } from "./identity";
import { Latency } from "./latency";
import { liveAddress } from "./link";
import type { LinkState } from "./link";
import { MachineLine } from "./machine";
import { Menu } from "./menu";
import type { Part } from "./menu";
import { Notices } from "./notice";
import { Picture } from "./picture";
import type { CarMessage, ClientMessage, InputMessage, Status } from "../contract";
import { ResultCard } from "./result";
import { Session } from "./session";
import { roleText, situation } from "./situation";
import { Strip } from "./strip";
import { Toolbar } from "./toolbar";
import { WheelTable } from "./wheels";

const patience = 8000; // with a lost connection [ms]

export class App {
  private readonly picture: Picture;
  private readonly latency = new Latency();
  private readonly metronome = new Metronome();
  private readonly identity = new Identity(() => this.send({ type: "take" }));
  private readonly aids = new Aids((aid, on) => this.send({ type: "switch", aid, on }));
  private readonly dashboard = new Dashboard(() => this.controls.nextSelector(), this.aids.root);
  private readonly wheels = new WheelTable();
  private readonly machine = new MachineLine();
  private readonly strip = new Strip();
  private readonly feedback = new Feedback(() => (this.session.role === "driver" ? this.controls.pad : null));
  private readonly result = new ResultCard(() => this.reset());
  private readonly notices = new Notices(this.result.root);
  private readonly toolbar: Toolbar;
  private readonly menu: Menu;
  private readonly controls: Controls;
  private readonly session: Session;
  private lostFor: ReturnType<typeof setTimeout> | undefined;
  private given = false;
  private drawnAt = performance.now();
  private textsTime = NaN; // of the frame that the texts show [s]

  constructor(
    private readonly host: HTMLElement,
    private readonly view: HTMLElement,
    stage: Stage | null,
  ) {
    this.picture = new Picture(stage);
    this.toolbar = this.makeToolbar();
    this.menu = this.makeMenu();
    this.controls = this.makeControls();
    this.session = this.makeSession();
    this.assemble();
    if (!stage) this.notices.say("This browser shows no 3D pictures (WebGL); the instruments work.");
  }

  run(): void {
    this.showSituation();
    this.menu.showFeedback(this.feedback.on);
    offerHooks(this.session, this.picture, this.latency, () => this.textsTime);
    this.view.focus({ preventScroll: true });
    requestAnimationFrame((now) => this.draw(now));
  }

  private assemble(): void {
    const { identity, dashboard, wheels, machine, strip, notices, toolbar, menu, controls } = this;
    const panels = [identity, toolbar, strip, dashboard, wheels, machine].map((panel) => panel.root);
    this.host.append(element("div", { class: "instruments" }, ...panels), controls.touch.root, menu.root, notices.root);
    // After a click driving goes on; who came by the tab key stays.
    this.host.addEventListener("click", ({ target, detail }) => {
      const button = detail > 0 && target instanceof Element ? target.closest("button") : null;
      if (button && !button.closest("dialog")) this.backToView();
    });
    addEventListener("touchstart", () => this.host.classList.add("touched"), { once: true, passive: true });
  }

  private makeToolbar(): Toolbar {
    return new Toolbar({
      reset: () => this.reset(),
      pause: (on) => this.send({ type: "pause", on }),
      record: (on) => this.send({ type: "record", on }),
      chooseCamera: (mode) => this.chooseCamera(mode),
      toggleMenu: () => this.toggleMenu(),
    });
  }

  private makeMenu(): Menu {
    const roomy = matchMedia("(min-width: 900px)").matches;
    return new Menu(
      {
        load: (course) => this.send({ type: "load", ...course }),
        setPace: (factor) => this.send({ type: "pace", factor }),
        show: (part, on) => this.showPart(part, on),
        calibrate: () => calibrate(this.host, () => this.controls.forgetCalibrations()),
        setFeedback: (on) => this.setFeedback(on),
        closed: () => {
          this.toolbar.showMenu(false);
          this.backToView();
        },
      },
      roomy,
    );
  }

  private makeControls(): Controls {
    return new Controls({
      send: (input) => this.sendInput(input),
      pressed: (sequence, at) => this.pressed(sequence, at),
      speed: () => this.speed(),
      say: (message) => this.notices.say(message),
      engaged: () => this.dashboard.gear.engaged,
      shifted: (selector) => this.dashboard.gear.select(selector),
      reset: () => this.reset(),
      togglePause: () => this.send({ type: "pause", on: this.session.status?.paused !== "driver" }),
      chooseCamera: (mode) => this.chooseCamera(mode),
      switchAid: (number) => this.aids.pressNumber(number),
      toggleFeedback: () => this.setFeedback(!this.feedback.on),
      toggleMenu: () => this.toggleMenu(),
      closePanels: () => this.menu.close(),
    });
  }

  private makeSession(): Session {
    return new Session(liveAddress(location), {
      linkChanged: (state) => this.linkChanged(state),
      greeted: (hello) => this.menu.course.greet(hello),
      carChanged: (car, frame) => this.carChanged(car, frame),
      frameArrived: (bytes) => this.feedback.receive(bytes),
      tileArrived: (tile) => this.picture.addTile(tile),
      courseEnded: ({ course }, result) => this.result.show(course?.title ?? "", result),
      statusChanged: (status) => this.statusChanged(status),
      refused: (message) => this.notices.say(message),
    });
  }

  private linkChanged(state: LinkState): void {
    clearTimeout(this.lostFor);
    this.given = false;
    if (state === "lost") {
      this.lostFor = setTimeout(() => {
        this.given = true;
        this.showSituation();
      }, patience);
    }
    this.latency.forget();
    this.showSituation();
  }

  private carChanged(car: CarMessage, frame: LiveFrame): void {
    this.picture.setCar(car, frame);
    this.dashboard.setCar(car, frame);
    this.aids.setCar(car, frame);
    this.wheels.setCar(car.scene, frame);
    this.strip.setCar(frame);
    this.feedback.setCar(car);
    this.menu.course.show(car);
    this.controls.setDriveline(car.driveline ?? null);
    this.result.hide();
    this.latency.forget();
    this.textsTime = NaN;
    this.identity.showCar(car);
  }

  private statusChanged(status: Status): void {
    if (status.paused !== "") this.latency.forget();
    this.machine.showStatus(status);
    this.toolbar.showStatus(status);
    this.aids.showStatus(status);
    this.menu.showPace(status.pace);
    this.showSituation();
  }

  private showSituation(): void {
    const { linkState, status, role } = this.session;
    const { title, text, dims } = situation(linkState, this.given, status, role);
    this.notices.show(title, text, dims);
    this.identity.showRole(roleText(status, role), status !== null && role === "nobody");
  }

  private showPart(part: Part, on: boolean): void {
    if (part === "curves") this.strip.shown = on;
    else if (part === "wheels") this.wheels.root.hidden = !on;
    else if (part === "machine") this.machine.root.hidden = !on;
    else this.picture.show(part, on);
  }

  private send(message: ClientMessage): void {
    this.session.send(message);
  }

  private sendInput(input: InputMessage): void {
    if (this.session.role !== "watcher") this.send(input);
  }

  // Who steers a car that nobody drives wants to drive it.
  private pressed(sequence: number, at: number): void {
    if (this.session.status?.driver === 0) this.send({ type: "take" });
    else if (this.session.role === "driver" && this.session.running) this.latency.pressed(sequence, at);
  }

  private reset(): void {
    this.controls.restart();
    this.result.hide();
    this.send({ type: "reset" });
  }

  private chooseCamera(mode: CameraMode): void {
    this.picture.camera = mode;
    this.toolbar.showCamera(mode);
    this.backToView();
  }

  private setFeedback(on: boolean): void {
    this.feedback.on = on;
    this.menu.showFeedback(on);
    this.notices.say(on ? "Force feedback is on." : "Force feedback is off.");
  }

  private toggleMenu(): void {
    if (this.menu.open) return this.menu.close();
    this.menu.open = true;
    this.toolbar.showMenu(true);
  }

  private backToView(): void {
    this.view.focus({ preventScroll: true });
  }

  private draw(now: number): void {
    requestAnimationFrame((next) => this.draw(next));
    this.controls.poll();
    const fresh = this.session.takeFrame();
    const frame = this.session.frame;
    if (fresh && frame) this.picture.move(frame);
    this.picture.draw((now - this.drawnAt) / 1000, fresh);
    this.drawnAt = now;
    if (!frame) return;
    if (fresh) this.follow(frame);
    if (this.textsTime !== frame.time || fresh) this.showFrame(frame, now);
  }

  private follow(frame: LiveFrame): void {
    if (frame.page === this.session.hello?.page) this.latency.drawn(frame.sequence, performance.now());
    document.documentElement.dataset["ready"] = "true";
    this.strip.add(frame.time);
    this.result.follow(frame.time);
  }

  // Texts wait for their turn, and have it also where no further frame comes.
  private showFrame(frame: LiveFrame, now: number): void {
    const texts = this.metronome.ticks(now);
    this.dashboard.show(texts);
    this.aids.show(frame.time);
    this.wheels.show(texts);
    if (!texts) return;
    this.strip.draw();
    this.machine.showLatency(this.latency);
    this.textsTime = frame.time;
  }

  private speed(): number {
    return this.session.frame?.reader("longitudinal_velocity")() ?? NaN;
  }
}
