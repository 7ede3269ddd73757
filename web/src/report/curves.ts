// The curves of one chart as numbers: what of them is seen, and which sample is nearest.
import type { ChartBlock, Curve } from "../contract";
import type { LoadedDocument } from "../document";
import { roundLimits, roundLogarithmicLimits } from "./style";

type Column = Float64Array | Float32Array;

export interface Samples {
  readonly label: string;
  readonly x: Column;
  readonly y: Column;
  readonly points: boolean;
  readonly rising: boolean; // x never falls: a function of x, not a loop
}

export type Limits = readonly [number, number];
export interface View {
  readonly x: Limits;
  readonly y: Limits;
}
export interface Zoom {
  readonly x: Limits;
  readonly y: Limits | null; // null: what the curves need
}

function rises(column: Column): boolean {
  for (let i = 1; i < column.length; ++i) if (!((column[i] ?? NaN) >= (column[i - 1] ?? NaN))) return false;
  return true;
}

// Logarithmic axes have no place for zero and less.
function withoutZeros(x: Column, y: Column, { logarithmic }: ChartBlock["x"]): [Column, Column] {
  if (!logarithmic || x.every((value) => value > 0)) return [x, y];
  const kept = [...x.keys()].filter((i) => (x[i] ?? NaN) > 0);
  const pick = (column: Column): Column => Float64Array.from(kept, (i) => column[i] ?? NaN);
  return [pick(x), pick(y)];
}

// "front_left" as people write it; a path keeps its letters.
const spaced = (label: string): string =>
  /[/\\]|\.[a-z]/.test(label) ? label : label.replace(/([a-z0-9])_(?=[a-z0-9])/g, "$1 ");

function samplesOfCurve(curve: Curve, block: ChartBlock, loaded: LoadedDocument): Samples {
  const [x, y] = withoutZeros(loaded.column(curve.x), loaded.column(curve.y), block.x);
  const gapped = block.y.logarithmic ? y.map((value) => (value > 0 ? value : NaN)) : y;
  const { points } = curve;
  const label = spaced(curve.label);
  if (rises(x)) return { label, points, x, y: gapped, rising: true };
  const backward = x.slice().reverse();
  if (rises(backward)) return { label, points, x: backward, y: gapped.slice().reverse(), rising: true };
  return { label, points, x, y: gapped, rising: false };
}

export const samplesOf = (block: ChartBlock, loaded: LoadedDocument): Samples[] =>
  block.curves.map((curve) => samplesOfCurve(curve, block, loaded));

export const visible = ({ x, y }: Samples, i: number): boolean => Number.isFinite(x[i]) && Number.isFinite(y[i]);

// Of all samples whose x lies within the limits; empty limits where there is none.
function extent(curves: readonly Samples[], of: "x" | "y", [from, to]: Limits): Limits {
  let low = Infinity;
  let high = -Infinity;
  for (const curve of curves)
    for (let i = 0; i < curve.x.length; ++i) {
      const x = curve.x[i] ?? NaN;
      if (!visible(curve, i) || x < from || x > to) continue;
      const value = curve[of][i] ?? NaN;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  return [low, high];
}

const everywhere: Limits = [-Infinity, Infinity];

// `around`: what else is to be seen, cones and the like.
export function viewOf(
  block: ChartBlock,
  curves: readonly Samples[],
  zoom: Zoom | null,
  around: readonly Samples[] = [],
): View {
  const all = [...curves, ...around];
  const round = ([low, high]: Limits, logarithmic: boolean): Limits =>
    logarithmic ? roundLogarithmicLimits(low, high) : roundLimits(low, high);
  const [first, last] = extent(all, "x", everywhere);
  const marks = block.marks.map((mark) => mark.x); // a limit that no curve reaches is worth seeing
  const [low, high] = [Math.min(first, ...marks), Math.max(last, ...marks)];
  const loops = block.equal_axes === true || curves.some((curve) => !curve.rising);
  const x = zoom?.x ?? (low < high && !loops ? [low, high] : round([low, high], block.x.logarithmic));
  const limits = (block.horizontal_marks ?? []).map((mark) => mark.y);
  const [bottom, top] = extent(all, "y", x);
  const y: Limits = [Math.min(bottom, ...limits), Math.max(top, ...limits)];
  return { x, y: zoom?.y ?? round(y, block.y.logarithmic) };
}

function nearestInRising(x: Column, value: number): number {
  let low = 0;
  let high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((x[middle] ?? NaN) < value) low = middle;
    else high = middle;
  }
  return value - (x[low] ?? NaN) <= (x[high] ?? NaN) - value ? low : high;
}

// Of a function the sample nearest along x, and none beyond its ends; of a loop the one nearest on the screen.
export function nearest(curve: Samples, x: number, distance: (x: number, y: number) => number): number | null {
  const count = curve.x.length;
  if (count === 0) return null;
  if (curve.rising) {
    const i = nearestInRising(curve.x, x);
    const apart = Math.abs((curve.x[i] ?? NaN) - x);
    const step = Math.abs((curve.x[Math.min(i + 1, count - 1)] ?? NaN) - (curve.x[Math.max(i - 1, 0)] ?? NaN));
    return apart > step && count > 1 ? null : i;
  }
  let best: number | null = null;
  let nearest = Infinity;
  for (let i = 0; i < count; ++i) {
    const here = visible(curve, i) ? distance(curve.x[i] ?? NaN, curve.y[i] ?? NaN) : Infinity;
    if (here < nearest) [best, nearest] = [i, here];
  }
  return best;
}
