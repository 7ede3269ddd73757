// Lines on the ground: boundaries of a course, which must not be crossed, and dashes along the line to follow.
import * as THREE from "three";
import { color } from "../theme";

export interface Markings {
  readonly boundaries: readonly (readonly [number, number, number, number])[]; // x0, y0, x1, y1 [m]
  readonly line: readonly (readonly [number, number])[]; // x, y [m]
}
export const noMarkings: Markings = { boundaries: [], line: [] };

type Piece = readonly [number, number, number, number];

const width = { boundary: 0.1, dash: 0.08 }; // [m]
const above = 0.012; // the ground [m]
const longest = 2; // a piece that follows hills [m]
const dash = { length: 1, every: 3 }; // [m]

function between([x0, y0, x1, y1]: Piece, from: number, to: number): Piece {
  const at = (a: number, b: number, share: number): number => a + share * (b - a);
  return [at(x0, x1, from), at(y0, y1, from), at(x0, x1, to), at(y0, y1, to)];
}

const lengthOf = ([x0, y0, x1, y1]: Piece): number => Math.hypot(x1 - x0, y1 - y0);

function short(piece: Piece): Piece[] {
  const count = Math.max(Math.ceil(lengthOf(piece) / longest), 1);
  return Array.from({ length: count }, (_, i) => between(piece, i / count, (i + 1) / count));
}

// Dashes go on from one stretch of the line to the next.
function dashes(line: Markings["line"]): Piece[] {
  const pieces: Piece[] = [];
  let gone = 0;
  for (let i = 1; i < line.length; ++i) {
    const stretch: Piece = [...line[i - 1]!, ...line[i]!];
    const length = lengthOf(stretch);
    for (let n = Math.floor(gone / dash.every); n * dash.every < gone + length; ++n) {
      const from = Math.max(n * dash.every - gone, 0);
      const to = Math.min(n * dash.every + dash.length - gone, length);
      if (to > from) pieces.push(between(stretch, from / length, to / length));
    }
    gone += length;
  }
  return pieces;
}

const noPieces = { boundaries: [], line: [] } as const;

class Ribbons {
  readonly mesh: THREE.Mesh;
  readonly material = new THREE.MeshBasicMaterial({
    transparent: true, depthWrite: false, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -4,
    polygonOffsetUnits: -4,
  });
  private readonly shape = new THREE.BufferGeometry();

  constructor(
    private readonly wide: number,
    opacity: number,
  ) {
    this.material.opacity = opacity;
    this.mesh = new THREE.Mesh(this.shape, this.material);
    this.mesh.renderOrder = -6;
  }

  lay(pieces: readonly Piece[], height: (x: number, y: number) => number): void {
    if (pieces.length === 0) return void (this.mesh.visible = false);
    const position: number[] = [];
    for (const [x0, y0, x1, y1] of pieces) {
      const half = this.wide / 2 / (Math.hypot(x1 - x0, y1 - y0) || 1);
      const [sideX, sideY] = [-(y1 - y0) * half, (x1 - x0) * half];
      const corner = (x: number, y: number, side: number): readonly number[] =>
        [x + side * sideX, y + side * sideY, height(x, y) + above];
      const [a, b, c, d] = [corner(x0, y0, -1), corner(x1, y1, -1), corner(x1, y1, 1), corner(x0, y0, 1)];
      position.push(...a, ...b, ...c, ...a, ...c, ...d);
    }
    const now = this.shape.getAttribute("position") as THREE.BufferAttribute | undefined;
    if (now?.array.length === position.length) {
      now.copyArray(position).needsUpdate = true;
    } else {
      this.shape.dispose(); // else the card would keep what is replaced
      this.shape.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
    }
    this.shape.computeBoundingSphere();
    this.mesh.visible = true;
  }

  dispose(): void {
    this.shape.dispose();
    this.material.dispose();
  }
}

export class MarkingPaint {
  readonly root = new THREE.Group();
  private readonly boundaries = new Ribbons(width.boundary, 0.38);
  private readonly line = new Ribbons(width.dash, 0.45);
  private pieces: { readonly boundaries: readonly Piece[]; readonly line: readonly Piece[] } = noPieces;
  private height: (x: number, y: number) => number = () => 0;

  constructor() {
    this.root.add(this.boundaries.mesh, this.line.mesh);
  }

  set({ boundaries, line }: Markings, height: (x: number, y: number) => number): void {
    this.height = height;
    this.pieces = { boundaries: boundaries.flatMap(short), line: dashes(line).flatMap(short) };
    this.lay();
  }

  // Anew where the ground has become known.
  lay(): void {
    this.boundaries.lay(this.pieces.boundaries, this.height);
    this.line.lay(this.pieces.line, this.height);
  }

  setTheme(): void {
    this.boundaries.material.color.set(color("ink"));
    this.line.material.color.set(color("accent"));
  }

  dispose(): void {
    this.boundaries.dispose();
    this.line.dispose();
  }
}
