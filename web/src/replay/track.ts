// One run over time: its columns, and its channels' values at any time between its rows.
import { Channels } from "../channels";
import type { Channel, Run } from "../contract";
import type { LoadedDocument } from "../document";

export type Column = Float64Array | Float32Array;

const quaternion = ["pose_qw", "pose_qx", "pose_qy", "pose_qz"] as const;

// Channels of quaternions that stand together; q and -q are one rotation, so a step between them is no motion.
function quaternionsOf(channels: Channels): Int32Array {
  const owners = channels.list.flatMap(({ role, of = "" }) => (role === "pose_qw" ? [of] : []));
  return Int32Array.from(owners.flatMap((of) => quaternion.map((part) => channels.find(part, of))));
}

export class Track {
  readonly time: Float64Array;
  readonly channels: Channels;
  readonly row: Float64Array; // of all channels at the time last sampled
  at = NaN; // that time, held at the run's ends [s]
  private readonly columns: readonly Column[];
  private readonly quaternions: Int32Array;
  private last = 0; // row found last

  constructor(readonly run: Run, readonly index: number, loaded: LoadedDocument) {
    this.columns = run.channels.map(({ column }) => loaded.column(column));
    this.time = Float64Array.from(this.columns[0] ?? []);
    this.channels = new Channels(run.channels);
    this.row = new Float64Array(run.channels.length);
    this.quaternions = quaternionsOf(this.channels);
  }

  get start(): number {
    return this.time[0] ?? 0;
  }
  get end(): number {
    return this.time[this.time.length - 1] ?? 0;
  }

  channel(name: string): Channel | null {
    return this.channels.list[this.channels.named(name)] ?? null;
  }
  column(name: string): Column | null {
    return this.columns[this.channels.named(name)] ?? null;
  }

  // Linear between rows; before the first and after the last the run stands still.
  sample(time: number): void {
    this.at = Math.min(Math.max(time, this.start), this.end);
    const from = this.find(this.at);
    const to = Math.min(from + 1, this.time.length - 1);
    const span = this.time[to]! - this.time[from]!;
    const share = span > 0 ? (this.at - this.time[from]!) / span : 0;
    for (let i = 0; i < this.row.length; ++i) {
      const column = this.columns[i]!;
      const low = column[from]!;
      this.row[i] = share === 0 ? low : low + share * (column[to]! - low);
    }
    if (share > 0) this.turnTheShortWay(from, to, share);
  }

  // The last row not after a time; mostly it is near the one before.
  find(time: number): number {
    const { time: times } = this;
    const end = times.length - 1;
    let low = this.last;
    if (!(low <= end && times[low]! <= time)) low = 0;
    for (let step = 1; low + step <= end && times[low + step]! <= time; step *= 2) low += step;
    let high = end;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle]! <= time) low = middle;
      else high = middle - 1;
    }
    this.last = Math.max(low, 0);
    return this.last;
  }

  private turnTheShortWay(from: number, to: number, share: number): void {
    for (let q = 0; q + 3 < this.quaternions.length; q += 4) {
      let along = 0;
      for (let i = q; i < q + 4; ++i) {
        const column = this.columns[this.quaternions[i]!];
        along += column === undefined ? 0 : column[from]! * column[to]!;
      }
      if (along >= 0) continue;
      for (let i = q; i < q + 4; ++i) {
        const channel = this.quaternions[i]!;
        const column = this.columns[channel];
        if (column !== undefined) this.row[channel] = (1 - share) * column[from]! - share * column[to]!;
      }
    }
  }
}
