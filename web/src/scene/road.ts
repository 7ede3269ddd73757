// The road in the picture: an endless plane, tiles over it where it is uneven, cones.
import * as THREE from "three";
import { tileSize, type RoadScene } from "../contract";
import { type RoadTile } from "../document";
import { color } from "../theme";
import { GroundPaint } from "./ground";
import { MarkingPaint, noMarkings, type Markings } from "./markings";
import * as shapes from "./shapes";
import { makeTile, tileHeight } from "./tiles";

const reach = 2000; // of the plane around the one who looks [m]
const stride = 100; // it follows by whole strides, so that its grid stays where it is [m]

interface Laid {
  readonly mesh: THREE.Mesh;
  readonly heights: ArrayLike<number>;
}

const keyOf = (ix: number, iy: number): string => `${ix} ${iy}`;

// Triangles grow with distance: floats interpolate finely where one looks.
function planeShape(): THREE.BufferGeometry {
  const shape = new THREE.PlaneGeometry(2, 2, 40, 40);
  const position = shape.getAttribute("position");
  const spread = (t: number): number => reach * Math.sign(t) * Math.abs(t) ** 3;
  for (let i = 0; i < position.count; ++i) position.setXY(i, spread(position.getX(i)), spread(position.getY(i)));
  return shape;
}

export class Road {
  readonly root = new THREE.Group();
  private paint: GroundPaint;
  private readonly plane: THREE.Mesh;
  private readonly tiles = new Map<string, Laid>();
  private readonly markings = new MarkingPaint();
  private cones: THREE.InstancedMesh[] = [];
  private readonly coneMaterial = new THREE.MeshStandardMaterial({ roughness: 0.7 });
  private readonly bandMaterial = new THREE.MeshStandardMaterial({ roughness: 0.6, color: 0xf4f2ee });

  constructor(private road: RoadScene) {
    this.paint = new GroundPaint(road);
    this.plane = new THREE.Mesh(planeShape(), this.paint.plane);
    this.plane.frustumCulled = false;
    this.plane.renderOrder = -10;
    this.root.add(this.plane, this.markings.root);
    this.set(road);
  }

  set(road: RoadScene, markings: Markings = noMarkings): void {
    this.clearTiles();
    this.road = road;
    this.paint.dispose();
    this.paint = new GroundPaint(road);
    this.plane.material = this.paint.plane;
    // Tiles may lie below the plane that stands in for the rest of an uneven road.
    this.paint.plane.depthWrite = !road.uneven;
    this.layCones();
    this.markings.set(markings, (x, y) => this.height(x, y));
    this.setTheme();
  }

  addTile(tile: RoadTile): void {
    const key = keyOf(tile.ix, tile.iy);
    this.drop(this.tiles.get(key));
    const mesh = makeTile(tile, this.paint.tile);
    mesh.renderOrder = -8;
    this.root.add(mesh);
    this.tiles.set(key, { mesh, heights: tile.heights });
    if (this.cones.length > 0) this.standCones();
    this.markings.lay();
  }

  // Drops tiles farther than `reach` along either axis.
  keepTilesNear(x: number, y: number, reach: number): void {
    for (const [key, tile] of this.tiles) {
      const { position } = tile.mesh;
      if (Math.max(Math.abs(position.x - x), Math.abs(position.y - y)) < reach) continue;
      this.drop(tile);
      this.tiles.delete(key);
    }
  }

  clearTiles(): void {
    for (const tile of this.tiles.values()) this.drop(tile);
    this.tiles.clear();
  }

  height(x: number, y: number): number {
    const ix = Math.floor(x / tileSize);
    const iy = Math.floor(y / tileSize);
    const tile = this.tiles.get(keyOf(ix, iy));
    if (tile === undefined) return this.road.grade * x + this.road.bank * y;
    return tileHeight(tile.heights, x - tileSize * ix, y - tileSize * iy);
  }

  // Keeps the plane under the one who looks.
  center(x: number, y: number): void {
    const px = stride * Math.round(x / stride);
    const py = stride * Math.round(y / stride);
    this.plane.position.set(px, py, this.road.grade * px + this.road.bank * py);
  }

  setTheme(): void {
    this.paint.setTheme();
    this.coneMaterial.color.set(color("cone"));
    this.markings.setTheme();
  }

  dispose(): void {
    this.clearTiles();
    this.dropCones();
    for (const thing of [this.paint, this.markings, this.plane.geometry, this.coneMaterial, this.bandMaterial]) thing.dispose();
  }

  private drop(tile: Laid | undefined): void {
    if (tile === undefined) return;
    this.root.remove(tile.mesh);
    // Its own heights alone: the plan and the index are every tile's.
    tile.mesh.geometry.deleteAttribute("position").setIndex(null).dispose();
  }

  private dropCones(): void {
    for (const mesh of this.cones) {
      this.root.remove(mesh);
      mesh.dispose();
    }
    this.cones = [];
  }

  private layCones(): void {
    this.dropCones();
    const count = this.road.cones.length;
    if (count === 0) return;
    this.cones = [
      new THREE.InstancedMesh(shapes.cone, this.coneMaterial, count),
      new THREE.InstancedMesh(shapes.coneBand, this.bandMaterial, count),
    ];
    this.root.add(...this.cones);
    this.standCones();
  }

  private standCones(): void {
    const matrix = new THREE.Matrix4();
    this.road.cones.forEach(([x, y], n) => {
      matrix.makeTranslation(x, y, this.height(x, y));
      for (const mesh of this.cones) mesh.setMatrixAt(n, matrix);
    });
    for (const mesh of this.cones) {
      mesh.instanceMatrix.needsUpdate = true;
      mesh.computeBoundingSphere();
    }
  }
}
