// An open-wheeler: a tub with its nose between the wheels, side pods, hoops and wings.
import type { Plan } from "./plan";
import { curve, lerp, steps, Surface, type Spot } from "./surface";

const tubHalf = 0.3; // [m]

export function buildOpenWheeler(plan: Plan): Surface {
  const surface = new Surface();
  const { x, top, bottom, half, front, rear } = plan;
  const height = top - bottom;
  const high = curve([
    [0.12, 0.18], [0.7, 0.36], [1, 0.44], [1.25, 0.47], [1.62, 0.46], [1.72, 0.6], [2, 0.5], [2.6, 0.3],
  ]);
  const wide = curve([[0.12, 0.3], [0.5, 0.55], [1, 0.8], [1.4, 1], [1.8, 0.95], [2.2, 0.7], [2.6, 0.45]]);
  const low = curve([[0.12, 0.08], [0.8, 0.04], [1.2, 0], [2.6, 0.06]]);
  const section = (station: number, around: number): Spot => {
    const [w, h, l] = [tubHalf * wide(station), bottom + height * high(station), bottom + height * low(station)];
    const [c, s] = [Math.cos(around), Math.sin(around)];
    const round = (value: number): number => Math.sign(value) * Math.abs(value) ** 0.6;
    return [x(station), w * round(c), lerp(l, h, 0.5 + 0.5 * round(s))];
  };
  const around = steps(0, 2 * Math.PI, 32);
  const inCockpit = (station: number, angle: number): boolean =>
    station > 1.22 && station < 1.64 && Math.abs(angle - Math.PI / 2) < 0.75;
  surface.grid(section, steps(0.12, 2.6, 48), around, (s, a) => (inCockpit(s, a) ? null : "paint"));
  for (const end of [0.12, 2.6]) {
    surface.grid((t, angle) => {
      const [px, py, pz] = section(end, angle);
      const [, , middle] = section(end, 0);
      return [px + (end < 1 ? 0.04 * (1 - t) : 0), py * t, lerp(middle, pz, t)];
    }, steps(0, 1, 3), around, "paint");
  }
  const floor = (station: number, t: number): Spot => [x(station), t * tubHalf * 0.8, bottom + 0.14 * height];
  surface.grid(floor, steps(1.2, 1.66, 4), [-1, 1], "trim");
  const seat = (t: number, b: number): Spot =>
    [x(1.6) - 0.12 * t, b * 0.2, lerp(bottom + 0.14 * height, bottom + 0.66 * height, t)];
  surface.grid(seat, steps(0, 1, 4), steps(-1, 1, 4), "trim");
  for (const side of [1, -1]) sidePod(surface, plan, side);
  hoop(surface, x(1.68), 0.26, bottom + 0.3 * height, top - 0.02, 0.019);
  hoop(surface, x(1.2), 0.2, bottom + 0.3 * height, bottom + 0.6 * height, 0.014);
  for (const side of [0.2, -0.2]) {
    const brace: Spot[] = [
      [x(1.69), side * 0.8, top - 0.12], [x(1.95), side, bottom + 0.6 * height], [x(2.25), side, bottom + 0.35 * height],
    ];
    surface.bar(brace, 0.013, "trim");
  }
  wing(surface, front - 0.2, 0.36, Math.min(half, 0.68), bottom + 0.05 * height, 2);
  wing(surface, rear + 0.3, 0.42, Math.min(0.5, half), bottom + 0.72 * height, 2);
  for (const side of [1, -1]) {
    const [low, high] = [bottom + 0.25 * height, bottom + 0.72 * height];
    surface.box([rear + 0.12, side * 0.15 - 0.006, low], [rear + 0.3, side * 0.15 + 0.006, high], "trim");
  }
  surface.box([rear + 0.3, -0.04, bottom + 0.3 * height], [rear + 0.34, 0.04, bottom + 0.36 * height], "taillamp");
  return surface;
}

function sidePod(surface: Surface, { x, bottom, top, half }: Plan, side: number): void {
  const height = top - bottom;
  const [inner, outer] = [tubHalf * 0.85, Math.min(half - 0.18, 0.56)];
  const taper = curve([[1.4, 0.96], [1.6, 1], [1.8, 0.9], [1.93, 0.4]]);
  surface.grid((station, angle) => {
    const reach = lerp(inner, outer, taper(station));
    const round = (value: number): number => Math.sign(value) * Math.abs(value) ** 0.5;
    const up = bottom + height * lerp(0.16, 0.16 + 0.15 * taper(station), round(Math.sin(angle)));
    return [x(station), side * lerp(inner, reach, Math.max(round(Math.cos(angle)), 0)), up];
  }, steps(1.4, 1.93, 14), steps(-Math.PI / 2, Math.PI / 2, 14), "paint");
  const mouth = (t: number, up: number): Spot =>
    [x(1.4), side * lerp(inner, outer * 0.97, t), bottom + height * lerp(0.03, 0.3, up)];
  surface.grid(mouth, [0, 1], [0, 1], "trim");
}

function hoop(surface: Surface, at: number, half: number, low: number, high: number, radius: number): void {
  const knee = lerp(low, high, 0.55);
  surface.bar([[at, half, low], [at, half, knee], [at, 0.5 * half, high - 0.01], [at, -0.5 * half, high - 0.01],
    [at, -half, knee], [at, -half, low]], radius, "trim");
}

// Elements one over the other with their end plates.
function wing(surface: Surface, lead: number, chord: number, half: number, z: number, elements: number): void {
  for (let n = 0; n < elements; ++n) {
    const [start, length] = [lead - 0.62 * chord * n, chord * (n === 0 ? 0.68 : 0.42)];
    const lift = 0.08 * n + 0.02;
    for (const thick of [0.02, -0.012]) {
      surface.grid((t, b) => [start - t * length, b * half,
        z + lift + t * t * (0.05 + 0.1 * n) + thick * Math.sin(Math.PI * Math.sqrt(t))],
      steps(0, 1, 8), [-1, -0.5, 0, 0.5, 1], n === 0 ? "trim" : "paint");
    }
  }
  for (const side of [1, -1]) {
    surface.box([lead - 1.08 * chord, side * half - 0.006, z - 0.03], [lead + 0.02, side * half + 0.006, z + 0.24], "paint");
  }
}
