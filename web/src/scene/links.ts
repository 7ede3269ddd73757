// Links of the suspensions by what they are: rods with their joints, bushes, coils, dampers, struts.
import * as THREE from "three";
import type { Link, LinkKind } from "../contract";
import { Points, type Frames } from "./frames";
import type { Paint } from "./paint";
import { Pieces, type Piece } from "./pieces";
import * as shapes from "./shapes";

type Stock = "metal" | "dark" | "carrier" | "coil" | "ball";
type Parts = Record<Stock, Piece[]>;

interface Line {
  readonly low: number; // points; the wheel's end is the lower one
  readonly high: number;
  readonly length: number; // at design
}

// Radii in meters for a wheel of 0.3 m; other vehicles in proportion.
type Build = (parts: Parts, line: Line, size: number) => void;

function lay(list: Piece[], line: Line, radius: number, start = 0, length: number | null = null): void {
  list.push({ a: line.low, b: line.high, start, length, radius });
}
function ballAt(parts: Parts, a: number, b: number, radius: number): void {
  parts.ball.push({ a, b, start: 0, length: radius, radius });
}
function seat(list: Piece[], line: Line, radius: number, start: number, size: number): void {
  lay(list, line, radius, start, 0.008 * size);
}

const builds: Record<LinkKind, Build> = {
  rod: (parts, line, size) => {
    lay(parts.metal, line, 0.011 * size);
    ballAt(parts, line.low, line.high, 0.018 * size);
    ballAt(parts, line.high, line.low, 0.018 * size);
  },
  spring: (parts, line, size) => {
    lay(parts.coil, line, 0.052 * size);
    seat(parts.dark, line, 0.062 * size, -0.006 * size, size);
    parts.dark.push({ a: line.high, b: line.low, start: -0.006 * size, length: 0.008 * size, radius: 0.062 * size });
  },
  damper: (parts, line, size) => {
    lay(parts.dark, line, 0.024 * size, 0, 0.55 * line.length);
    lay(parts.metal, line, 0.009 * size);
    ballAt(parts, line.low, line.high, 0.02 * size);
    ballAt(parts, line.high, line.low, 0.02 * size);
  },
  strut: (parts, line, size) => {
    const perch = 0.42 * line.length;
    lay(parts.dark, line, 0.027 * size, 0, 0.5 * line.length);
    lay(parts.metal, line, 0.011 * size);
    seat(parts.dark, line, 0.072 * size, perch - 0.008 * size, size);
    lay(parts.coil, line, 0.06 * size, perch);
    parts.dark.push({ a: line.high, b: line.low, start: -0.006 * size, length: 0.014 * size, radius: 0.072 * size });
  },
  hinge: (parts, line, size) => {
    lay(parts.dark, line, 0.021 * size);
    lay(parts.metal, line, 0.009 * size, -0.006 * size, line.length + 0.012 * size);
  },
  body: (parts, line, size) => {
    lay(parts.carrier, line, 0.009 * size);
    ballAt(parts, line.low, line.high, 0.009 * size);
    ballAt(parts, line.high, line.low, 0.009 * size);
  },
};

function lineOf({ a, b }: Link, n: number): Line {
  const upright = a.point[2] <= b.point[2];
  const length = Math.hypot(...[0, 1, 2].map((i) => a.point[i]! - b.point[i]!));
  return { low: upright ? 2 * n : 2 * n + 1, high: upright ? 2 * n + 1 : 2 * n, length };
}

export class Links {
  readonly root = new THREE.Group();
  private readonly points: Points;
  private readonly stocks: readonly Pieces[];

  constructor(links: readonly Link[], size: number, paint: Paint) {
    this.points = new Points(links.flatMap(({ a, b }) => [a, b]));
    const parts: Parts = { metal: [], dark: [], carrier: [], coil: [], ball: [] };
    links.forEach((link, n) => builds[link.kind](parts, lineOf(link, n), size));
    const stock = (shape: THREE.BufferGeometry, material: THREE.Material, pieces: readonly Piece[]): Pieces =>
      new Pieces(shape, material, this.points, pieces);
    this.stocks = [
      stock(shapes.rod, paint.metal, parts.metal),
      stock(shapes.rod, paint.dark, parts.dark),
      stock(shapes.rod, paint.carrier, parts.carrier),
      stock(shapes.coil, paint.spring, parts.coil),
      stock(shapes.ball, paint.dark, parts.ball),
    ];
    this.root.add(...this.stocks.map((pieces) => pieces.mesh));
  }

  update(frames: Frames): void {
    this.points.update(frames);
    for (const pieces of this.stocks) pieces.update(frames);
  }

  dispose(): void {
    for (const pieces of this.stocks) pieces.mesh.dispose();
  }
}
