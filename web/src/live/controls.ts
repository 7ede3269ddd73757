// One driver out of keys, controllers and glass: whoever moved last drives.
import { Keys } from "./keys";
import type { KeyListener } from "./keys";
import { Pads } from "./gamepad";
import type { PadCommand } from "./gamepad";
import { apart, letGo } from "./held";
import type { Held } from "./held";
import type { Driveline, InputMessage } from "../contract";
import { Shifter } from "./shifter";
import type { ShifterListener } from "./shifter";
import { TouchControls } from "./touch";

const heartbeat = 90; // the program hears from its driver at least every 100 ms
const meant = 0.05; // a controller that moves less than this only trembles

type GearKey = "toggleReverse" | "nextSelector" | "shift";

export interface Cockpit extends Omit<KeyListener, "held" | GearKey>, ShifterListener {
  send(input: InputMessage): void;
  pressed(sequence: number, at: number): void; // an input a person gave at that time [ms] has this number
}

type Source = "keys" | "pads" | "touch";

export class Controls {
  readonly touch: TouchControls;
  private readonly shifter: Shifter;
  private readonly keys: Keys;
  private readonly pads: Pads;
  private source: Source = "keys";
  private padsAtRest: Held = letGo;
  private sequence = 0;
  private sent: Held = letGo;
  private hands: Held = letGo;

  constructor(private readonly cockpit: Cockpit) {
    this.shifter = new Shifter({
      ...cockpit,
      shifted: (selector) => {
        cockpit.shifted(selector);
        this.send();
      },
    });
    this.keys = new Keys({
      ...cockpit,
      held: (at, press) => this.use("keys", at, press),
      toggleReverse: () => this.shifter.toggleReverse(),
      nextSelector: () => this.nextSelector(),
      shift: (by) => this.shift(by),
    });
    this.touch = new TouchControls(
      (at, press) => this.use("touch", at, press),
      (by) => this.shift(by),
    );
    this.pads = new Pads((command) => this.padCommand(command));
    setInterval(() => this.send(), heartbeat);
    addEventListener("blur", () => this.release());
    document.addEventListener("visibilitychange", () => document.hidden && this.release());
  }

  get held(): Held {
    return this.hands;
  }

  // The controller that drives: not one that lies there while keys do.
  get pad(): Gamepad | null {
    return this.source === "pads" && !this.elsewhere ? this.pads.pad : null;
  }

  // Once a picture: controllers do not tell when they move.
  poll(): void {
    if (this.elsewhere) {
      if (this.source === "pads" && apart(this.hands, letGo) > 0) this.release();
      return;
    }
    this.pads.poll();
    const moved = apart(this.pads.held, this.padsAtRest) > meant;
    if (moved) this.padsAtRest = this.pads.held;
    if (moved || this.source === "pads") this.use("pads", performance.now(), false);
  }

  private get elsewhere(): boolean {
    return document.hidden || !document.hasFocus() || document.querySelector("dialog[open]") !== null;
  }

  forgetCalibrations(): void {
    this.pads.forgetCalibrations();
  }

  release(): void {
    this.keys.release();
    this.hands = letGo;
    this.send();
  }

  nextSelector(): void {
    this.shifter.next();
  }

  setDriveline(driveline: Driveline | null): void {
    this.touch.shifts = (driveline?.gears ?? 1) > 1;
    this.shifter.setDriveline(driveline);
  }

  // The car is back at its start.
  restart(): void {
    this.shifter.restart();
  }

  private shift(by: 1 | -1): void {
    if (by > 0) this.shifter.up();
    else this.shifter.down();
  }

  private padCommand(command: PadCommand): void {
    const does: Readonly<Record<PadCommand, () => void>> = {
      up: () => this.shift(1),
      down: () => this.shift(-1),
      next: () => this.nextSelector(),
      reverse: () => this.shifter.toggleReverse(),
      reset: () => this.cockpit.reset(),
      pause: () => this.cockpit.togglePause(),
    };
    does[command]();
  }

  private use(source: Source, at: number, press: boolean): void {
    this.source = source;
    this.hands = this[source].held;
    if (apart(this.hands, this.sent) === 0) return;
    this.send();
    if (press) this.cockpit.pressed(this.sequence, at);
  }

  private send(): void {
    this.sent = this.hands;
    this.sequence += 1;
    const { sequence } = this;
    const device = this.source === "keys" ? "keys" : "axes";
    const { steer, throttle, brake, clutch } = this.hands;
    this.cockpit.send({ type: "input", sequence, device, steer, throttle, brake, ...this.shifter.wanted(clutch) });
  }
}
