// Shapes that all cars share, of radius 1 and, along z, of length 1. Wheels lie about y: radius 1, width 1.
import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

const alongZ = (shape: THREE.BufferGeometry): THREE.BufferGeometry => shape.rotateX(Math.PI / 2).translate(0, 0, 0.5);

export const rod = alongZ(new THREE.CylinderGeometry(1, 1, 1, 16));
export const ball = new THREE.SphereGeometry(1, 12, 8);
export const arrowHead = alongZ(new THREE.ConeGeometry(1, 1, 20));

// A coil's wire keeps its thickness whatever its length: attribute `along` tells where the wire's middle is on the
// axis, and position.z how far from it, in radii (paint.ts puts both together).
function makeCoil(turns: number, wire: number): THREE.BufferGeometry {
  const steps = turns * 20;
  const sides = 8;
  const position: number[] = [];
  const normal: number[] = [];
  const along: number[] = [];
  const index: number[] = [];
  const flat = 0.8 / turns; // the last turn lies on its seat
  for (let i = 0; i <= steps; ++i) {
    const t = i / steps;
    const angle = 2 * Math.PI * turns * t;
    const height = 0.03 + 0.94 * THREE.MathUtils.smootherstep(t, flat * 0.3, 1 - flat * 0.3) * 0.25 +
      0.94 * 0.75 * THREE.MathUtils.clamp((t - flat) / (1 - 2 * flat), 0, 1);
    for (let j = 0; j < sides; ++j) {
      const side = (2 * Math.PI * j) / sides;
      const out = Math.cos(side);
      const up = Math.sin(side);
      position.push((1 + wire * out) * Math.cos(angle), (1 + wire * out) * Math.sin(angle), wire * up);
      normal.push(out * Math.cos(angle), out * Math.sin(angle), up);
      along.push(height);
      if (i === steps) continue;
      const a = i * sides + j;
      const b = i * sides + ((j + 1) % sides);
      index.push(a, a + sides, b, b, a + sides, b + sides);
    }
  }
  const shape = new THREE.BufferGeometry();
  shape.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
  shape.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
  shape.setAttribute("along", new THREE.Float32BufferAttribute(along, 1));
  return shape.setIndex(index);
}
export const coil = makeCoil(6, 0.13);

function lathe(profile: readonly (readonly [number, number])[], segments: number): THREE.BufferGeometry {
  return new THREE.LatheGeometry(profile.map(([radius, along]) => new THREE.Vector2(radius, along)), segments);
}

function shaded(shape: THREE.BufferGeometry, shade: (vertex: number) => number): THREE.BufferGeometry {
  const count = shape.getAttribute("position").count;
  const colors = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) colors.fill(shade(i), 3 * i, 3 * i + 3);
  return shape.setAttribute("color", new THREE.BufferAttribute(colors, 3));
}

// Blocks of the tread alternate in shade, so that a wheel seen from behind turns as well.
function makeTire(): THREE.BufferGeometry {
  const half: readonly (readonly [number, number])[] = [
    [0.61, 0.36], [0.645, 0.44], [0.72, 0.485], [0.82, 0.5], [0.91, 0.485], [0.96, 0.45], [0.985, 0.4], [0.994, 0.33],
    [0.997, 0.2], [0.975, 0.185], [0.975, 0.155], [0.999, 0.14],
  ];
  const profile = [...half.map(([radius, along]) => [radius, -along] as const), ...[...half].reverse()];
  const blocks = 48;
  const shape = lathe(profile, 2 * blocks);
  const rows = profile.length;
  return shaded(shape, (i) => {
    const tread = profile[i % rows]![0] > 0.97;
    return tread && Math.floor(i / rows) % 2 === 0 ? 1.9 : 1;
  });
}
export const tire = makeTire();

function makeSpoke(turn: number): THREE.BufferGeometry {
  const spoke = new THREE.BoxGeometry(0.46, 0.09, 0.13);
  const position = spoke.getAttribute("position");
  for (let i = 0; i < position.count; ++i) {
    const outer = position.getX(i) > 0;
    position.setZ(i, position.getZ(i) * (outer ? 1.15 : 0.75));
    position.setY(i, position.getY(i) + (outer ? 0.27 : 0.2));
  }
  return spoke.translate(0.37, 0, 0).rotateY(turn);
}

// Its face looks along +y; barrel, five spokes, hub, and the brake disc behind them.
function makeRim(): THREE.BufferGeometry {
  const barrel = lathe(
    [
      [0.655, -0.44], [0.61, -0.43], [0.585, -0.34], [0.56, -0.3], [0.55, 0], [0.555, 0.25], [0.585, 0.33],
      [0.61, 0.42], [0.655, 0.44],
    ],
    48,
  );
  const spokes = [0, 1, 2, 3, 4].map((i) => makeSpoke((2 * Math.PI * i) / 5));
  const hub = new THREE.CylinderGeometry(0.13, 0.17, 0.22, 24).translate(0, 0.16, 0);
  const disc = new THREE.CylinderGeometry(0.43, 0.43, 0.06, 40).translate(0, -0.08, 0);
  const bell = new THREE.CylinderGeometry(0.2, 0.2, 0.2, 24).translate(0, 0, 0);
  return mergeGeometries([
    shaded(barrel, () => 0.75), ...spokes.map((spoke) => shaded(spoke, () => 1.15)), shaded(hub, () => 1),
    shaded(disc, () => 0.6), shaded(bell, () => 0.5),
  ]);
}
export const rim = makeRim();

// A traffic cone on its foot, and the white band around it.
function makeCone(): THREE.BufferGeometry {
  const foot = new THREE.BoxGeometry(0.28, 0.28, 0.03).translate(0, 0, 0.015);
  const body = new THREE.CylinderGeometry(0.025, 0.11, 0.47, 20, 1).rotateX(Math.PI / 2).translate(0, 0, 0.265);
  return mergeGeometries([foot, body]);
}
export const cone = makeCone();

function makeConeBand(): THREE.BufferGeometry {
  return new THREE.CylinderGeometry(0.053, 0.073, 0.11, 20, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.3);
}
export const coneBand = makeConeBand();
