// Force of the road on each tire, at the contact: the whole of it, and its share along the ground, which is friction.
import * as THREE from "three";
import type { Channels } from "../channels";
import type { TireTrace } from "../contract";
import type { Paint } from "./paint";
import { writeColumns } from "./pieces";
import * as shapes from "./shapes";

const parts = [
  "contact_x", "contact_y", "contact_z", "ground_force_x", "ground_force_y", "ground_force_z",
] as const;

class Arrows {
  readonly shafts: THREE.InstancedMesh;
  readonly heads: THREE.InstancedMesh;

  constructor(material: THREE.Material, count: number, private readonly radius: number) {
    this.shafts = new THREE.InstancedMesh(shapes.rod, material, count);
    this.heads = new THREE.InstancedMesh(shapes.arrowHead, material, count);
    for (const mesh of [this.shafts, this.heads]) {
      mesh.frustumCulled = false;
      mesh.renderOrder = 10;
      mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    }
  }

  // From a point along a vector [m]; a short arrow is a small one.
  write(n: number, x: number, y: number, z: number, vx: number, vy: number, vz: number): void {
    const length = Math.hypot(vx, vy, vz);
    const shrink = Math.min(1, length / (8 * this.radius));
    const head = Math.min(7 * this.radius * shrink, length);
    const dx = vx / (length || 1);
    const dy = vy / (length || 1);
    const dz = length === 0 ? 1 : vz / length;
    const side = Math.abs(dx) < 0.7 ? 1 : 0; // a direction well off the arrow's
    const shaft = length - head;
    this.lay(this.shafts, n, x, y, z, dx, dy, dz, shaft, this.radius * shrink, side);
    const wide = 2.6 * this.radius * shrink;
    this.lay(this.heads, n, x + shaft * dx, y + shaft * dy, z + shaft * dz, dx, dy, dz, head, wide, side);
  }

  private lay(
    mesh: THREE.InstancedMesh, n: number, x: number, y: number, z: number, dx: number, dy: number, dz: number,
    length: number, radius: number, side: number,
  ): void {
    const out = mesh.instanceMatrix.array as Float32Array;
    writeColumns(out, 16 * n, x, y, z, dx, dy, dz, length, radius, side, 1 - side, 0);
    mesh.instanceMatrix.needsUpdate = true;
  }
}

export class Forces {
  readonly root = new THREE.Group();
  private readonly channels: Int32Array; // contact x, y, z, force x, y, z of each tire
  private readonly whole: Arrows;
  private readonly friction: Arrows;
  private readonly values = new Float64Array(6);

  constructor(
    private readonly tires: readonly TireTrace[],
    channels: Channels,
    private readonly slope: readonly [number, number], // of the road: rise along x and y
    size: number,
    paint: Paint,
  ) {
    this.channels = Int32Array.from(tires.flatMap(({ name }) => parts.map((part) => channels.find(part, name))));
    this.whole = new Arrows(paint.force, tires.length, 0.016 * size);
    this.friction = new Arrows(paint.friction, tires.length, 0.011 * size);
    this.root.add(this.friction.shafts, this.friction.heads, this.whole.shafts, this.whole.heads);
  }

  update(row: ArrayLike<number>, place: Float64Array, newtonsPerMeter: number): void {
    const [grade, bank] = this.slope;
    const v = this.values;
    for (let n = 0; n < this.tires.length; ++n) {
      this.read(row, n, place, newtonsPerMeter);
      const normal = (v[5]! - grade * v[3]! - bank * v[4]!) / (1 + grade * grade + bank * bank);
      this.whole.write(n, v[0]!, v[1]!, v[2]!, v[3]!, v[4]!, v[5]!);
      this.friction.write(
        n, v[0]!, v[1]!, v[2]! + 0.01, v[3]! + normal * grade, v[4]! + normal * bank, v[5]! - normal,
      );
    }
  }

  dispose(): void {
    for (const arrows of [this.whole, this.friction]) {
      arrows.shafts.dispose();
      arrows.heads.dispose();
    }
  }

  // A tire in the air may have no contact: then there is no arrow.
  private read(row: ArrayLike<number>, n: number, place: Float64Array, newtonsPerMeter: number): void {
    const v = this.values;
    for (let i = 0; i < 6; ++i) {
      const value = row[this.channels[6 * n + i]!] ?? NaN;
      if (!Number.isFinite(value)) {
        v.fill(0);
        return;
      }
      v[i] = i < 3 ? value - place[i]! : value / newtonsPerMeter;
    }
  }
}
