// The shell of a car: a lower body lofted over sections from nose to tail with its wheel arches, and on it a cabin of glass and
// pillars. Heights are shares of the car's height over the ground, lengths are stations (plan.ts).
import type { Plan } from "./plan";
import { clamp01, curve, lerp, steps, type Spot, type Stuff, Surface } from "./surface";

type Points = readonly (readonly [number, number])[];

export interface ShellStyle {
  readonly deck: Points; // height of hood, belt line and trunk
  readonly width: Points; // share of half the width
  readonly square: number; // 2: round sections, 8: nearly boxes
  readonly cabin: {
    readonly base: readonly [number, number]; // stations of the foot of windshield and rear window
    readonly roof: readonly [number, number]; // stations of its ends
    readonly pillars: readonly number[]; // between doors, from 0 at the windshield to 1 at the rear window
    readonly solidRear: number; // share of the side behind which there is no glass
    readonly inset: readonly [number, number]; // share of half the width at belt and roof
  };
  readonly bed?: readonly [number, number]; // stations of an open bed
  readonly trim: number; // height of dark bumpers and sills
}

const archGap = 0.055; // between tire and arch [m]
const houseWidth = 0.3; // of a wheel house [m]

class Shell {
  private readonly surface = new Surface();
  private readonly deck: (station: number) => number;
  private readonly width: (station: number) => number;

  constructor(private readonly plan: Plan, private readonly style: ShellStyle) {
    this.deck = curve(style.deck);
    this.width = curve(style.width);
  }

  build(): Surface {
    this.lowerBody();
    this.ends();
    this.floor();
    for (const axle of this.plan.axles) for (const side of [1, -1]) this.wheelHouse(axle, side);
    this.cabin();
    return this.surface;
  }

  private height(share: number): number {
    return lerp(this.plan.ground, this.plan.top, share);
  }
  private halfAt(x: number): number {
    return this.plan.half * this.width(this.plan.station(x));
  }
  private deckAt(x: number): number {
    return this.height(this.deck(this.plan.station(x)));
  }

  // The lower edge of the side: the sill, or the arch over a wheel.
  private edgeAt(x: number): number {
    const { bottom, axles, front, rear } = this.plan;
    const lift = 0.07 * (clamp01(1 - (front - x) / 0.35) ** 2 + clamp01(1 - (x - rear) / 0.4) ** 2);
    let edge = bottom + lift;
    for (const { x: at, z, radius } of axles) {
      const reach = radius + archGap;
      const away = Math.abs(x - at);
      if (away < reach) edge = Math.max(edge, z + Math.sqrt(reach * reach - away * away));
    }
    return edge;
  }

  // Dense where arches turn, with both sides of their vertical ends.
  private sections(): number[] {
    const { front, rear, axles } = this.plan;
    const xs = new Set(steps(front, rear, 30));
    for (const d of [0.01, 0.03, 0.06, 0.1]) xs.add(front - d).add(rear + d);
    for (const { x, radius } of axles) {
      const reach = radius + archGap;
      for (let i = 0; i <= 16; ++i) xs.add(x + reach * Math.cos((Math.PI * i) / 16));
      xs.add(x + reach + 1e-4).add(x - reach - 1e-4);
    }
    return [...xs].filter((x) => x <= front && x >= rear).sort((a, b) => b - a);
  }

  // Half a section: 1 at the lower edge, 0.45 where it is widest, 0 in the middle of the deck.
  private at(x: number, around: number): Spot {
    const side = Math.sign(around);
    const t = Math.abs(around);
    const half = this.halfAt(x);
    const [edge, deck] = [this.edgeAt(x), this.deckAt(x)];
    const waist = Math.min(lerp(this.plan.bottom, deck, 0.55), deck - 0.03);
    if (t >= 0.45) {
      const down = (t - 0.45) / 0.55;
      const z = lerp(Math.max(waist, edge), edge, down);
      const tuck = clamp01((waist - z) / Math.max(waist - this.plan.bottom, 0.1));
      return [x, side * half * (1 - 0.06 * tuck * tuck), z];
    }
    const angle = (0.5 * Math.PI * (0.45 - t)) / 0.45;
    const power = 2 / this.style.square;
    const foot = Math.min(Math.max(waist, edge), deck);
    const y = half * Math.cos(angle) ** power;
    const up = Math.sin(angle) ** power;
    return [x, side * y, this.sunk(x, y, half, lerp(foot, deck, up) + 0.02 * (1 - (y / half) ** 2))];
  }

  // Height of the deck at a share of half the width.
  private shoulderAt(x: number, share: number): number {
    const deck = this.deckAt(x);
    const waist = lerp(this.plan.bottom, deck, 0.55);
    return lerp(waist, deck, (1 - share ** this.style.square) ** (1 / this.style.square));
  }

  private sunk(x: number, y: number, half: number, z: number): number {
    const { bed } = this.style;
    const station = this.plan.station(x);
    if (!bed || station < bed[0] || station > bed[1] || y > half - 0.09) return z;
    return this.height(0.4);
  }

  private lowerBody(): void {
    const { bottom } = this.plan;
    const around = [...steps(-1, -0.45, 4), ...steps(-0.45, 0.45, 20).slice(1), ...steps(0.45, 1, 4).slice(1)];
    const inBed = (x: number, b: number): boolean => {
      const { bed } = this.style;
      const station = this.plan.station(x);
      return bed !== undefined && station > bed[0] && station < bed[1] && Math.abs(b) < 0.28;
    };
    this.surface.grid((x, b) => this.at(x, b), this.sections(), around, (x, b) => {
      const { bed } = this.style;
      if (bed && inBed(x, b)) return "trim";
      const z = this.at(x, b)[2];
      const end = Math.min(this.plan.front - x, x - this.plan.rear) < 0.3;
      return z < (end ? this.height(this.style.trim) : bottom + 0.07) ? "trim" : "paint";
    });
  }

  // Nose and tail are flat; lamps, grille and plate lie on them.
  private ends(): void {
    const { front, rear } = this.plan;
    for (const ahead of [true, false]) {
      const x = ahead ? front : rear;
      const [half, low, high] = [this.halfAt(x), this.edgeAt(x), this.deckAt(x)];
      const middle = low;
      const dark = this.height(this.style.trim);
      const section = (b: number, t: number): Spot => {
        const [, y, z] = this.at(x, b);
        return [x, t * y, lerp(middle, z, t)];
      };
      this.surface.grid(section, steps(-1, 1, 24), [0, 1], "paint");
      const patch = (from: number, to: number, bottom: number, top: number, stuff: Stuff): void =>
        this.surface.grid(
          (y, z) => [x + (ahead ? 0.012 : -0.012), y * half, z],
          steps(from, to, 4), [bottom, top], stuff,
        );
      const [lampLow, lampHigh] = [lerp(dark, high, 0.3), lerp(dark, high, 0.78)];
      patch(-0.96, 0.96, low + 0.02, dark, "trim");
      for (const side of [1, -1]) patch(0.52 * side, 0.92 * side, lampLow, lampHigh, ahead ? "headlamp" : "taillamp");
      if (ahead) patch(-0.46, 0.46, lampLow, lampHigh, "trim");
      else patch(-0.28, 0.28, lerp(dark, high, 0.3), lerp(dark, high, 0.56), "headlamp");
    }
  }

  private floor(): void {
    const { front, rear, bottom } = this.plan;
    const reach = (x: number): number => Math.max(this.halfAt(x) - houseWidth, 0.2);
    this.surface.grid((x, b) => [x, b * reach(x), bottom + 0.06], steps(front - 0.1, rear + 0.1, 12), [-1, 0, 1], "trim");
  }

  // A dark cylinder over the wheel, its inner wall, and the lip of the arch.
  private wheelHouse({ x, z, radius }: Plan["axles"][number], side: number): void {
    const reach = radius + archGap;
    const outer = (at: number): number => side * this.halfAt(at);
    const turn = (angle: number, r: number): readonly [number, number] => [x + r * Math.cos(angle), z + r * Math.sin(angle)];
    const angles = steps(0, Math.PI, 12);
    const inner = Math.max(Math.abs(outer(x)) - houseWidth, 0.3) * side;
    this.surface.grid((angle, t) => {
      const [at, up] = turn(angle, reach);
      return [at, lerp(outer(at) * 0.99, inner, t), up];
    }, angles, [0, 1], "trim");
    this.surface.grid((angle, t) => {
      const [at, up] = turn(angle, t * reach);
      return [at, inner, up];
    }, angles, [0.05, 1], "trim");
    this.surface.grid((angle, t) => {
      const [at, up] = turn(angle, reach + 0.05 * t - 0.004);
      return [at, outer(at) + side * 0.018 * Math.sin(Math.PI * (0.15 + 0.85 * t)), up];
    }, steps(0, Math.PI, 16), [0, 0.5, 1], "paint");
  }

  private cabin(): void {
    const { plan, style } = this;
    const { base, roof, pillars, solidRear, inset } = style.cabin;
    const foot = (t: number): Spot => {
      const x = plan.x(lerp(base[0], base[1], t));
      return [x, this.halfAt(x) * inset[0], this.shoulderAt(x, inset[0]) - 0.015];
    };
    const roofHalf = plan.half * inset[1];
    const crown = 0.035;
    const head = (t: number): Spot => {
      const end = (2 * t - 1) ** 4; // the roof is a little narrower and lower at its ends
      return [plan.x(lerp(roof[0], roof[1], t)), roofHalf * (1 - 0.04 * end), plan.top - crown - 0.035 * end];
    };
    const wall = (t: number, up: number): Spot => {
      const [a, b] = [foot(t), head(t)];
      const bulge = 0.03 * Math.sin(Math.PI * up);
      return [lerp(a[0], b[0], up), lerp(a[1], b[1], up) + bulge, lerp(a[2], b[2], up)];
    };
    const along = [...new Set([0, 0.05, ...pillars.flatMap((p) => [p - 0.02, p + 0.02]), solidRear, ...steps(0, 1, 10)])]
      .sort((a, b) => a - b);
    const heights = [0, 0.08, 0.48, 0.88, 1];
    const sideStuff = (t: number, up: number): Stuff => {
      const pillar = t < 0.05 || t > solidRear || pillars.some((p) => Math.abs(t - p) < 0.02);
      return pillar || up < 0.08 || up > 0.88 ? "paint" : "glass";
    };
    for (const side of [1, -1]) {
      this.surface.grid((t, up) => {
        const [x, y, z] = wall(t, up);
        return [x, side * y, z];
      }, along, heights, sideStuff);
    }
    const across = [-1, -0.9, ...steps(-0.7, 0.7, 4), 0.9, 1];
    const pane = (t: number, out: number): void =>
      this.surface.grid((b, up) => {
        const [x, y, z] = wall(t, up);
        const rise = lerp(this.shoulderAt(x, Math.abs(b) * inset[0]) - this.shoulderAt(x, inset[0]), crown * (1 - b * b), up);
        return [x + out * 0.09 * (1 - b * b) * (1 - up), b * y, z + Math.max(rise, 0)];
      }, across, [0, 0.06, 0.5, 0.94, 1], (b, up) =>
        Math.abs(b) > 0.9 || up < 0.06 || up > 0.94 ? "paint" : "glass");
    pane(0, 1);
    pane(1, -1);
    this.surface.grid((t, b) => {
      const [x, y, z] = head(t);
      return [x, b * y, z + crown * (1 - b * b)];
    }, steps(0, 1, 10), across, "paint");
  }
}

export const buildShell = (plan: Plan, style: ShellStyle): Surface => new Shell(plan, style).build();
