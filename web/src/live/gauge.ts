// The pieces instruments are made of. Texts change ten times a second, so that they can be read; bars follow every
// picture.
import { element } from "../dom";
import { fixed } from "../report/numbers";
import { clamp } from "./held";

export const figure = (value: number, decimals: number): string =>
  Number.isFinite(value) ? fixed(value, decimals) : "–";

export function write(target: HTMLElement, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

export interface Readout {
  readonly root: HTMLElement;
  unit: string;
  show(text: string): void;
}

export function readout(label: string, unit = ""): Readout {
  const value = element("dd", {}, "–");
  const root = element("div", { class: "readout" }, element("dt", {}, label), value);
  const show = (text: string): void => write(value, withUnit(text, made.unit));
  const made = { root, unit, show };
  return made;
}

export const withUnit = (text: string, unit: string): string =>
  unit === "" || unit === "1" ? text : unit === "°" ? `${text}°` : `${text} ${unit}`;

export interface Bar {
  readonly root: HTMLElement;
  show(part: number): void; // -1 to 1; NaN: nothing
}

// A hairline with a thicker stretch from its start or, if signed, from its middle; positive to the right.
export function bar(signed: boolean): Bar {
  const level = element("i");
  const root = element("span", { class: signed ? "bar signed" : "bar", "aria-hidden": "true" }, level);
  return {
    root,
    show: (part) => {
      const shown = Number.isFinite(part) ? clamp(part, signed ? -1 : 0, 1) : 0;
      level.style.transform = `scaleX(${shown.toFixed(3)})`;
    },
  };
}

// True every 100 ms.
export class Metronome {
  private next = 0;

  ticks(now: number): boolean {
    if (now < this.next) return false;
    this.next = now + 100;
    return true;
  }
}
