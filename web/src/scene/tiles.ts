// Tiles of an uneven road: heights as they come, slopes for the light out of their differences.
import * as THREE from "three";
import { tileNodes, tileSize } from "../contract";
import { type RoadTile } from "../document";

const step = tileSize / (tileNodes - 1); // [m]

const plan = (() => {
  const position = new Float32Array(3 * tileNodes * tileNodes);
  const index: number[] = [];
  for (let row = 0; row < tileNodes; ++row) {
    for (let column = 0; column < tileNodes; ++column) {
      const node = row * tileNodes + column;
      position[3 * node] = column * step;
      position[3 * node + 1] = row * step;
      if (row + 1 === tileNodes || column + 1 === tileNodes) continue;
      const above = node + tileNodes;
      index.push(node, node + 1, above, above, node + 1, above + 1);
    }
  }
  return { position: new THREE.BufferAttribute(position, 3), index: new THREE.Uint16BufferAttribute(index, 1) };
})();

function reliefOf(heights: ArrayLike<number>): Float32Array {
  const relief = new Float32Array(3 * tileNodes * tileNodes);
  const last = tileNodes - 1;
  const height = (row: number, column: number): number => heights[row * tileNodes + column]!;
  for (let row = 0; row < tileNodes; ++row) {
    for (let column = 0; column < tileNodes; ++column) {
      const left = Math.max(column - 1, 0);
      const right = Math.min(column + 1, last);
      const below = Math.max(row - 1, 0);
      const above = Math.min(row + 1, last);
      const at = 3 * (row * tileNodes + column);
      relief[at] = height(row, column);
      relief[at + 1] = (height(row, right) - height(row, left)) / ((right - left) * step);
      relief[at + 2] = (height(above, column) - height(below, column)) / ((above - below) * step);
    }
  }
  return relief;
}

export function makeTile(tile: RoadTile, material: THREE.Material): THREE.Mesh {
  const relief = reliefOf(tile.heights);
  const shape = new THREE.BufferGeometry();
  shape.setAttribute("position", plan.position);
  shape.setAttribute("relief", new THREE.BufferAttribute(relief, 3));
  shape.setIndex(plan.index);
  const middle = new THREE.Vector3(tileSize / 2, tileSize / 2, relief[0]!);
  shape.boundingSphere = new THREE.Sphere(middle, tileSize);
  const mesh = new THREE.Mesh(shape, material);
  mesh.position.set(tileSize * tile.ix, tileSize * tile.iy, 0);
  return mesh;
}

// Between the nodes of a tile, x and y measured from its corner [m].
export function tileHeight(heights: ArrayLike<number>, x: number, y: number): number {
  const column = Math.min(Math.max(Math.floor(x / step), 0), tileNodes - 2);
  const row = Math.min(Math.max(Math.floor(y / step), 0), tileNodes - 2);
  const u = x / step - column;
  const v = y / step - row;
  const node = row * tileNodes + column;
  const low = heights[node]! * (1 - u) + heights[node + 1]! * u;
  const high = heights[node + tileNodes]! * (1 - u) + heights[node + tileNodes + 1]! * u;
  return low * (1 - v) + high * v;
}
