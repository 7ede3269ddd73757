// Teaches the page a steering wheel: it watches which axis moves most while the person moves one thing at a time.
import { element } from "../dom";
import { connectedPads, keepCalibration } from "./gamepad";
import type { Calibration, Pedal } from "./gamepad";
import { figure } from "./gauge";

interface Watched {
  readonly kind: "axis" | "button";
  readonly index: number;
  now: number;
  low: number;
  high: number;
}

const tasks = [
  "Turn the wheel all the way to both sides. Then hold it all the way to the left.",
  "Let the wheel stand straight ahead.",
  "Press the throttle all the way a few times. Then hold it down.",
  "Press the brake all the way a few times. Then hold it down.",
] as const;
const enough = 0.2; // an axis that moved less than this was not meant

const reach = (one: Watched): number => one.high - one.low;
const farEnd = (one: Watched): number => (one.now - one.low > one.high - one.now ? one.low : one.high);
const nameOf = ({ kind, index }: Watched): string => `${kind} ${index + 1}`;

function watch(pad: Gamepad): Watched[] {
  const one = (kind: Watched["kind"], index: number, now: number): Watched => ({
    kind,
    index,
    now,
    low: now,
    high: now,
  });
  return [
    ...pad.axes.map((value, i) => one("axis", i, value)),
    ...pad.buttons.map((button, i) => one("button", i, button.value)),
  ];
}

function look(pad: Gamepad, watched: readonly Watched[]): void {
  for (const one of watched) {
    one.now = (one.kind === "axis" ? pad.axes[one.index] : pad.buttons[one.index]?.value) ?? one.now;
    one.low = Math.min(one.low, one.now);
    one.high = Math.max(one.high, one.now);
  }
}

class Lesson {
  private readonly task = element("p", { class: "task" });
  private readonly heard = element("output", { class: "heard" });
  private readonly next = element("button", { type: "button", onclick: () => this.learn() }, "Next");
  private readonly cancel = element("button", { type: "button", onclick: () => this.end() }, "Cancel");
  private readonly dialog = element(
    "dialog",
    { class: "live-dialog", "aria-labelledby": "lesson-title" },
    element("h2", { id: "lesson-title" }, "Set up wheel and pedals"),
    this.task,
    this.heard,
    element("p", { class: "row" }, this.next, this.cancel),
  );
  private step = 0;
  private watched: Watched[] = [];
  private steer: Watched | null = null;
  private left = 0;
  private right = 0;
  private straight = 0;
  private throttle: Pedal | null = null;

  constructor(
    private readonly host: HTMLElement,
    private readonly done: () => void,
  ) {
    this.host.append(this.dialog);
    this.dialog.onclose = () => this.end();
    this.dialog.showModal();
    this.begin(0);
    this.follow();
  }

  // The one that moves is the one that counts; a browser shows a controller only after it was touched.
  private get pad(): Gamepad | null {
    return connectedPads()[0] ?? null;
  }

  private begin(step: number): void {
    this.step = step;
    this.watched = this.pad ? watch(this.pad) : [];
    this.task.textContent = `${step + 1} of ${tasks.length}. ${tasks[step] ?? ""}`;
  }

  private follow(): void {
    if (!this.dialog.open) return;
    const pad = this.pad;
    if (pad && this.watched.length === 0) this.watched = watch(pad);
    if (pad) look(pad, this.watched);
    const moved = this.moved();
    this.next.disabled = moved === null;
    this.heard.textContent = !pad
      ? "No controller yet: connect it and press one of its buttons."
      : moved
        ? `${nameOf(moved)}: ${figure(moved.now, 2)}`
        : "Waiting for it to move…";
    requestAnimationFrame(() => this.follow());
  }

  private moved(): Watched | null {
    if (this.step === 1) return this.watched.find((one) => this.steers(one)) ?? null;
    const candidates = this.watched.filter(
      (one) => reach(one) > enough && (this.step === 0 ? one.kind === "axis" : !this.taken(one)),
    );
    return candidates.reduce<Watched | null>((best, one) => (best && reach(best) >= reach(one) ? best : one), null);
  }

  private steers({ kind, index }: Watched): boolean {
    return kind === "axis" && index === this.steer?.index;
  }

  private taken(one: Watched): boolean {
    return this.steers(one) || (this.throttle?.kind === one.kind && this.throttle.index === one.index);
  }

  private learn(): void {
    const moved = this.moved();
    if (!moved) return;
    const pedal: Pedal = { kind: moved.kind, index: moved.index, released: farEnd(moved), pressed: moved.now };
    if (this.step === 0) {
      this.steer = moved;
      this.left = moved.now;
      this.right = farEnd(moved);
    } else if (this.step === 1) {
      this.straight = moved.now;
    } else if (this.step === 2) {
      this.throttle = pedal;
    } else {
      this.keep(pedal);
      return this.end();
    }
    this.begin(this.step + 1);
  }

  private keep(brake: Pedal): void {
    if (!this.pad || !this.steer || !this.throttle) return;
    // Someone who did not center the wheel gets the middle.
    const between = (this.straight - this.left) * (this.straight - this.right) < 0;
    const straight = between ? this.straight : (this.left + this.right) / 2;
    const steer: Calibration["steer"] = { axis: this.steer.index, left: this.left, straight, right: this.right };
    keepCalibration(this.pad, { steer, throttle: this.throttle, brake });
    this.done();
  }

  private end(): void {
    this.dialog.onclose = null;
    this.dialog.close();
    this.dialog.remove();
  }
}

export function calibrate(host: HTMLElement, done: () => void): void {
  new Lesson(host, done);
}
