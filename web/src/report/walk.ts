// How keys walk along the curves of a chart: left and right from sample to sample, up and down from curve to curve.
import { visible, type Limits, type Samples } from "./curves";

export interface Place {
  readonly curve: number;
  readonly sample: number;
}

export interface Ground {
  readonly curves: readonly Samples[];
  readonly shown: readonly boolean[];
  readonly x: Limits; // on the screen
}

function seen({ curves, shown, x: [low, high] }: Ground, index: number): number[] {
  const curve = curves[index];
  if (!curve || !shown[index]) return [];
  const inside = (x: number): boolean => x >= low && x <= high;
  return [...curve.x.keys()].filter((i) => visible(curve, i) && inside(curve.x[i] ?? NaN));
}

function along(ground: Ground, from: Place | null, by: number): Place | null {
  const curve = from?.curve ?? ground.shown.indexOf(true);
  const samples = seen(ground, curve);
  const at = from ? samples.indexOf(from.sample) : by > 0 ? -1 : samples.length;
  const sample = samples[Math.min(samples.length - 1, Math.max(0, at + by))];
  return sample === undefined ? null : { curve, sample };
}

// To the next curve that is shown, where its x is nearest.
function across(ground: Ground, from: Place | null, by: number): Place | null {
  if (!from) return along(ground, from, 1);
  const { curves, shown } = ground;
  const x = curves[from.curve]?.x[from.sample] ?? NaN;
  let curve = from.curve;
  do curve = (curve + by + curves.length) % curves.length;
  while (!shown[curve] && curve !== from.curve);
  const away = (i: number): number => Math.abs((curves[curve]?.x[i] ?? NaN) - x);
  const [first, ...others] = seen(ground, curve);
  if (first === undefined) return null;
  return { curve, sample: others.reduce((best, i) => (away(i) < away(best) ? i : best), first) };
}

// Null where the key leads nowhere.
export function walk(ground: Ground, from: Place | null, key: string, stride: number): Place | null {
  switch (key) {
    case "ArrowLeft":
      return along(ground, from, -stride);
    case "ArrowRight":
      return along(ground, from, stride);
    case "Home":
      return along(ground, from, -Infinity);
    case "End":
      return along(ground, from, Infinity);
    case "ArrowUp":
      return across(ground, from, -1);
    case "ArrowDown":
      return across(ground, from, 1);
    default:
      return null;
  }
}
