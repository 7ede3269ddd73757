// What one plot shows: channels of one run that differ in their first word alone (wheel loads of four wheels), or one
// channel of all runs; on one base of time, thinned where there are more rows than pixels by far.
import { displayOf, isMotion } from "../channels";
import type { Channel, ChannelRole } from "../contract";
import { largest, raisePowers, withoutRoundOff } from "../report/numbers";
import type { Column, Track } from "./track";

const mostRows = 40_000; // drawn as they are
const thinned = 8_000; // stretches, each by its lowest and its highest value

export interface Curve {
  readonly label: string;
  readonly color: number; // of the series
  readonly track: Track;
  readonly channel: string;
}

export interface Sheet {
  readonly title: string; // "tire vertical force"
  readonly axis: string; // with its unit
  readonly curves: readonly Curve[];
}

export const words = (name: string): string => name.replaceAll("_", " ").replaceAll(".", " ");
const headOf = (name: string): string => name.slice(0, Math.max(name.indexOf("."), 0));
const tailOf = (name: string): string => name.slice(name.indexOf(".") + 1);

// In brackets, as people read it; "" where the channel has none, or is none.
export function unitText(channel: Channel | null | undefined): string {
  const { unit } = channel ? displayOf(channel) : { unit: "" };
  return unit === "1" || unit === "" ? "" : ` [${raisePowers(unit)}]`;
}

function comparing(name: string, tracks: readonly Track[]): Sheet {
  const having = tracks.filter((track) => track.channel(name) !== null);
  return {
    title: words(name),
    axis: words(name) + unitText(having[0]?.channel(name)),
    curves: having.map((track) => ({ label: track.run.name, color: track.index, track, channel: name })),
  };
}

function together(names: readonly string[], track: Track): Sheet {
  const [first = ""] = names;
  const alone = names.length === 1;
  const title = words(alone ? first : tailOf(first));
  return {
    title,
    axis: title + unitText(track.channel(first)),
    curves: names.map((name, i) => ({ label: alone ? "" : words(headOf(name)), color: i, track, channel: name })),
  };
}

export function sheetsOf(names: readonly string[], tracks: readonly Track[]): Sheet[] {
  const [only] = tracks;
  if (tracks.length !== 1 || only === undefined) return names.map((name) => comparing(name, tracks));
  const groups = new Map<string, string[]>();
  for (const name of names) {
    const key = `${tailOf(name)} ${only.channel(name)?.unit ?? ""}`;
    groups.set(key, [...(groups.get(key) ?? []), name]);
  }
  return [...groups.values()].map((group) => together(group, only));
}

// In the unit that people read.
function columnOf({ track, channel }: Curve): Column {
  const column = track.column(channel) ?? new Float64Array(track.time.length);
  const found = track.channel(channel);
  const { factor } = found ? displayOf(found) : { factor: 1 };
  const size = largest(column);
  return Float64Array.from(column, (value) => factor * withoutRoundOff(value, size));
}

// Lowest and highest of each stretch of rows, in the order in which they come.
function thin(time: Float64Array, columns: readonly Column[]): { time: Float64Array; columns: Float64Array[] } {
  const rows = time.length;
  const few = new Float64Array(2 * thinned);
  const outs = columns.map(() => new Float64Array(2 * thinned));
  for (let n = 0; n < thinned; ++n) {
    const from = Math.floor((n * rows) / thinned);
    const to = Math.floor(((n + 1) * rows) / thinned);
    few[2 * n] = time[from]!;
    few[2 * n + 1] = time[(from + to) >> 1]!;
    columns.forEach((column, i) => {
      let low = from;
      let high = from;
      for (let row = from + 1; row < to; ++row) {
        if (column[row]! < column[low]!) low = row;
        if (column[row]! > column[high]!) high = row;
      }
      outs[i]![2 * n] = column[Math.min(low, high)]!;
      outs[i]![2 * n + 1] = column[Math.max(low, high)]!;
    });
  }
  return { time: few, columns: outs };
}

const sameTimes = (a: Float64Array, b: Float64Array): boolean =>
  a.length === b.length && a.every((time, i) => time === b[i]);

function onto(times: Float64Array, curve: Curve): Float64Array {
  const { track } = curve;
  const column = columnOf(curve);
  const out = new Float64Array(times.length).fill(NaN);
  for (let i = 0; i < times.length; ++i) {
    const time = times[i]!;
    if (time < track.start || time > track.end) continue;
    const from = track.find(time);
    const to = Math.min(from + 1, column.length - 1);
    const span = track.time[to]! - track.time[from]!;
    out[i] = column[from]! + (span > 0 ? ((time - track.time[from]!) / span) * (column[to]! - column[from]!) : 0);
  }
  return out;
}

function evenTimes(curves: readonly Curve[]): Float64Array {
  const start = Math.min(...curves.map(({ track }) => track.start));
  const end = Math.max(...curves.map(({ track }) => track.end));
  const rows = Math.min(Math.max(...curves.map(({ track }) => track.time.length), 2), mostRows);
  return Float64Array.from({ length: rows }, (_, i) => start + ((end - start) * i) / (rows - 1));
}

export function dataOf(curves: readonly Curve[]): { time: Float64Array; columns: readonly Column[] } {
  const own = curves[0]?.track.time ?? new Float64Array(0);
  if (curves.every(({ track }) => track.time === own || sameTimes(track.time, own))) {
    const columns = curves.map(columnOf);
    return own.length > mostRows ? thin(own, columns) : { time: own, columns };
  }
  const time = evenTimes(curves);
  return { time, columns: curves.map((curve) => onto(time, curve)) };
}

// Speed, lateral acceleration, yaw rate, wheel loads: what one looks at first, where the run has it. Where a controller intervenes
// its activity too, and the pressures that it may have acted on.
export function firstChoice(tracks: readonly Track[]): string[] {
  const all = [...new Map(tracks.flatMap(({ run }) => run.channels.map((one) => [one.name, one]))).values()];
  const having = (wanted: ChannelRole): string[] => all.filter(({ role }) => role === wanted).map(({ name }) => name);
  const first = ["longitudinal_velocity", "lateral_acceleration", "yaw_rate"] as const;
  const intervenes = (name: string): boolean => tracks.some((track) => largest(track.column(name) ?? []) > 0);
  const controllers = having("controller_activity").filter(intervenes);
  const pressures = controllers.length > 0 ? having("brake_pressure").slice(0, 8) : [];
  const chosen = [...first.flatMap(having), ...having("vertical_force").slice(0, 8), ...controllers, ...pressures];
  if (chosen.length > 0) return chosen;
  return all.filter((channel) => channel.name !== "time" && !isMotion(channel)).map(({ name }) => name).slice(0, 4);
}
