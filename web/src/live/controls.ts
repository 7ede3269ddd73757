// One driver out of keys, controllers and glass: whoever moved last drives.
import { Keys } from "./keys";
import type { KeyListener } from "./keys";
import { Pads } from "./gamepad";
import { apart, letGo } from "./held";
import type { Held } from "./held";
import type { InputMessage } from "./protocol";
import { TouchControls } from "./touch";

const heartbeat = 90; // the program hears from its driver at least every 100 ms
const standstill = 0.5; // [m/s]
const meant = 0.05; // a controller that moves less than this only trembles

export interface Cockpit extends Omit<KeyListener, "held" | "toggleReverse"> {
  send(input: InputMessage): void;
  pressed(sequence: number, at: number): void; // an input a person gave at that time [ms] has this number
  shifted(reverse: boolean): void;
  speed(): number; // [m/s]
  say(message: string): void;
}

type Source = "keys" | "pads" | "touch";

export class Controls {
  readonly touch: TouchControls;
  private reverse = false;
  private readonly keys: Keys;
  private readonly pads: Pads;
  private source: Source = "keys";
  private padsAtRest: Held = letGo;
  private sequence = 0;
  private sent: Held = letGo;
  private hands: Held = letGo;

  constructor(private readonly cockpit: Cockpit) {
    this.keys = new Keys({
      ...cockpit,
      held: (at, press) => this.use("keys", at, press),
      toggleReverse: () => this.toggleReverse(),
    });
    this.touch = new TouchControls((at, press) => this.use("touch", at, press));
    this.pads = new Pads((command) => this.padCommand(command));
    setInterval(() => this.send(), heartbeat);
    addEventListener("blur", () => this.release());
    document.addEventListener("visibilitychange", () => document.hidden && this.release());
  }

  get held(): Held {
    return this.hands;
  }

  // Once a picture: controllers do not tell when they move.
  poll(): void {
    const elsewhere = document.hidden || !document.hasFocus() || document.querySelector("dialog[open]") !== null;
    if (elsewhere) {
      if (this.source === "pads" && apart(this.hands, letGo) > 0) this.release();
      return;
    }
    this.pads.poll();
    const moved = apart(this.pads.held, this.padsAtRest) > meant;
    if (moved) this.padsAtRest = this.pads.held;
    if (moved || this.source === "pads") this.use("pads", performance.now(), false);
  }

  forgetCalibrations(): void {
    this.pads.forgetCalibrations();
  }

  release(): void {
    this.keys.release();
    this.hands = letGo;
    this.send();
  }

  toggleReverse(): void {
    if (!this.reverse && this.cockpit.speed() > standstill) return this.cockpit.say("Reverse goes in at a standstill.");
    if (this.reverse && this.cockpit.speed() < -standstill) return this.cockpit.say("Forward goes in at a standstill.");
    this.shift(!this.reverse);
  }

  forward(): void {
    if (this.reverse) this.shift(false);
  }

  private shift(reverse: boolean): void {
    this.reverse = reverse;
    this.cockpit.shifted(reverse);
    this.send();
  }

  private padCommand(command: "reverse" | "reset" | "pause"): void {
    if (command === "reverse") this.toggleReverse();
    else if (command === "reset") this.cockpit.reset();
    else this.cockpit.togglePause();
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
    const device = this.source === "keys" ? "keys" : "axes";
    this.cockpit.send({ type: "input", sequence: this.sequence, device, ...this.hands, reverse: this.reverse });
  }
}
