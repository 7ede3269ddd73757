// How fast the engine or motor turns and what it gives, one line for each power unit.
import { element } from "../dom";
import type { LiveFrame } from "./frame";
import { figure, readout, write } from "./gauge";
import { clamp } from "./held";
import type { Driveline, PowerUnit } from "../contract";
import "./tachometer.css";

const beyond = 1.06; // the scale ends this much above the highest speed
const turn = (2 * Math.PI) / 60; // rpm in rad/s

// Round numbers, at most nine of them.
function stepOf(max: number): number {
  const steps = [500, 1000, 2000, 2500, 5000];
  return steps.find((step) => max / step <= 9) ?? 10000;
}

function scaleOf({ idle, max }: PowerUnit): HTMLElement {
  const end = beyond * max;
  const at = (speed: number): string => `${((100 * speed) / end).toFixed(2)}%`;
  const step = stepOf(max);
  const ticks = Array.from({ length: Math.floor(end / step) + 1 }, (_, i) => i * step);
  return element(
    "span",
    { class: "scale", "aria-hidden": "true" },
    element("span", { class: "much", style: `left: ${at(max)}` }),
    ...ticks.map((speed) =>
      element("span", { class: "tick", style: `left: ${at(speed)}` }, figure(speed / 1000, step % 1000 === 0 ? 0 : 1)),
    ),
    idle > 0 ? element("span", { class: "idle", style: `left: ${at(idle)}` }) : null,
    element("i"),
  );
}

class UnitLine {
  readonly root: HTMLElement;
  private readonly scale: HTMLElement;
  private readonly speed = element("output", { class: "rpm" }, "–");
  private readonly power = readout("power", "kW");
  private readonly clutch = readout("clutch", "N m");
  private readonly read: Readonly<Record<"speed" | "torque" | "clutch", () => number>>;

  constructor(
    private readonly unit: PowerUnit,
    frame: LiveFrame,
  ) {
    const { name } = unit;
    this.read = {
      speed: frame.reader("rotor_speed", name),
      torque: frame.reader("rotor_torque", name),
      clutch: frame.reader("clutch_torque", name),
    };
    this.power.root.hidden = !frame.has("rotor_torque", name);
    this.clutch.root.hidden = !frame.has("clutch_torque", name);
    const words = name.replaceAll("_", " ");
    this.speed.ariaLabel = `Revolutions per minute of ${words}`;
    this.scale = scaleOf(unit);
    this.root = element(
      "div",
      { class: "unit" },
      element("span", { class: "name" }, words),
      this.scale,
      element("span", { class: "turns" }, this.speed, " ", element("small", {}, "rpm")),
      element("dl", {}, this.power.root, this.clutch.root),
    );
  }

  show(texts: boolean): void {
    const speed = this.read.speed();
    const { max } = this.unit;
    const level = this.scale.lastElementChild as HTMLElement;
    const part = Number.isFinite(speed) ? clamp(Math.abs(speed) / (beyond * max), 0, 1) : 0;
    level.style.transform = `scaleX(${part.toFixed(3)})`;
    if (!texts) return;
    this.root.classList.toggle("warns", Math.abs(speed) > max);
    write(this.speed, figure(10 * Math.round(speed / 10), 0)); // what trembles cannot be read
    this.power.show(figure((this.read.torque() * speed * turn) / 1000, 0));
    this.clutch.show(figure(this.read.clutch(), 0));
  }
}

export class Tachometers {
  readonly root = element("div", { class: "units", hidden: true });
  private lines: readonly UnitLine[] = [];

  setCar(driveline: Driveline | null, frame: LiveFrame): void {
    const seen = (driveline?.units ?? []).filter(({ name }) => frame.has("rotor_speed", name));
    this.lines = seen.map((unit) => new UnitLine(unit, frame));
    this.root.replaceChildren(...this.lines.map((line) => line.root));
    this.root.hidden = this.lines.length === 0;
  }

  show(texts: boolean): void {
    for (const line of this.lines) line.show(texts);
  }
}
