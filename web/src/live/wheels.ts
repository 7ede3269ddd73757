// What every wheel carries and how it slips: a table with bars, from the first axle to the last.
import type { DisplayUnit, Scene, Wheel } from "../contract";
import { element } from "../dom";
import type { LiveFrame } from "./frame";
import { bar, figure, write } from "./gauge";
import type { Bar } from "./gauge";

const crawl = 0.5; // slower than so the angle of slip trembles and tells nothing [m/s]
const slides = { angle: 10, slip: 0.2 } as const; // beyond the peak of most tires [deg, 1]
const fullTravel = 0.1; // [m]
const fullLoad = 8000; // until a wheel carries more [N]
const fullPressure = 10; // of the brakes, until one has more [bar]
const lifted = 1; // a wheel that carries less is in the air [N]

interface TireReader {
  load(): number; // [N]
  force(): number; // along the road [N]
  angle(): number; // [deg]
  slip(): number; // [1]
}

function tireReader(frame: LiveFrame, tire: string): TireReader {
  const load = frame.reader("vertical_force", tire);
  const [x, y, z] = axes.map((axis) => frame.reader(axis, tire));
  return {
    load,
    force: () => {
      const whole = Math.hypot(x?.() ?? NaN, y?.() ?? NaN, z?.() ?? NaN);
      return Math.sqrt(Math.max(whole * whole - load() * load(), 0));
    },
    angle: frame.reader("slip_angle", tire),
    slip: frame.reader("longitudinal_slip", tire),
  };
}

const axes = ["ground_force_x", "ground_force_y", "ground_force_z"] as const;

const velocityReaders = (frame: LiveFrame): readonly (() => number)[] => [
  frame.reader("longitudinal_velocity"),
  frame.reader("lateral_velocity"),
];

// Of the tire that slides most, on the ground and while the car moves: 1 at the peak of most tires.
export function slipReader(frame: LiveFrame, tires: Scene["tires"]): () => number {
  const readers = tires.map(({ name }) => tireReader(frame, name));
  const velocity = velocityReaders(frame);
  const slipOf = ({ load, angle, slip }: TireReader): number =>
    load() > lifted ? Math.max(Math.abs(angle()) / slides.angle, Math.abs(slip()) / slides.slip) || 0 : 0;
  return () => (Math.hypot(...velocity.map((read) => read())) < crawl ? 0 : Math.max(0, ...readers.map(slipOf)));
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
  private readonly brake = new Figure(false);
  private readonly pressure: () => number; // [bar]

  constructor(frame: LiveFrame, scene: Scene, wheel: Wheel) {
    const own = scene.tires.filter((tire) => tire.name.startsWith(`${wheel.name}.`));
    this.tires = own.map((tire) => tireReader(frame, tire.name));
    this.travel = frame.reader("wheel_travel", wheel.name);
    this.pressure = frame.reader("brake_pressure", wheel.name);
    const figures = [this.load, this.grip, this.angle, this.slip, this.stroke, this.brake];
    const name = wheel.name.replaceAll("_", " ");
    this.root = element("tr", {}, element("th", { scope: "row" }, name), ...figures.map((one) => one.root));
  }

  get loadNow(): number {
    return sum(this.tires.map((tire) => tire.load()));
  }

  get pressureNow(): number {
    return this.pressure();
  }

  show(full: Full, moves: boolean, texts: boolean, units: Units): void {
    const load = this.loadNow;
    const grip = load <= lifted ? 0 : sum(this.tires.map((tire) => tire.force())) / load;
    const angle = moves ? largest(this.tires.map((tire) => tire.angle())) : NaN;
    const slip = largest(this.tires.map((tire) => tire.slip()));
    const travel = this.travel();
    const text = (value: number, decimals: number): string | null => (texts ? figure(value, decimals) : null);
    this.load.show(text(units.load.factor * load, 2), load / full.load, load < lifted);
    this.grip.show(text(grip, 2), grip / 1.2, false);
    this.angle.show(text(units.angle.factor * angle, 1), -angle / (2 * slides.angle), Math.abs(angle) > slides.angle);
    this.slip.show(text(units.slip.factor * slip, 0), slip / (2 * slides.slip), Math.abs(slip) > slides.slip);
    this.stroke.show(text(units.travel.factor * travel, 0), travel / fullTravel, false);
    const pressure = this.pressureNow;
    this.brake.show(text(units.pressure.factor * pressure, 1), pressure / full.pressure, false);
  }
}

const columns = [
  ["load", "load", "vertical force of the road on the wheel"],
  ["grip", null, "force along the road over load"],
  ["slip angle", "angle", "slip angle, positive where the wheel moves to its left"],
  ["slip", "slip", "longitudinal slip, drive positive"],
  ["travel", "travel", "of the wheel center against design, up positive"],
  ["brake", "pressure", "pressure at the wheel's brake"],
] as const;

// Of a car's channels, which have the same at all wheels.
type Units = Readonly<Record<"load" | "angle" | "slip" | "travel" | "pressure", DisplayUnit>>;

// What fills a bar.
interface Full {
  load: number; // [N]
  pressure: number; // [bar]
}

const brakedWheel = (frame: LiveFrame, wheels: readonly Wheel[]): Wheel | undefined =>
  wheels.find(({ name }) => frame.has("brake_pressure", name));

function unitsOf(frame: LiveFrame, { wheels, tires }: Scene): Units {
  const tire = tires[0]?.name;
  return {
    load: frame.display("vertical_force", tire),
    angle: frame.display("slip_angle", tire),
    slip: frame.display("longitudinal_slip", tire),
    travel: frame.display("wheel_travel", wheels[0]?.name),
    pressure: frame.display("brake_pressure", brakedWheel(frame, wheels)?.name),
  };
}

export class WheelTable {
  readonly root: HTMLElement;
  private readonly body = element("tbody");
  private rows: readonly WheelRow[] = [];
  private velocity: readonly (() => number)[] = [];
  private full: Full = { load: fullLoad, pressure: fullPressure };
  private units: Units | null = null;
  private readonly unitTexts = columns.map(() => element("small"));

  constructor() {
    const heads = columns.map(([name, , title], i) =>
      element("th", { scope: "col", title }, name, " ", this.unitTexts[i] ?? null),
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
    this.velocity = velocityReaders(frame);
    this.full = { load: fullLoad, pressure: fullPressure };
    this.root.classList.toggle("without-brakes", brakedWheel(frame, scene.wheels) === undefined);
    const units = unitsOf(frame, scene);
    this.units = units;
    columns.forEach(([, which], i) => write(this.unitTexts[i]!, which === null ? "" : units[which].unit));
    this.body.replaceChildren(...this.rows.map((row) => row.root));
  }

  show(texts: boolean): void {
    const { units } = this;
    if (this.root.hidden || units === null) return;
    const { full } = this;
    full.load = Math.max(full.load, ...this.rows.map((row) => row.loadNow || 0));
    full.pressure = Math.max(full.pressure, ...this.rows.map((row) => row.pressureNow || 0));
    const moves = !(Math.hypot(...this.velocity.map((read) => read())) < crawl);
    for (const row of this.rows) row.show(full, moves, texts, units);
  }
}
