// Which gear is wanted, and which one is in: a sign that a press moves on.
import { element } from "../dom";
import type { LiveFrame } from "./frame";
import { write } from "./gauge";
import type { Driveline, Selector } from "../contract";

const letters: Readonly<Record<Selector, string>> = { drive: "D", neutral: "N", reverse: "R", manual: "M" };

export class GearSign {
  readonly root: HTMLButtonElement;
  private selector: Selector = "drive";
  private driveline: Driveline | null = null;
  private read: () => number = () => NaN;

  constructor(next: () => void) {
    this.root = element("button", { type: "button", class: "gear", onclick: next });
    this.show();
  }

  setCar(driveline: Driveline | null, frame: LiveFrame): void {
    this.driveline = driveline;
    this.read = frame.reader("gear", driveline?.units[0]?.name);
    this.show();
  }

  // Gear that is in; NaN: not known.
  get engaged(): number {
    return this.read();
  }

  select(selector: Selector): void {
    this.selector = selector;
    this.show();
  }

  show(): void {
    const { selector, driveline } = this;
    if (driveline === null) return this.showDirection(selector === "reverse");
    const gear = this.engaged;
    const ahead = selector === "drive" || selector === "manual";
    const numbered = ahead && driveline.gears > 1 && Number.isFinite(gear);
    const number = gear === 0 ? "–" : String(gear); // between two gears none is in
    write(this.root, letters[selector] + (numbered ? number : ""));
    this.root.removeAttribute("aria-pressed");
    this.root.ariaLabel = `Selector: ${selector}${numbered && gear > 0 ? `, gear ${gear}` : ""}; press for the next`;
  }

  private showDirection(reverse: boolean): void {
    write(this.root, reverse ? "R" : "D");
    this.root.ariaPressed = String(reverse);
    this.root.ariaLabel = reverse ? "Reverse: on" : "Reverse: off";
  }
}
