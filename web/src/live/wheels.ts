// What every wheel carries and how it slips: a table with bars, from the first axle to the last.
import type { Scene, Wheel } from "../document";
import { element } from "../dom";
import type { LiveFrame } from "./frame";
import { bar, figure, write } from "./gauge";
import type { Bar } from "./gauge";

const crawl = 0.5; // slower than so the angle of slip trembles and tells nothing [m/s]
const slides = { angle: 10, slip: 0.2 } as const; // beyond the peak of most tires [deg, 1]
const fullTravel = 0.1; // [m]
const fullLoad = 8000; // until a wheel carries more [N]

interface TireReader {
  load(): number; // [N]
  force(): number; // along the road [N]
  angle(): number; // [deg]
  slip(): number; // [1]
}

function tireReader(frame: LiveFrame, tire: string): TireReader {
  const load = frame.reader(`${tire}.vertical_force`);
  const [x, y, z] = ["x", "y", "z"].map((axis) => frame.reader(`${tire}.ground_force.${axis}`));
  return {
    load,
    force: () => {
      const whole = Math.hypot(x?.() ?? NaN, y?.() ?? NaN, z?.() ?? NaN);
      return Math.sqrt(Math.max(whole * whole - load() * load(), 0));
    },
    angle: frame.reader(`${tire}.slip_angle`),
    slip: frame.reader(`${tire}.longitudinal_slip`),
  };
}

const sum = (values: readonly number[]): number => values.reduce((a, b) => a + b, 0);
const largest = (values: readonly number[]): number =>
  values.reduce((a, b) => (Math.abs(b) > Math.abs(a) || Number.isNaN(a) ? b : a), NaN);

class Figure {
  readonly root: HTMLTableCellElement;
  private readonly text = element("span", {}, "–");
  private readonly bar: Bar;

  constructor(signed: boolean) {
    this.bar = bar(signed);
    this.root = element("td", {}, this.text, this.bar.root);
  }

  // text null: the bar alone
  show(text: string | null, part: number, warns: boolean): void {
    this.bar.show(part);
    if (text === null) return;
    write(this.text, text);
    this.root.classList.toggle("warns", warns);
  }
}

class WheelRow {
  readonly root: HTMLTableRowElement;
  private readonly tires: readonly TireReader[];
  private readonly travel: () => number;
  private readonly load = new Figure(false);
  private readonly grip = new Figure(false);
  private readonly angle = new Figure(true);
  private readonly slip = new Figure(true);
  private readonly stroke = new Figure(true);

  constructor(frame: LiveFrame, scene: Scene, wheel: Wheel) {
    const own = scene.tires.filter((tire) => tire.name.startsWith(`${wheel.name}.`));
    this.tires = own.map((tire) => tireReader(frame, tire.name));
    this.travel = frame.reader(`${wheel.name}.wheel.travel`);
    const figures = [this.load, this.grip, this.angle, this.slip, this.stroke];
    const name = wheel.name.replaceAll("_", " ");
    this.root = element("tr", {}, element("th", { scope: "row" }, name), ...figures.map((one) => one.root));
  }

  get loadNow(): number {
    return sum(this.tires.map((tire) => tire.load()));
  }

  show(full: number, moves: boolean, texts: boolean): void {
    const load = this.loadNow;
    const grip = load <= 1 ? 0 : sum(this.tires.map((tire) => tire.force())) / load;
    const angle = moves ? largest(this.tires.map((tire) => tire.angle())) : NaN;
    const slip = largest(this.tires.map((tire) => tire.slip()));
    const travel = this.travel();
    const text = (value: number, decimals: number): string | null => (texts ? figure(value, decimals) : null);
    this.load.show(text(load / 1000, 2), load / full, load < 1);
    this.grip.show(text(grip, 2), grip / 1.2, false);
    this.angle.show(text(angle, 1), -angle / (2 * slides.angle), Math.abs(angle) > slides.angle);
    this.slip.show(text(100 * slip, 0), slip / (2 * slides.slip), Math.abs(slip) > slides.slip);
    this.stroke.show(text(1000 * travel, 0), travel / fullTravel, false);
  }
}

const columns: readonly (readonly [string, string, string])[] = [
  ["load", "kN", "vertical force of the road on the wheel"],
  ["grip", "1", "force along the road over load"],
  ["slip angle", "°", "slip angle, positive where the wheel moves to its left"],
  ["slip", "%", "longitudinal slip, drive positive"],
  ["travel", "mm", "of the wheel center against design, up positive"],
];

export class WheelTable {
  readonly root: HTMLElement;
  private readonly body = element("tbody");
  private rows: readonly WheelRow[] = [];
  private velocity: readonly (() => number)[] = [];
  private full = fullLoad;

  constructor() {
    const heads = columns.map(([name, unit, title]) =>
      element("th", { scope: "col", title }, name, " ", element("small", {}, unit === "1" ? "" : unit)),
    );
    const head = element("thead", {}, element("tr", {}, element("td"), ...heads));
    const table = element("table", {}, head, this.body);
    this.root = element("section", { class: "panel wheels", "aria-label": "Wheels" }, table);
  }

  setCar(scene: Scene, frame: LiveFrame): void {
    // A wheel behind another is at least a wheel's radius away; those of one axle go left to right.
    const order = [...scene.wheels].sort((a, b) =>
      Math.abs(a.center[0] - b.center[0]) > a.radius ? b.center[0] - a.center[0] : b.center[1] - a.center[1],
    );
    this.rows = order.map((wheel) => new WheelRow(frame, scene, wheel));
    this.velocity = ["longitudinal", "lateral"].map((way) => frame.reader(`chassis.${way}_velocity`));
    this.full = fullLoad;
    this.body.replaceChildren(...this.rows.map((row) => row.root));
  }

  show(texts: boolean): void {
    if (this.root.hidden) return;
    this.full = Math.max(this.full, ...this.rows.map((row) => row.loadNow || 0));
    const moves = !(Math.hypot(...this.velocity.map((read) => read())) < crawl);
    for (const row of this.rows) row.show(this.full, moves, texts);
  }
}
