// A tractor: its cab in front of a frame with tanks; and the box of a trailer on its rails.
import type { Plan } from "./plan";
import { clamp01, lerp, steps, Surface, type Spot, type Stuff } from "./surface";

const cabLength = 2.35; // with a sleeper [m]
const rail = 0.42; // half the distance of the frame's rails [m]

// A box with rounded vertical edges and roof; cells by place along it (0 front, 1 rear) and up (0 to 1).
function roundedHouse(
  surface: Surface, low: Spot, high: Spot, radius: number,
  walls: (face: "front" | "side" | "rear", along: number, up: number) => Stuff, rake = 0,
): void {
  const lean = (x: number, up: number): number =>
    x - rake * clamp01((up - 0.5) / 0.5) ** 2 * clamp01((x - low[0]) / (high[0] - low[0]));
  const half = high[1];
  const ups = [0, 0.08, 0.2, 0.35, 0.48, 0.52, 0.62, 0.72, 0.8, 0.88, 0.95, 1];
  const z = (up: number): number => lerp(low[2], high[2], up);
  const shrink = (up: number): number => (up > 0.95 ? radius * 0.5 * ((up - 0.95) / 0.05) : 0);
  const wall = (face: "front" | "side" | "rear", at: (t: number, up: number) => Spot, ts: readonly number[]): void =>
    surface.grid(at, ts, ups, (t, up) => walls(face, t, up));
  const ends = [0, 0.03, 0.12, 0.2, 0.3, 0.5, 0.52, 0.7, 0.9, 1];
  for (const side of [1, -1]) {
    wall("side", (t, up) => [lean(lerp(high[0] - radius, low[0] + radius, t), up), side * (half - shrink(up)), z(up)], ends);
    for (const [corner, out] of [[high[0] - radius, 1], [low[0] + radius, -1]] as const) {
      surface.grid((angle, up) => [
        lean(corner + out * (radius - shrink(up)) * Math.sin(angle), up),
        side * (half - radius + (radius - shrink(up)) * Math.cos(angle)), z(up),
      ], steps(0, Math.PI / 2, 6), ups, "paint");
    }
  }
  const across = [-1, -0.86, -0.5, -0.2, 0, 0.2, 0.5, 0.86, 1];
  wall("front", (b, up) => [lean(high[0] - shrink(up), up), b * (half - radius), z(up)], across);
  wall("rear", (b, up) => [low[0] + shrink(up), b * (half - radius), z(up)], across);
  const inset = radius * 0.5;
  surface.grid((t, b) => [lean(lerp(high[0] - inset, low[0] + inset, t), 1), b * (half - inset), high[2] + 0.02 * (1 - b * b)],
    steps(0, 1, 6), steps(-1, 1, 8), "paint");
}

function cabWalls(face: "front" | "side" | "rear", t: number, up: number): Stuff {
  if (up < 0.08) return "trim";
  if (face === "front") {
    if (up > 0.52 && up < 0.8 && Math.abs(t) < 0.97) return "glass";
    return up < 0.48 && Math.abs(t) < 0.5 ? "trim" : "paint";
  }
  return face === "side" && t > 0.03 && t < 0.5 && up > 0.52 && up < 0.8 ? "glass" : "paint";
}

export function buildTruck(plan: Plan): Surface {
  const surface = new Surface();
  const { front, rear, half, bottom, top, axles } = plan;
  const back = front - cabLength;
  const first = axles[0];
  const floor = first ? first.z + first.radius + 0.08 : bottom;
  surface.box([front - 0.45, -half, bottom - 0.1], [front - 0.02, half, floor], "paint");
  surface.box([front - 0.46, -half - 0.01, bottom - 0.12], [front, half + 0.01, bottom + 0.12], "trim");
  for (const side of [1, -1]) {
    const [lamp, step] = [side * (half - 0.22), side * (half - 0.25)];
    const ahead = first ? first.x - first.radius - 0.1 : back;
    surface.box([front - 0.03, lamp - 0.17, bottom + 0.2], [front, lamp + 0.17, bottom + 0.38], "headlamp");
    surface.box([back, step - 0.25, bottom - 0.1], [ahead, step + 0.25, floor], "paint");
  }
  roundedHouse(surface, [back, -half, floor], [front, half, top], 0.16, cabWalls, 0.35);
  for (const side of [1, -1]) {
    surface.box([rear, side * rail - 0.05, bottom + 0.25], [back, side * rail + 0.05, bottom + 0.5], "trim");
    if (first) {
      const reach = first.radius + 0.07;
      surface.grid((angle, t) => [
        first.x + reach * Math.cos(angle), side * lerp(half + 0.01, half - 0.5, t), first.z + reach * Math.sin(angle),
      ], steps(-0.2, Math.PI + 0.2, 20), [0, 1], "trim");
    }
    const [from, to] = [back - 0.05, (axles[1]?.x ?? rear) + 0.75];
    if (from - to > 0.4) {
      surface.grid((x, angle) => [x, side * (half - 0.42) + 0.3 * Math.cos(angle), bottom + 0.3 + 0.3 * Math.sin(angle)],
        [to, to + 0.02, from - 0.02, from], steps(0, 2 * Math.PI, 20), "paint");
    }
    surface.bar([[back - 0.12, side * (half - 0.25), bottom + 0.4], [back - 0.12, side * (half - 0.25), top - 0.4],
      [back - 0.2, side * (half - 0.25), top - 0.2]], 0.06, "trim");
    const tail = side * rail;
    surface.box([rear - 0.02, tail - 0.3, bottom + 0.2], [rear + 0.02, tail + 0.3, bottom + 0.35], "taillamp");
  }
  const plate = axles.length > 1 ? (axles[1]!.x + axles[axles.length - 1]!.x) / 2 : rear + 1;
  surface.box([plate - 0.5, -0.5, bottom + 0.5], [plate + 0.5, 0.5, bottom + 0.6], "trim");
  return surface;
}

// Panels of its sides stand a little apart, as riveted ones do.
export function buildBox(plan: Plan): Surface {
  const surface = new Surface();
  const { front, rear, half, bottom, top, axles } = plan;
  roundedHouse(surface, [rear, -half, bottom], [front, half, top], 0.05, (face, t, up) => {
    if (up < 0.08) return "trim";
    return face === "rear" && (Math.abs(t) < 0.02 || up > 0.95) ? "trim" : "paint";
  });
  const posts = Math.max(Math.round((front - rear) / 1.2), 1);
  for (const side of [1, -1]) {
    for (const x of steps(rear + 0.1, front - 0.1, posts)) {
      surface.box([x - 0.02, side * half - 0.012, bottom + 0.2], [x + 0.02, side * half + 0.012, top - 0.1], "paint");
    }
    surface.box([rear, side * rail - 0.06, bottom - 0.28], [front - 1.5, side * rail + 0.06, bottom], "trim");
    const legs = lerp(front, axles[0]?.x ?? rear, 0.28);
    surface.box([legs - 0.07, side * 0.75 - 0.07, plan.ground + 0.35], [legs + 0.07, side * 0.75 + 0.07, bottom], "trim");
    const tail = side * (half - 0.3);
    surface.box([rear - 0.02, tail - 0.14, bottom - 0.2], [rear + 0.02, tail + 0.14, bottom - 0.06], "taillamp");
    const [from, to] = [legs - 0.8, (axles[0]?.x ?? rear) + 1];
    if (from > to) surface.box([to, side * half - 0.03, bottom - 0.55], [from, side * half, bottom - 0.12], "paint");
  }
  surface.box([rear, -half + 0.1, plan.ground + 0.5], [rear + 0.1, half - 0.1, plan.ground + 0.6], "trim");
  return surface;
}
