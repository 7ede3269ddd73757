// Wheels ride on their carriers' frames, which steer, camber and lift them; their own spin turns them about their axis.
import * as THREE from "three";
import type { Channels } from "../channels";
import type { Wheel } from "../contract";
import type { Frames } from "./frames";
import type { Paint } from "./paint";
import * as shapes from "./shapes";

interface Mount {
  readonly wheel: Wheel;
  readonly spin: number; // channel, -1: none
  readonly rate: number; // of one of its units [rad/s]
  readonly ahead: readonly [number, number, number]; // across the axis, carrier's frame
  readonly up: readonly [number, number, number];
  readonly side: number; // its face looks outboard: 1 on the left, -1 on the right
  angle: number; // turned so far [rad]
}

function mount(wheel: Wheel, channels: Channels): Mount {
  const axis = new THREE.Vector3(...wheel.axis).normalize();
  const ahead = new THREE.Vector3().crossVectors(axis, new THREE.Vector3(0, 0, 1)).normalize();
  const up = new THREE.Vector3().crossVectors(ahead, axis);
  const spin = channels.find("wheel_spin", wheel.name);
  return {
    wheel,
    spin,
    rate: channels.list[spin]?.unit === "rpm" ? Math.PI / 30 : 1,
    ahead: [ahead.x, ahead.y, ahead.z],
    up: [up.x, up.y, up.z],
    side: wheel.center[1] < 0 ? -1 : 1,
    angle: 0,
  };
}

export class Wheels {
  readonly root = new THREE.Group();
  private readonly mounts: readonly Mount[];
  private readonly tires: THREE.InstancedMesh;
  private readonly rims: THREE.InstancedMesh;

  constructor(wheels: readonly Wheel[], channels: Channels, paint: Paint) {
    this.mounts = wheels.map((wheel) => mount(wheel, channels));
    const count = wheels.reduce((sum, wheel) => sum + wheel.tires.length, 0);
    this.tires = new THREE.InstancedMesh(shapes.tire, paint.rubber, count);
    this.rims = new THREE.InstancedMesh(shapes.rim, paint.rim, count);
    this.rims.instanceMatrix = this.tires.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    for (const mesh of [this.tires, this.rims]) mesh.frustumCulled = false;
    this.root.add(this.tires, this.rims);
  }

  update(frames: Frames, row: ArrayLike<number>, seconds: number): void {
    let n = 0;
    for (let m = 0; m < this.mounts.length; ++m) {
      const mount = this.mounts[m]!;
      const spin = mount.spin < 0 ? 0 : row[mount.spin] ?? 0;
      if (Number.isFinite(spin)) mount.angle = (mount.angle + spin * mount.rate * seconds) % (2 * Math.PI);
      for (let t = 0; t < mount.wheel.tires.length; ++t) this.write(frames, mount, mount.wheel.tires[t]!, n++);
    }
    this.tires.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.tires.dispose();
    this.rims.dispose();
  }

  // Half a turn about the vertical turns the face outboard; mirroring would turn the shape inside out.
  private write(frames: Frames, { wheel, ahead, up, side, angle }: Mount, offset: number, n: number): void {
    const out = this.tires.instanceMatrix.array;
    const { frame, center, axis, radius, width } = wheel;
    const cos = Math.cos(angle) * radius;
    const sin = Math.sin(angle) * radius;
    for (let i = 0; i < 3; ++i) {
      const a = frames.axis(frame, 0, i);
      const b = frames.axis(frame, 1, i);
      const c = frames.axis(frame, 2, i);
      const x = a * ahead[0] + b * ahead[1] + c * ahead[2];
      const y = a * axis[0] + b * axis[1] + c * axis[2];
      const z = a * up[0] + b * up[1] + c * up[2];
      out[16 * n + i] = side * (cos * x - sin * z);
      out[16 * n + 4 + i] = side * width * y;
      out[16 * n + 8 + i] = sin * x + cos * z;
      out[16 * n + 12 + i] = frames.coordinate(frame, center[0], center[1], center[2], i) + offset * y;
    }
    out[16 * n + 15] = 1;
  }
}
