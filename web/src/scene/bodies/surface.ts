// Surfaces of a body: grids of points whose cells are paint, glass, trim or lamp, gathered in one shape with a group for each.
import * as THREE from "three";

export const stuffs = ["paint", "glass", "trim", "headlamp", "taillamp"] as const;
export type Stuff = (typeof stuffs)[number];

export type Spot = readonly [number, number, number]; // x ahead, y left, z up [m]

export const lerp = (a: number, b: number, t: number): number => a + (b - a) * t;
export const clamp01 = (t: number): number => Math.min(Math.max(t, 0), 1);
export const steps = (from: number, to: number, count: number): number[] =>
  Array.from({ length: count + 1 }, (_, i) => lerp(from, to, i / count));

// Smooth through points (x, y) with rising x, and never beyond them: Fritsch and Carlson.
export function curve(points: readonly (readonly [number, number])[]): (x: number) => number {
  const slope = (i: number): number => {
    const [before, here, after] = [points[i - 1], points[i]!, points[i + 1]];
    if (!before || !after) return 0;
    const left = (here[1] - before[1]) / (here[0] - before[0]);
    const right = (after[1] - here[1]) / (after[0] - here[0]);
    return left * right <= 0 ? 0 : (2 * left * right) / (left + right);
  };
  return (x) => {
    const last = points.length - 1;
    if (x <= points[0]![0]) return points[0]![1];
    if (x >= points[last]![0]) return points[last]![1];
    const i = points.findIndex(([end]) => end > x) - 1;
    const [[x0, y0], [x1, y1]] = [points[i]!, points[i + 1]!];
    const span = x1 - x0;
    const t = (x - x0) / span;
    const [m0, m1] = [slope(i) * span, slope(i + 1) * span];
    const u = 1 - t;
    return u * u * (1 + 2 * t) * y0 + t * u * u * m0 + t * t * (3 - 2 * t) * y1 - t * t * u * m1;
  };
}

export class Surface {
  private readonly positions: number[] = [];
  private readonly faces: Record<Stuff, number[]> = { paint: [], glass: [], trim: [], headlamp: [], taillamp: [] };

  // Points over two parameters; what a cell is made of is asked for its middle, null leaves it open.
  grid(
    at: (a: number, b: number) => Spot,
    as: readonly number[],
    bs: readonly number[],
    stuffOf: Stuff | ((a: number, b: number) => Stuff | null),
  ): void {
    const first = this.positions.length / 3;
    for (const a of as) for (const b of bs) this.positions.push(...at(a, b));
    for (let i = 0; i + 1 < as.length; ++i) {
      for (let j = 0; j + 1 < bs.length; ++j) {
        const stuff =
          typeof stuffOf === "string" ? stuffOf : stuffOf((as[i]! + as[i + 1]!) / 2, (bs[j]! + bs[j + 1]!) / 2);
        if (stuff === null) continue;
        const corner = first + i * bs.length + j;
        const next = corner + bs.length;
        this.faces[stuff].push(corner, next, corner + 1, corner + 1, next, next + 1);
      }
    }
  }

  // Edges along the axes.
  box(low: Spot, high: Spot, stuff: Stuff): void {
    const side = (axis: number, value: number): void =>
      this.grid(
        (a, b) => {
          const spot = [0, 0, 0];
          const [p, q] = [(axis + 1) % 3, (axis + 2) % 3];
          spot[axis] = value;
          spot[p] = lerp(low[p]!, high[p]!, a);
          spot[q] = lerp(low[q]!, high[q]!, b);
          return spot as unknown as Spot;
        },
        [0, 1], [0, 1], stuff,
      );
    for (let axis = 0; axis < 3; ++axis) for (const value of [low[axis]!, high[axis]!]) side(axis, value);
  }

  // A round bar along a chain of points.
  bar(points: readonly Spot[], radius: number, stuff: Stuff): void {
    const path = new THREE.CatmullRomCurve3(points.map((point) => new THREE.Vector3(...point)));
    const frames = path.computeFrenetFrames(24, false);
    this.grid(
      (a, b) => {
        const i = Math.round(24 * a);
        const center = path.getPoint(a);
        const [n, s] = [frames.normals[i]!, frames.binormals[i]!];
        const [c, d] = [radius * Math.cos(b), radius * Math.sin(b)];
        return [center.x + c * n.x + d * s.x, center.y + c * n.y + d * s.y, center.z + c * n.z + d * s.z];
      },
      steps(0, 1, 24), steps(0, 2 * Math.PI, 8), stuff,
    );
  }

  build(): THREE.BufferGeometry {
    const shape = new THREE.BufferGeometry();
    shape.setAttribute("position", new THREE.Float32BufferAttribute(this.positions, 3));
    const all = stuffs.flatMap((stuff) => this.faces[stuff]);
    shape.setIndex(all);
    shape.computeVertexNormals();
    let start = 0;
    stuffs.forEach((stuff, i) => {
      const count = this.faces[stuff].length;
      shape.addGroup(start, count, i);
      start += count;
    });
    return shape;
  }
}
