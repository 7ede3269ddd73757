// Channels over time, for the player and the simulator: a line stands at the time that is shown, and pointing seeks.
import uPlot from "uplot";
import { element } from "../dom";
import { color, onThemeChange } from "../theme";
import { createLegend, type Legend } from "./legend";
import { fixed, reading } from "./numbers";
import { axisOf, curveOf, font, roundLimits } from "./style";
import "./plot.css";

export interface TimePlotOptions {
  readonly label: string; // of the plot, for those who do not see it: "Roll angle over time"
  readonly y: string; // the axis, with its unit: "roll angle [deg]"
  readonly series: readonly TimePlotSeries[];
  readonly height?: number; // of the drawing without its legend [px]
  readonly timeAxis?: boolean; // false where the plot below shows the same time; default true
}

export interface TimePlotSeries {
  readonly label: string; // "" if the only one
  readonly color?: number; // index of seriesColor() and seriesDash(); default: its place in the list
}

type Column = Float64Array | Float32Array;

export interface TimePlot {
  readonly root: HTMLElement;
  // One column for each series, as long as `time` [s], which rises. NaN: a gap. An array may be handed again
  // after it was written to.
  setData(time: Float64Array, columns: readonly Column[]): void;
  // The stretch of time that is shown; null: all there is.
  setTimeRange(range: readonly [number, number] | null): void;
  setCursorTime(time: number | null): void;
  // Called with the time pointed at, by click, drag, touch or arrow keys.
  onSeek(callback: (time: number) => void): void;
  destroy(): void;
}

const axisWidth = 52; // [px], so that plots below each other align
const seekStep = 0.1; // of an arrow key [s]

// The name of the axis stands level above it: no head must be tilted, and no width is lost.
export function drawAxisName(plot: uPlot, name: string, factor = 1): void {
  plot.ctx.save();
  plot.ctx.font = font(factor * devicePixelRatio);
  plot.ctx.fillStyle = color("ink-soft");
  plot.ctx.textAlign = "left";
  plot.ctx.textBaseline = "top";
  plot.ctx.fillText(name, 2 * factor * devicePixelRatio, 2 * factor * devicePixelRatio);
  plot.ctx.restore();
}

// Follows the width of its host.
export function fitToWidth(
  plot: uPlot,
  host: HTMLElement,
  height: (width: number) => number,
  fitted: () => void = () => undefined,
): () => void {
  const observer = new ResizeObserver(([entry]) => {
    const width = Math.floor(entry?.contentRect.width ?? 0);
    if (width === 0) return;
    plot.setSize({ width, height: height(width) });
    fitted();
    host.dataset["fitted"] = String(width);
  });
  observer.observe(host);
  return () => observer.disconnect();
}

export const createTimePlot = (host: HTMLElement, options: TimePlotOptions): TimePlot => new View(host, options);

class View implements TimePlot {
  readonly root: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly line = element("div", { class: "time-cursor", hidden: true });
  private readonly legend: Legend;
  private readonly plot: uPlot;
  private readonly stops: readonly (() => void)[];
  private range: readonly [number, number] | null = null;
  private cursor: number | null = null;
  private seek: ((time: number) => void) | null = null;

  constructor(
    host: HTMLElement,
    private readonly options: TimePlotOptions,
  ) {
    const { series, label, height = 140 } = options;
    const colors = series.map(({ color: own }, i) => own ?? i);
    this.legend = createLegend(series.map((one, i) => ({ label: one.label, color: colors[i] ?? i })));
    this.stage = element("div", { class: "drawing", role: "img", "aria-label": label });
    this.root = element("div", { class: "time-plot" }, this.stage, this.legend.root);
    host.append(this.root);
    const nothing = [new Float64Array(0), ...series.map(() => new Float64Array(0))];
    this.plot = new uPlot(this.plotOptions(colors, height), nothing, this.stage);
    this.plot.over.append(this.line);
    this.stops = [fitToWidth(this.plot, this.stage, () => height), onThemeChange(() => this.plot.redraw(false))];
  }

  setData(time: Float64Array, columns: readonly Column[]): void {
    this.plot.setData([time, ...columns]);
  }

  setTimeRange(range: readonly [number, number] | null): void {
    this.range = range;
    this.plot.setData(this.plot.data);
  }

  setCursorTime(time: number | null): void {
    this.cursor = time;
    this.showCursor(this.plot);
  }

  onSeek(callback: (time: number) => void): void {
    this.seek = callback;
    this.stage.tabIndex = 0;
    this.stage.setAttribute("role", "slider");
    this.stage.classList.add("seekable");
    this.plot.over.addEventListener("pointerdown", (event) => this.seekByPointer(event));
    this.plot.over.addEventListener("pointermove", (event) => this.seekByPointer(event));
    this.stage.addEventListener("keydown", (event) => this.seekByKey(event));
  }

  destroy(): void {
    this.stops.forEach((stop) => stop());
    this.plot.destroy();
    this.root.remove();
  }

  private plotOptions(colors: readonly number[], height: number): uPlot.Options {
    const { y, timeAxis = true } = this.options;
    return {
      width: Math.max(120, this.stage.clientWidth),
      height,
      padding: [20, 10, timeAxis ? 0 : 8, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: (_plot, low, high) => this.timeLimits(low, high) },
        y: { range: (_plot, low, high) => roundLimits(low ?? NaN, high ?? NaN) },
      },
      axes: [axisOf({ scale: "x", show: timeAxis }), axisOf({ scale: "y", size: axisWidth })],
      series: [{}, ...colors.map((index) => ({ ...curveOf(index), points: { show: false } }))],
      hooks: {
        drawAxes: [(plot) => drawAxisName(plot, y)],
        draw: [(plot) => this.showCursor(plot)],
      },
    };
  }

  private timeLimits(low: number, high: number): [number, number] {
    if (this.range) return [...this.range];
    return low < high ? [low, high] : roundLimits(low, high);
  }

  private showCursor(plot: uPlot): void {
    const left = this.cursor === null ? NaN : plot.valToPos(this.cursor, "x");
    this.line.hidden = !(left >= 0 && left <= plot.over.clientWidth);
    if (!this.line.hidden) this.line.style.transform = `translateX(${left}px)`;
    this.showValues(plot);
  }

  private showValues(plot: uPlot): void {
    const times = plot.data[0];
    if (this.cursor === null || times.length === 0) return this.legend.setValues([]);
    const index = plot.valToIdx(this.cursor);
    const { min, max } = plot.scales["y"] ?? {};
    const values = this.options.series.map((_one, i) => plot.data[i + 1]?.[index] ?? NaN);
    this.legend.setValues(values.map((value) => reading(value, (max ?? 0) - (min ?? 0))));
    if (!this.seek) return;
    this.stage.setAttribute("aria-valuemin", String(times[0]));
    this.stage.setAttribute("aria-valuemax", String(times[times.length - 1]));
    this.stage.setAttribute("aria-valuenow", String(this.cursor));
    this.stage.setAttribute("aria-valuetext", `${fixed(this.cursor, 2)} s`);
  }

  private seekTo(time: number): void {
    const times = this.plot.data[0];
    const [first, last] = this.range ?? [times[0] ?? 0, times[times.length - 1] ?? 0];
    this.seek?.(Math.min(last, Math.max(first, time)));
  }

  private seekByPointer(event: PointerEvent): void {
    const { over } = this.plot;
    if (event.type === "pointermove" && event.buttons === 0) return;
    if (event.type === "pointerdown") over.setPointerCapture(event.pointerId);
    this.seekTo(this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x"));
  }

  private seekByKey(event: KeyboardEvent): void {
    const direction = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (direction === undefined || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation(); // the player may move by these keys too
    this.seekTo((this.cursor ?? this.plot.data[0][0] ?? 0) + direction * seekStep * (event.shiftKey ? 10 : 1));
  }
}
