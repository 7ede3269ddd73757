// Curves of the chosen channels, below each other over the same time: pointing at any moves the picture.
import { element } from "../dom";
import { createTimePlot, type TimePlot } from "../report/plot";
import { dataOf, sheetsOf, type Sheet } from "./sheet";
import type { Track } from "./track";

const plotHeight = 128; // [px]

export class Plots {
  readonly root = element("div", { class: "replay-plots" });
  onSeek: (time: number) => void = () => {};
  private plots: TimePlot[] = [];
  private time = 0;

  constructor(private readonly tracks: readonly Track[]) {}

  choose(names: readonly string[]): void {
    for (const plot of this.plots) plot.destroy();
    const sheets = sheetsOf(names, this.tracks);
    this.plots = sheets.map((sheet, i) => this.plotOf(sheet, i + 1 === sheets.length));
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

  private plotOf({ title, axis, curves }: Sheet, last: boolean): TimePlot {
    const plot = createTimePlot(this.root, {
      label: `${title} over time`,
      y: axis,
      series: curves,
      height: last ? plotHeight + 24 : plotHeight,
      timeAxis: last,
    });
    const { time, columns } = dataOf(curves);
    plot.setData(time, columns);
    plot.onSeek((at) => this.onSeek(at));
    return plot;
  }
}
