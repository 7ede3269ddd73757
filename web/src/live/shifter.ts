// Selector and gears as the person wants them. A car without a driveline knows ahead and back alone.
import type { Driveline, InputMessage, Selector } from "../contract";

const standstill = 0.5; // [m/s]

export interface ShifterListener {
  speed(): number; // [m/s]
  engaged(): number; // gear that is in: -1 reverse, 0 neutral, 1 ...; NaN: not known
  say(message: string): void;
  shifted(selector: Selector): void;
}

export type Wanted = Pick<InputMessage, "reverse" | "selector" | "gear" | "clutch">;

export class Shifter {
  selector: Selector = "drive";
  private gear = 1;
  private driveline: Driveline | null = null;

  constructor(private readonly listener: ShifterListener) {}

  // clutch: the pedal, 0 to 1
  wanted(clutch: number): Wanted {
    const { selector, gear, driveline } = this;
    const reverse = selector === "reverse";
    if (driveline === null) return { reverse };
    return { reverse, selector, gear: selector === "manual" ? gear : 1, clutch: driveline.clutch ? clutch : 0 };
  }

  setDriveline(driveline: Driveline | null): void {
    this.driveline = driveline;
    this.put("drive", 1);
  }

  // The car is back at its start.
  restart(): void {
    this.put(this.selector === "manual" ? "manual" : "drive", 1);
  }

  toggleReverse(): void {
    this.select(this.selector === "reverse" ? "drive" : "reverse");
  }

  // What may not go in now is passed over.
  next(): void {
    if (this.driveline === null) return this.toggleReverse();
    const all: readonly Selector[] = ["drive", ...(this.manual ? ["manual" as const] : []), "neutral", "reverse"];
    const at = all.indexOf(this.selector);
    const after = [...all.slice(at + 1), ...all.slice(0, at)];
    const found = after.find((selector) => this.obstacle(selector) === "");
    if (found !== undefined) this.put(found, this.present);
  }

  // R N 1 2 3 ...; in "drive" the person takes over from the gear that is in.
  up(): void {
    if (this.driveline === null) return;
    if (this.selector === "reverse") this.select("neutral");
    else if (this.selector === "neutral") this.select(this.manual ? "manual" : "drive");
    else if (this.manual) this.shiftTo((this.selector === "manual" ? this.gear : this.present) + 1);
  }

  down(): void {
    if (this.driveline === null) return;
    const from = this.selector === "manual" ? this.gear : this.present;
    if (this.selector === "neutral") this.select("reverse");
    else if (this.selector === "manual" && from === 1) this.select("neutral");
    else if (this.selector !== "reverse" && this.manual) this.shiftTo(from - 1);
  }

  private get manual(): boolean {
    return (this.driveline?.gears ?? 1) > 1;
  }

  private get present(): number {
    return Math.max(Math.round(this.listener.engaged()) || 1, 1);
  }

  private shiftTo(gear: number): void {
    this.put("manual", Math.min(Math.max(gear, 1), this.driveline?.gears ?? 1));
  }

  private select(selector: Selector): void {
    const obstacle = this.obstacle(selector);
    if (obstacle !== "") return this.listener.say(obstacle);
    this.put(selector, 1);
  }

  // Why it may not go in now, or nothing.
  private obstacle(selector: Selector): string {
    const speed = this.listener.speed();
    if (selector === "neutral") return "";
    if (selector === "reverse") {
      if (this.driveline?.reverse === false) return "This car has no reverse gear.";
      return speed > standstill ? "Reverse goes in at a standstill." : "";
    }
    return this.selector === "reverse" && speed < -standstill ? "Forward goes in at a standstill." : "";
  }

  private put(selector: Selector, gear: number): void {
    this.selector = selector;
    this.gear = gear;
    this.listener.shifted(selector);
  }
}
