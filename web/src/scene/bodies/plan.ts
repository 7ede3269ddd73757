// What a body is built around: its box, its axles and the ground under it.
import type { BodyBox, Wheel } from "../../contract";

export interface Axle {
  readonly x: number; // of the wheel centers [m]
  readonly z: number;
  readonly radius: number;
}

export interface Plan {
  readonly front: number; // x [m]
  readonly rear: number;
  readonly half: number; // of the width [m]
  readonly bottom: number; // z of the floor [m]
  readonly top: number;
  readonly ground: number;
  readonly axles: readonly Axle[]; // from front to rear
  // Lengths along the body that fit every wheelbase: 0 the front end, 1 the first axle, 2 the last, 3 the rear end.
  x(station: number): number;
  station(x: number): number;
}

function axlesOf(wheels: readonly Wheel[]): Axle[] {
  const axles: Axle[] = [];
  for (const { center, radius } of [...wheels].sort((a, b) => b.center[0] - a.center[0])) {
    const last = axles[axles.length - 1];
    if (last && Math.abs(last.x - center[0]) < radius) continue;
    axles.push({ x: center[0], z: center[2], radius });
  }
  return axles;
}

export function planOf({ low, high }: BodyBox, wheels: readonly Wheel[]): Plan {
  const axles = axlesOf(wheels);
  const [front, rear] = [high[0], low[0]];
  const first = axles[0]?.x ?? front + 0.2 * (rear - front);
  const last = axles.length > 1 ? axles[axles.length - 1]!.x : rear + 0.2 * (front - rear);
  const knots = [front, first, last, rear];
  const ground = Math.min(low[2], ...axles.map(({ z, radius }) => z - 0.97 * radius));
  return {
    front, rear, ground, axles, half: (high[1] - low[1]) / 2, bottom: low[2], top: high[2],
    x: (station) => {
      const i = Math.min(Math.max(Math.floor(station), 0), 2);
      return knots[i]! + (station - i) * (knots[i + 1]! - knots[i]!);
    },
    station: (x) => {
      const i = x > first ? 0 : x > last ? 1 : 2;
      return i + (x - knots[i]!) / (knots[i + 1]! - knots[i]! || -1);
    },
  };
}
