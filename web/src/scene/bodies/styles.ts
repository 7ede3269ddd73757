// Every style of body, and which shape it makes.
import * as THREE from "three";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import type { BodyBox, BodyStyle, Wheel } from "../../contract";
import { buildOpenWheeler } from "./open_wheeler";
import { planOf, type Plan } from "./plan";
import { buildShell, type ShellStyle } from "./shell";
import type { Surface } from "./surface";
import { buildBox, buildTruck } from "./truck";

const plainWidth = [[0, 0.84], [0.12, 0.93], [0.5, 0.985], [1, 1], [2, 1], [2.6, 0.98], [2.9, 0.93], [3, 0.85]] as const;

const sedan: ShellStyle = {
  deck: [[0, 0.52], [0.06, 0.57], [0.7, 0.635], [1.28, 0.675], [2.45, 0.695], [2.6, 0.69], [2.92, 0.665], [3, 0.62]],
  width: plainWidth, square: 5, trim: 0.29,
  cabin: { base: [1.22, 2.5], roof: [1.56, 2.14], pillars: [0.47], solidRear: 0.86, inset: [0.93, 0.71] },
};
const hatchback: ShellStyle = {
  deck: [[0, 0.46], [0.07, 0.55], [0.7, 0.63], [1.1, 0.665], [2.4, 0.7], [2.9, 0.71], [3, 0.66]],
  width: plainWidth, square: 4.5, trim: 0.27,
  cabin: { base: [1.05, 2.92], roof: [1.45, 2.66], pillars: [0.4, 0.72], solidRear: 0.86, inset: [0.94, 0.72] },
};
const offRoader: ShellStyle = {
  deck: [[0, 0.53], [0.05, 0.57], [1.2, 0.6], [3, 0.61]],
  width: [[0, 0.9], [0.1, 0.96], [0.4, 1], [2.9, 1], [3, 0.98]], square: 9, trim: 0.36,
  cabin: { base: [1.28, 2.98], roof: [1.42, 2.95], pillars: [0.28, 0.56], solidRear: 0.93, inset: [0.97, 0.87] },
};
const pickup: ShellStyle = {
  deck: [[0, 0.54], [0.06, 0.6], [0.8, 0.645], [1.12, 0.665], [1.9, 0.675], [1.94, 0.66], [3, 0.66]],
  width: [[0, 0.88], [0.1, 0.95], [0.5, 0.99], [1, 1], [2.9, 0.99], [3, 0.95]], square: 6, trim: 0.34,
  cabin: { base: [1.1, 1.9], roof: [1.34, 1.82], pillars: [0.55], solidRear: 0.93, inset: [0.94, 0.74] },
  bed: [1.95, 2.96],
};
const van: ShellStyle = {
  deck: [[0, 0.4], [0.1, 0.47], [0.7, 0.54], [1.1, 0.56], [3, 0.56]],
  width: [[0, 0.86], [0.12, 0.95], [0.5, 1], [2.9, 1], [3, 0.97]], square: 7, trim: 0.24,
  cabin: { base: [0.75, 2.98], roof: [1.22, 2.94], pillars: [0.3], solidRear: 0.42, inset: [0.97, 0.86] },
};

const builders: Readonly<Record<BodyStyle, (plan: Plan) => Surface>> = {
  sedan: (plan) => buildShell(plan, sedan),
  hatchback: (plan) => buildShell(plan, hatchback),
  off_roader: (plan) => buildShell(plan, offRoader),
  pickup: (plan) => buildShell(plan, pickup),
  van: (plan) => buildShell(plan, van),
  truck: buildTruck,
  box: buildBox,
  open_wheeler: buildOpenWheeler,
};

function roundedBox({ low, high }: BodyBox): THREE.BufferGeometry {
  const corner = new THREE.Vector3(...low);
  const size = new THREE.Vector3(...high).sub(corner);
  const radius = 0.14 * Math.min(size.x, size.y, size.z);
  const middle = corner.addScaledVector(size, 0.5);
  return new RoundedBoxGeometry(size.x, size.y, size.z, 5, radius).translate(...middle.toArray());
}

// wheels: of the same unit. Null where the vehicle's file tells no style, and a rounded box must do.
export function bodyShape(box: BodyBox, wheels: readonly Wheel[]): { shape: THREE.BufferGeometry; styled: boolean } {
  if (box.style === undefined) return { shape: roundedBox(box), styled: false };
  return { shape: builders[box.style](planOf(box, wheels)).build(), styled: true };
}
