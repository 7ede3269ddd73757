// One vehicle drawn from its own hardpoints: the motor vehicle and what it pulls.
import * as THREE from "three";
import type { Channels } from "../channels";
import type { Scene } from "../contract";
import { Body } from "./body";
import { Forces } from "./forces";
import { Frames } from "./frames";
import { Links } from "./links";
import { Paint, plainLook, type CarLook } from "./paint";
import { Wheels } from "./wheels";

export { plainLook, type CarLook };
// solid: the body hides what is behind it.
export type CarPart = "body" | "solid" | "forces" | "suspension" | "wheels";

// Design extents of the motor vehicle and of the whole, for cameras [m].
export interface Extent {
  readonly middle: readonly [number, number, number]; // of the motor vehicle
  readonly eye: readonly [number, number, number]; // about where a driver's is
  readonly length: number; // of the whole
}

const meanRadius = (scene: Scene): number =>
  scene.wheels.reduce((sum, wheel) => sum + wheel.radius, 0) / Math.max(scene.wheels.length, 1) || 0.3;

function extentOf(scene: Scene): Extent {
  const own = scene.wheels.filter(({ frame }) => (scene.frames[frame]?.unit ?? 0) === 0);
  const body = scene.bodies.find(({ unit }) => unit === 0);
  const along = scene.wheels.map(({ center }) => center[0]);
  const ownAlong = own.map(({ center }) => center[0]);
  const front = Math.max(...ownAlong, ...(body ? [body.high[0]] : []));
  const rear = Math.min(...ownAlong, ...(body ? [body.low[0]] : []));
  const last = Math.min(rear, ...along, ...scene.bodies.map(({ low }) => low[0]));
  const top = body?.high[2] ?? 1.3;
  const half = body ? body.high[1] : Math.max(...own.map(({ center }) => center[1]), 0.7);
  const frontAxle = Math.max(...ownAlong, 0);
  const wheelbase = frontAxle - Math.min(...ownAlong, 0);
  return {
    middle: [(front + rear) / 2, 0, 0.42 * top],
    eye: [frontAxle - Math.min(0.52 * wheelbase, 1.5), 0.42 * half, 0.8 * top],
    length: front - last,
  };
}

export class Car {
  readonly root = new THREE.Group();
  readonly extent: Extent;
  readonly frames: Frames;
  newtonsPerMeter: number; // of the force arrows; set by the size of its wheels
  private readonly paint: Paint;
  private readonly links: Links;
  private readonly wheels: Wheels;
  private readonly forces: Forces;
  private readonly body: Body;
  private readonly heights: readonly number[]; // channels: contact's height of each tire
  private readonly slope: readonly [number, number];

  constructor(readonly scene: Scene, channels: Channels, look: CarLook = plainLook) {
    const radius = meanRadius(scene);
    const size = radius / 0.3;
    this.slope = [scene.road.grade, scene.road.bank];
    this.newtonsPerMeter = radius > 0.42 ? 30e3 : 6e3;
    this.extent = extentOf(scene);
    this.frames = new Frames(scene.frames, scene.units, channels);
    this.paint = new Paint(look);
    this.links = new Links(scene.links, size, this.paint);
    this.wheels = new Wheels(scene.wheels, channels, this.paint);
    this.forces = new Forces(scene.tires, channels, this.slope, size, this.paint);
    this.body = new Body(scene, this.slope, this.paint);
    this.heights = scene.tires.map(({ name }) => channels.find("contact_z", name));
    this.root.add(this.body.shadows, this.links.root, this.wheels.root, this.body.root, this.forces.root);
  }

  // row[i] is the value of channel i; seconds of the picture since the last call turn the wheels by their spin.
  update(row: ArrayLike<number>, seconds: number): void {
    const { frames } = this;
    frames.update(row);
    this.root.position.set(frames.place[0]!, frames.place[1]!, frames.place[2]!);
    this.links.update(frames);
    this.wheels.update(frames, row, seconds);
    this.forces.update(row, frames.place, this.newtonsPerMeter);
    this.body.update(frames, this.groundUnder(row));
  }

  // A point of a unit's body, ground axes.
  point(unit: number, point: readonly [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    const [x, y, z] = point;
    const { frames } = this;
    return out.set(
      frames.place[0]! + frames.coordinate(unit, x, y, z, 0),
      frames.place[1]! + frames.coordinate(unit, x, y, z, 1),
      frames.place[2]! + frames.coordinate(unit, x, y, z, 2),
    );
  }

  show(part: CarPart, on: boolean): void {
    if (part === "solid") this.body.solid = on;
    else this.part(part).visible = on;
  }

  shows(part: CarPart): boolean {
    return part === "solid" ? this.body.solid : this.part(part).visible;
  }

  // A driver sees the road, not the inside of a shell.
  setSeenFromWithin(on: boolean): void {
    this.body.shellsVisible = !on;
  }

  setGhost(on: boolean): void {
    this.paint.setGhost(on);
  }

  setTheme(): void {
    this.paint.setTheme();
  }

  dispose(): void {
    for (const part of [this.links, this.wheels, this.forces, this.body, this.paint]) part.dispose();
  }

  private part(part: Exclude<CarPart, "solid">): THREE.Group {
    return { body: this.body, forces: this.forces, suspension: this.links, wheels: this.wheels }[part].root;
  }

  // The road's height at `place`, measured from there: the mean of all contacts', an even road's where there is none.
  private groundUnder(row: ArrayLike<number>): number {
    const [grade, bank] = this.slope;
    const { place } = this.frames;
    const even = grade * place[0]! + bank * place[1]! - place[2]!;
    if (!this.scene.road.uneven) return even;
    let sum = 0;
    let count = 0;
    for (let i = 0; i < this.heights.length; ++i) {
      const height = row[this.heights[i]!];
      if (height === undefined || !Number.isFinite(height)) continue;
      sum += height - place[2]!;
      ++count;
    }
    return count === 0 ? even : sum / count;
  }
}
