// Binary messages, read: the row of a car's channels at one instant, and tiles of its road.
import { tileNodes } from "../document";
import type { RoadTile } from "../document";
import { headerBytes } from "./protocol";
import type { CarMessage } from "./protocol";

// One row, written over by each frame.
export class LiveFrame {
  time = 0; // [s]
  sequence = 0; // of the last input it has felt
  page = 0; // that sent that input
  readonly names: readonly string[];
  readonly row: Float32Array;
  private readonly columns: ReadonlyMap<string, number>;

  constructor(private readonly car: CarMessage) {
    this.names = car.channels.map((channel) => channel.name);
    this.row = new Float32Array(this.names.length).fill(NaN);
    this.columns = new Map(this.names.map((name, i) => [name, i]));
  }

  // False if the bytes are of another car.
  read(bytes: ArrayBuffer): boolean {
    const view = new DataView(bytes);
    if (view.getUint32(4, true) !== this.car.car) return false;
    this.time = view.getFloat64(8, true);
    this.sequence = view.getUint32(16, true);
    this.page = view.getUint32(20, true);
    const count = Math.min(this.row.length, (bytes.byteLength - headerBytes.frame) / 4);
    for (let i = 0; i < count; ++i) this.row[i] = view.getFloat32(headerBytes.frame + 4 * i, true);
    return true;
  }

  has(name: string): boolean {
    return this.columns.has(name);
  }

  // Reads one channel; NaN where the car has none of that name.
  reader(name: string): () => number {
    const column = this.columns.get(name);
    return column === undefined ? () => NaN : () => this.row[column] ?? NaN;
  }

  value(name: string): number {
    return this.row[this.columns.get(name) ?? -1] ?? NaN;
  }
}

// Null if the bytes are of another car.
export function readTile(bytes: ArrayBuffer, car: number): RoadTile | null {
  const view = new DataView(bytes);
  if (view.getUint32(4, true) !== car) return null;
  const heights = new Float32Array(tileNodes * tileNodes);
  for (let i = 0; i < heights.length; ++i) heights[i] = view.getFloat32(headerBytes.tile + 4 * i, true);
  return { ix: view.getInt32(8, true), iy: view.getInt32(12, true), heights };
}
