// The bodies of a vehicle by their styles, and the soft shadow under each.
import * as THREE from "three";
import type { Scene, Wheel } from "../contract";
import { bodyShape } from "./bodies/styles";
import type { Frames } from "./frames";
import type { Paint } from "./paint";

type Box = Scene["bodies"][number];

const margin = 0.45; // of a shadow around its box [m]

// Darkens what is drawn before it, the road alone: neither depth nor order of transparent things matter.
const shadowMaterial = (): THREE.ShaderMaterial =>
  new THREE.ShaderMaterial({
    uniforms: { extent: { value: new THREE.Vector2() }, soft: { value: 2 * margin } },
    vertexShader: `
      varying vec2 at;
      uniform vec2 extent;
      void main() {
        at = position.xy * extent;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec2 at;
      uniform vec2 extent;
      uniform float soft;
      void main() {
        vec2 beyond = max(abs(at) - extent + soft, 0.0);
        float dark = 1.0 - smoothstep(0.0, soft, length(beyond));
        gl_FragColor = vec4(vec3(1.0 - 0.38 * dark), 1.0);
      }`,
    blending: THREE.CustomBlending,
    blendSrc: THREE.ZeroFactor,
    blendDst: THREE.SrcColorFactor,
    depthTest: false,
    depthWrite: false,
  });

class Shell {
  readonly root = new THREE.Group();
  readonly shadow: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.Material | THREE.Material[]>;
  private readonly styled: boolean; // otherwise a box that one always sees through
  private readonly middle: THREE.Vector3;
  private readonly half: THREE.Vector2;
  private readonly disposables: { dispose(): void }[];

  constructor(private readonly box: Box, wheels: readonly Wheel[], private readonly paint: Paint) {
    const low = new THREE.Vector3(...box.low);
    const size = new THREE.Vector3(...box.high).sub(low);
    this.middle = low.clone().addScaledVector(size, 0.5);
    this.half = new THREE.Vector2(size.x / 2 + margin, size.y / 2 + margin);
    const { shape, styled } = bodyShape(box, wheels);
    this.styled = styled;
    this.shadow = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), shadowMaterial());
    this.shadow.material.uniforms["extent"]!.value = this.half;
    this.shadow.renderOrder = -5;
    this.shadow.matrixAutoUpdate = this.root.matrixAutoUpdate = false;
    this.mesh = new THREE.Mesh<THREE.BufferGeometry, THREE.Material | THREE.Material[]>(shape, paint.body);
    this.mesh.renderOrder = 4;
    this.root.add(this.mesh);
    this.setSolid(true);
    this.disposables = [shape, this.shadow.geometry, this.shadow.material];
  }

  setSolid(on: boolean): void {
    const { paint, box } = this;
    if (!this.styled) return;
    this.mesh.material = on ? paint.bodywork(box.style === "box") : paint.outline;
    this.mesh.renderOrder = on ? -1 : 4; // before what it hides, after what is seen through it
  }

  update(frames: Frames, slope: readonly [number, number], ground: number): void {
    frames.matrix(this.box.unit, this.root.matrix);
    this.root.matrixWorldNeedsUpdate = true;
    this.placeShadow(frames, slope, ground);
  }

  dispose(): void {
    for (const thing of this.disposables) thing.dispose();
  }

  private placeShadow(frames: Frames, [grade, bank]: readonly [number, number], ground: number): void {
    const { unit } = this.box;
    const { x: mx, y: my, z: mz } = this.middle;
    const yaw = Math.atan2(frames.axis(unit, 0, 1), frames.axis(unit, 0, 0));
    const cx = Math.cos(yaw) * this.half.x;
    const sx = Math.sin(yaw) * this.half.x;
    const cy = Math.cos(yaw) * this.half.y;
    const sy = Math.sin(yaw) * this.half.y;
    const x = frames.coordinate(unit, mx, my, mz, 0);
    const y = frames.coordinate(unit, mx, my, mz, 1);
    const z = ground + grade * x + bank * y + 0.01;
    this.shadow.matrix.set(
      cx, -sy, 0, x, sx, cy, 0, y, grade * cx + bank * sx, bank * cy - grade * sy, 1, z, 0, 0, 0, 1,
    );
    this.shadow.matrixWorldNeedsUpdate = true;
  }
}

export class Body {
  readonly root = new THREE.Group(); // of the boxes
  readonly shadows = new THREE.Group();
  private readonly shells: readonly Shell[];

  private isSolid = true;

  constructor(scene: Scene, private readonly slope: readonly [number, number], paint: Paint) {
    const unitOf = ({ frame }: Wheel): number => scene.frames[frame]?.unit ?? 0;
    this.shells = scene.bodies.map((box) => new Shell(box, scene.wheels.filter((wheel) => unitOf(wheel) === box.unit), paint));
    this.root.add(...this.shells.map((shell) => shell.root));
    this.shadows.add(...this.shells.map((shell) => shell.shadow));
  }

  set shellsVisible(on: boolean) {
    for (const shell of this.shells) shell.root.visible = on;
  }

  // Otherwise one sees through it to the linkages.
  get solid(): boolean {
    return this.isSolid;
  }
  set solid(on: boolean) {
    this.isSolid = on;
    for (const shell of this.shells) shell.setSolid(on);
  }

  // ground: the road's height under the car, measured from the frames' place, where its slope is taken out
  update(frames: Frames, ground: number): void {
    for (let i = 0; i < this.shells.length; ++i) this.shells[i]!.update(frames, this.slope, ground);
  }

  dispose(): void {
    for (const shell of this.shells) shell.dispose();
  }
}
