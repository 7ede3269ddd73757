// Many like pieces, each laid on the line between two points: one draw call for all of them.
import * as THREE from "three";
import type { Frames, Points } from "./frames";

export interface Piece {
  readonly a: number; // points
  readonly b: number;
  readonly start: number; // from a [m]
  readonly length: number | null; // null: as far as b
  readonly radius: number; // [m]
}

// Its own x axis is the direction that leans the least to its line at design: turning with frame a, it never jumps.
function leastAligned(points: Points, piece: Piece): number {
  const a = points.list[piece.a]!.point;
  const b = points.list[piece.b]!.point;
  const lean = [0, 1, 2].map((i) => Math.abs(b[i]! - a[i]!));
  return lean.indexOf(Math.min(...lean));
}

// Columns of a matrix that takes a shape of radius 1 along z from 0 to 1 to its place.
export function writeColumns(
  out: Float32Array, at: number, sx: number, sy: number, sz: number, dx: number, dy: number, dz: number,
  length: number, radius: number, rx: number, ry: number, rz: number,
): void {
  let ux = ry * dz - rz * dy;
  let uy = rz * dx - rx * dz;
  let uz = rx * dy - ry * dx;
  const norm = radius / (Math.hypot(ux, uy, uz) || 1);
  ux *= norm;
  uy *= norm;
  uz *= norm;
  out[at] = ux;
  out[at + 1] = uy;
  out[at + 2] = uz;
  out[at + 4] = dy * uz - dz * uy;
  out[at + 5] = dz * ux - dx * uz;
  out[at + 6] = dx * uy - dy * ux;
  out[at + 8] = dx * length;
  out[at + 9] = dy * length;
  out[at + 10] = dz * length;
  out[at + 12] = sx;
  out[at + 13] = sy;
  out[at + 14] = sz;
  out[at + 15] = 1;
}

export class Pieces {
  readonly mesh: THREE.InstancedMesh;
  private readonly references: Int32Array;

  constructor(
    shape: THREE.BufferGeometry,
    material: THREE.Material,
    private readonly points: Points,
    private readonly pieces: readonly Piece[],
  ) {
    this.mesh = new THREE.InstancedMesh(shape, material, pieces.length);
    this.mesh.frustumCulled = false;
    this.mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    this.references = Int32Array.from(pieces, (piece) => leastAligned(points, piece));
  }

  update(frames: Frames): void {
    const out = this.mesh.instanceMatrix.array as Float32Array;
    const p = this.points.at;
    for (let n = 0; n < this.pieces.length; ++n) {
      const { a, b, start, length, radius } = this.pieces[n]!;
      let dx = p[3 * b]! - p[3 * a]!;
      let dy = p[3 * b + 1]! - p[3 * a + 1]!;
      let dz = p[3 * b + 2]! - p[3 * a + 2]!;
      const distance = Math.hypot(dx, dy, dz) || 1e-9;
      dx /= distance;
      dy /= distance;
      dz /= distance;
      const frame = this.points.list[a]!.frame;
      const axis = this.references[n]!;
      writeColumns(
        out, 16 * n, p[3 * a]! + start * dx, p[3 * a + 1]! + start * dy, p[3 * a + 2]! + start * dz, dx, dy, dz,
        length ?? Math.max(distance - start, 1e-3), radius,
        frames.axis(frame, axis, 0), frames.axis(frame, axis, 1), frames.axis(frame, axis, 2),
      );
    }
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
