// What all plots look like: axes with hairlines, small type, curves in the theme's colors and dashes.
import uPlot from "uplot";
import { color, seriesColor, seriesDash } from "../theme";
import { logarithmicTickTexts, tickTexts } from "./numbers";

// Sizes are in CSS pixels times `factor`: pictures for paper are drawn larger and shown smaller.
export const typeSize = 11;
export const font = (factor: number, weight = 400): string =>
  `${weight} ${Math.round(typeSize * factor)}px ${color("font")}`;

export interface AxisStyle {
  readonly scale: "x" | "y";
  readonly label?: string; // below the axis
  readonly logarithmic?: boolean;
  readonly factor?: number;
  readonly size?: number; // fixed, so that plots below each other align; otherwise what the numbers need
  readonly show?: boolean;
}

function decades(ticks: readonly number[]): (number | null)[] {
  const isDecade = (value: number): boolean => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;
  return ticks.map((tick) => (isDecade(tick) ? tick : null));
}

// [CSS px]
export function textWidth(plot: uPlot, text: string): number {
  plot.ctx.font = font(devicePixelRatio);
  return plot.ctx.measureText(text).width / devicePixelRatio;
}

const widest = (plot: uPlot, texts: readonly string[] | null): number =>
  Math.max(0, ...(texts ?? []).map((text) => textWidth(plot, text)));

export function axisOf({ scale, label, logarithmic = false, factor = 1, size, show = true }: AxisStyle): uPlot.Axis {
  const hairline = { stroke: () => color("rule"), width: factor > 1 ? 0.6 * factor : 1 };
  return {
    scale,
    show,
    side: scale === "x" ? 2 : 3,
    stroke: () => color("ink-soft"),
    font: font(factor),
    labelFont: font(factor),
    ...(label === undefined ? {} : { label, labelSize: 18 * factor, labelGap: 2 * factor }),
    gap: 4 * factor,
    size: scale === "x" ? 24 * factor : size ?? ((plot, texts) => (widest(plot, texts) + 12) * factor),
    space: (scale === "x" ? 56 : 22) * factor,
    grid: { ...hairline, filter: (_plot, ticks) => (logarithmic ? decades(ticks) : ticks) },
    ticks: { ...hairline, size: 4 * factor },
    border: { show: scale === "x", stroke: () => color("ink-soft"), width: factor },
    values: (_plot, ticks, _axis, _space, step) => (logarithmic ? logarithmicTickTexts(ticks) : tickTexts(ticks, step)),
  };
}

// uPlot takes dashes in device pixels, all else in CSS pixels.
export const curveOf = (index: number, factor = 1): uPlot.Series => ({
  stroke: () => seriesColor(index),
  dash: seriesDash(index).map((length) => length * factor * devicePixelRatio),
  width: 1.6 * factor,
  paths: polyline,
});

// A line through the samples in their order, which may run back and forth. NaN parts it; samples that fall on the pixel
// before them are left out, which a thousand samples a second need.
export const polyline: uPlot.Series.PathBuilder = (plot, index, first, last) =>
  uPlot.orient(plot, index, (_series, xs, ys, scaleX, scaleY, toX, toY, left, top, width, height) => {
    const stroke = new Path2D();
    let drawing = false;
    let pixelX = NaN;
    let pixelY = NaN;
    for (let i = first; i <= last; ++i) {
      const x = toX(xs[i] ?? NaN, scaleX, width, left);
      const y = toY(ys[i] ?? NaN, scaleY, height, top);
      const here = Number.isFinite(x) && Number.isFinite(y);
      if (here && !(drawing && Math.round(x) === pixelX && Math.round(y) === pixelY)) {
        if (drawing) stroke.lineTo(x, y);
        else stroke.moveTo(x, y);
        pixelX = Math.round(x);
        pixelY = Math.round(y);
      }
      drawing = here;
    }
    return { stroke };
  }) as uPlot.Series.Paths;

const leastSpan = 1e-4; // over the largest number: what varies less is drawn as a level line [1]

// Limits a little wider than the data, at round numbers; zero draws a limit to itself, and what is as good as equal is parted.
export function roundLimits(low: number, high: number): [number, number] {
  if (!(low <= high)) return [0, 1];
  if (low === 0 && high === 0) return [-1, 1];
  const magnitude = Math.max(Math.abs(low), Math.abs(high));
  const flat = high - low <= leastSpan * magnitude;
  const pad = flat ? magnitude / 10 || 1 : (high - low) * 0.06;
  const step = 10 ** Math.floor(Math.log10(high - low + 2 * pad)) / 20;
  const from = low >= 0 && low < pad ? 0 : Math.floor((low - pad) / step) * step;
  const to = high <= 0 && -high < pad ? 0 : Math.ceil((high + pad) / step) * step;
  return [from, to];
}

export function roundLogarithmicLimits(low: number, high: number): [number, number] {
  if (!(low <= high)) return [1, 10];
  const [from, to] = uPlot.rangeLog(low, high, 10, false);
  return [from ?? low, to ?? high];
}
