// Where everything of a car is: poses of its frames out of a row of channels. Numbers are doubles and measured from the
// car's own place, so that pictures stay sharp kilometers from the origin, where floats of the graphics card would not.
import type { Matrix4 } from "three";
import type { Channels } from "../channels";
import type { Frame, FramePoint } from "../contract";

const components = ["pose_x", "pose_y", "pose_z", "pose_qw", "pose_qx", "pose_qy", "pose_qz"] as const;
const atDesign = [0, 0, 0, 1, 0, 0, 0] as const;
const poseSize = 12; // rotation row after row, then position

export class Frames {
  readonly place = new Float64Array(3); // of the motor vehicle's frame, ground axes [m]
  readonly poses: Float64Array; // of all frames, ground axes, measured from `place`
  private readonly channels: Int32Array;
  private readonly values = new Float64Array(components.length);
  private readonly local = new Float64Array(poseSize);

  constructor(
    private readonly frames: readonly Frame[],
    private readonly units: number,
    channels: Channels,
  ) {
    this.channels = Int32Array.from(
      frames.flatMap(({ name }) => components.map((component) => channels.find(component, name))),
    );
    this.poses = new Float64Array(frames.length * poseSize);
    this.update([]);
  }

  update(row: ArrayLike<number>): void {
    for (let frame = 0; frame < this.frames.length; ++frame) {
      this.read(row, frame);
      if (frame === 0) this.place.set(this.values.subarray(0, 3));
      if (frame < this.units) {
        for (let i = 0; i < 3; ++i) this.values[i]! -= this.place[i]!;
        writePose(this.values, this.poses, frame * poseSize);
      } else {
        writePose(this.values, this.local, 0);
        compose(this.poses, this.frames[frame]!.unit * poseSize, this.local, frame * poseSize);
      }
    }
  }

  // Of a frame's axis, ground axes: component i.
  axis(frame: number, axis: number, i: number): number {
    return this.poses[frame * poseSize + 3 * i + axis]!;
  }

  // A design point of a frame, measured from `place`: component i.
  coordinate(frame: number, x: number, y: number, z: number, i: number): number {
    const at = frame * poseSize;
    const p = this.poses;
    return p[at + 3 * i]! * x + p[at + 3 * i + 1]! * y + p[at + 3 * i + 2]! * z + p[at + 9 + i]!;
  }

  // Takes design points of a frame to their place, measured from `place`.
  matrix(frame: number, out: Matrix4): void {
    const p = this.poses;
    const at = frame * poseSize;
    out.set(
      p[at]!, p[at + 1]!, p[at + 2]!, p[at + 9]!, p[at + 3]!, p[at + 4]!, p[at + 5]!, p[at + 10]!,
      p[at + 6]!, p[at + 7]!, p[at + 8]!, p[at + 11]!, 0, 0, 0, 1,
    );
  }

  // Direction ahead of the motor vehicle [rad].
  get heading(): number {
    return Math.atan2(this.poses[3]!, this.poses[0]!);
  }

  private read(row: ArrayLike<number>, frame: number): void {
    for (let i = 0; i < components.length; ++i) {
      const channel = this.channels[frame * components.length + i]!;
      const value = channel < 0 ? NaN : row[channel];
      this.values[i] = value !== undefined && Number.isFinite(value) ? value : atDesign[i]!;
    }
  }
}

// Quaternions between two rows are not of unit length: divided by it.
function writePose(values: Float64Array, out: Float64Array, at: number): void {
  const w = values[3]!;
  const x = values[4]!;
  const y = values[5]!;
  const z = values[6]!;
  const s = 2 / (w * w + x * x + y * y + z * z || 1);
  out[at] = 1 - s * (y * y + z * z);
  out[at + 1] = s * (x * y - w * z);
  out[at + 2] = s * (x * z + w * y);
  out[at + 3] = s * (x * y + w * z);
  out[at + 4] = 1 - s * (x * x + z * z);
  out[at + 5] = s * (y * z - w * x);
  out[at + 6] = s * (x * z - w * y);
  out[at + 7] = s * (y * z + w * x);
  out[at + 8] = 1 - s * (x * x + y * y);
  for (let i = 0; i < 3; ++i) out[at + 9 + i] = values[i]!;
}

function compose(poses: Float64Array, unit: number, local: Float64Array, out: number): void {
  for (let i = 0; i < 3; ++i) {
    const a = poses[unit + 3 * i]!;
    const b = poses[unit + 3 * i + 1]!;
    const c = poses[unit + 3 * i + 2]!;
    for (let j = 0; j < 3; ++j) poses[out + 3 * i + j] = a * local[j]! + b * local[3 + j]! + c * local[6 + j]!;
    poses[out + 9 + i] = a * local[9]! + b * local[10]! + c * local[11]! + poses[unit + 9 + i]!;
  }
}

// Points that ride on frames.
export class Points {
  readonly at: Float64Array; // x, y, z of each, measured from the frames' place

  constructor(readonly list: readonly FramePoint[]) {
    this.at = new Float64Array(3 * list.length);
  }

  update(frames: Frames): void {
    for (let n = 0; n < this.list.length; ++n) {
      const { frame, point } = this.list[n]!;
      for (let i = 0; i < 3; ++i) this.at[3 * n + i] = frames.coordinate(frame, point[0], point[1], point[2], i);
    }
  }
}
