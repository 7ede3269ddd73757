// Curves of the chosen channels, below each other over the same time: pointing at any moves the picture.
import { element } from "../dom";
import { createTimePlot, type TimePlot } from "../report/plot";
import { dataOf, sheetsOf, type Sheet } from "./sheet";
import type { Track } from "./track";

const usualHeight = 128; // of a drawing [px]
const leastHeight = 92; // rather than less the panel scrolls [px]
const [rowHeight, gap] = [16, 12]; // of the names below each [px]
const timeHeight = 24; // the last drawing has the numbers of time [px]
const hintHeight = 16; // of "more" below all [px]

export class Plots {
  readonly root = element("div", { class: "replay-plots" });
  onSeek: (time: number) => void = () => {};
  private plots: TimePlot[] = [];
  private time = 0;

  constructor(private readonly tracks: readonly Track[]) {}

  choose(names: readonly string[]): void {
    for (const plot of this.plots) plot.destroy();
    const sheets = sheetsOf(names, this.tracks);
    const height = this.heightFor(sheets);
    this.plots = sheets.map((sheet, i) => this.plotOf(sheet, height, i + 1 === sheets.length));
    this.root.replaceChildren(...this.plots.map((plot) => plot.root));
    if (sheets.length === 0) {
      this.root.append(element("p", { class: "replay-empty" }, "Choose channels to see their curves."));
    }
    this.showTime(this.time);
  }

  showTime(time: number): void {
    this.time = time;
    for (let i = 0; i < this.plots.length; ++i) this.plots[i]!.setCursorTime(time);
  }

  // All are seen at once where that takes a little less each.
  private heightFor(sheets: readonly Sheet[]): number {
    const panel = this.root.parentElement;
    const room = (panel?.clientHeight ?? 0) - this.root.offsetTop - timeHeight - hintHeight;
    const legends = sheets.reduce((sum, { curves }) => sum + gap + rowHeight * Math.ceil(curves.length / 2), 0);
    const fitting = Math.floor((room - legends) / sheets.length);
    return fitting >= leastHeight ? Math.min(fitting, usualHeight) : usualHeight;
  }

  private plotOf({ title, axis, curves }: Sheet, height: number, last: boolean): TimePlot {
    const plot = createTimePlot(this.root, {
      label: `${title} over time`,
      y: axis,
      series: curves,
      height: last ? height + timeHeight : height,
      timeAxis: last,
    });
    const { time, columns } = dataOf(curves);
    plot.setData(time, columns);
    plot.onSeek((at) => this.onSeek(at));
    return plot;
  }
}
