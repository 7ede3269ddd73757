// Binary messages, read: the row of a car's channels at one instant, and tiles of its road.
import { Channels, displayOf } from "../channels";
import { frameHeader, tileHeader, tileNodes } from "../contract";
import type { CarMessage, ChannelRole, DisplayUnit } from "../contract";
import type { RoadTile } from "../document";
import { unitSymbol } from "../report/numbers";

// A channel in the unit that people read.
export interface Shown {
  readonly unit: string; // "" where there is no such channel
  read(): number; // NaN where there is none
}

// One row, written over by each frame.
export class LiveFrame {
  time = 0; // [s]
  sequence = 0; // of the last input it has felt
  page = 0; // that sent that input
  readonly channels: Channels;
  readonly row: Float32Array;

  constructor(private readonly car: CarMessage) {
    this.channels = new Channels(car.channels);
    this.row = new Float32Array(car.channels.length).fill(NaN);
  }

  // False if the bytes are of another car.
  read(bytes: ArrayBuffer): boolean {
    const view = new DataView(bytes);
    if (view.getUint32(4, true) !== this.car.car) return false;
    this.time = view.getFloat64(8, true);
    this.sequence = view.getUint32(16, true);
    this.page = view.getUint32(20, true);
    const count = Math.min(this.row.length, (bytes.byteLength - frameHeader) / 4);
    for (let i = 0; i < count; ++i) this.row[i] = view.getFloat32(frameHeader + 4 * i, true);
    return true;
  }

  has(role: ChannelRole, of = ""): boolean {
    return this.channels.find(role, of) >= 0;
  }

  // Reads one channel in its own unit; NaN where the car has none.
  reader(role: ChannelRole, of = ""): () => number {
    const column = this.channels.find(role, of);
    return () => this.row[column] ?? NaN;
  }

  display(role: ChannelRole, of = ""): DisplayUnit {
    const channel = this.channels.list[this.channels.find(role, of)];
    if (!channel) return { unit: "", factor: 1 };
    const { unit, factor } = displayOf(channel);
    return { unit: unitSymbol(unit), factor };
  }

  shown(role: ChannelRole, of = ""): Shown {
    const { unit, factor } = this.display(role, of);
    const read = this.reader(role, of);
    return { unit, read: () => factor * read() };
  }

  named(name: string): number {
    return this.row[this.channels.named(name)] ?? NaN;
  }
}

// Null if the bytes are of another car.
export function readTile(bytes: ArrayBuffer, car: number): RoadTile | null {
  const view = new DataView(bytes);
  if (view.getUint32(4, true) !== car) return null;
  const heights = new Float32Array(tileNodes * tileNodes);
  for (let i = 0; i < heights.length; ++i) heights[i] = view.getFloat32(tileHeader + 4 * i, true);
  return { ix: view.getInt32(8, true), iy: view.getInt32(12, true), heights };
}
