// The last ten seconds as curves.
import { element } from "../dom";
import { createTimePlot } from "../report/plot";
import type { TimePlot } from "../report/plot";
import type { LiveFrame, Shown } from "./frame";

const span = 10; // [s]
const room = 4096; // rows; far more than a screen draws in that time

const curves = [
  { role: "longitudinal_velocity", name: "speed" },
  { role: "lateral_acceleration", name: "lateral acceleration" },
  { role: "yaw_rate", name: "yaw rate" },
] as const;

export class Strip {
  readonly root = element("section", { class: "panel strip", "aria-label": "The last ten seconds", hidden: true });
  private plots: readonly TimePlot[] = [];
  private readonly time = new Float64Array(room);
  private readonly columns = curves.map(() => new Float64Array(room));
  private shownOf: readonly Shown[] = [];
  private count = 0;

  setCar(frame: LiveFrame): void {
    this.shownOf = curves.map(({ role }) => frame.shown(role));
    this.count = 0;
    if (this.plots.length > 0) this.shown = true; // with this car's units
  }

  // Plots exist only while they are seen.
  set shown(on: boolean) {
    this.root.hidden = !on;
    for (const plot of this.plots) plot.destroy();
    this.root.replaceChildren();
    this.plots = on ? curves.map((curve, i) => this.plot(curve, i)) : [];
    this.draw();
  }

  add(time: number): void {
    const last = this.time[this.count - 1] ?? -Infinity;
    if (time < last) this.count = 0;
    if (time === last && this.count > 0) return;
    if (this.count === room) this.dropOldHalf();
    this.time[this.count] = time;
    this.columns.forEach((column, i) => (column[this.count] = this.shownOf[i]?.read() ?? NaN));
    this.count += 1;
  }

  draw(): void {
    if (this.plots.length === 0 || this.count === 0) return;
    const now = this.time[this.count - 1] ?? 0;
    let first = this.count - 1;
    while (first > 0 && (this.time[first] ?? 0) > now - span) first -= 1;
    const time = this.time.subarray(first, this.count);
    this.plots.forEach((plot, i) => {
      const column = this.columns[i];
      if (column) plot.setData(time, [column.subarray(first, this.count)]);
      plot.setTimeRange([Math.max(now - span, 0), Math.max(now, span)]);
    });
  }

  private plot({ name }: (typeof curves)[number], i: number): TimePlot {
    return createTimePlot(this.root, {
      label: `${name} over the last ten seconds`,
      y: `${name} [${this.shownOf[i]?.unit ?? ""}]`,
      series: [{ label: "", color: 0 }],
      height: 84,
      timeAxis: i === curves.length - 1,
    });
  }

  private dropOldHalf(): void {
    for (const column of [this.time, ...this.columns]) column.copyWithin(0, room / 2);
    this.count = room / 2;
  }
}
