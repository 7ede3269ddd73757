// The car that the wire tells of, in the 3D view. Without WebGL there is none, and the instruments still work.
import type { RoadScene } from "../contract";
import type { RoadTile } from "../document";
import type { CameraMode } from "../scene/camera";
import { Car } from "../scene/car";
import type { CarPart } from "../scene/car";
import { noMarkings } from "../scene/markings";
import type { Stage } from "../scene/stage";
import type { LiveFrame } from "./frame";
import type { CarMessage, TestCourse } from "../contract";

const tileReach = 160; // beyond it tiles are dropped; the program sends them again when they matter [m]
const longestStep = 0.2; // of the wheels' turning, where the picture hangs [s]

// With the cones of a course, each of them once.
function roadOf(road: RoadScene, course: TestCourse | null): RoadScene {
  const cones = new Map([...road.cones, ...(course?.cones ?? [])].map((cone) => [cone.join(" "), cone]));
  return { ...road, cones: [...cones.values()] };
}

export class Picture {
  framesDrawn = 0;
  private car: Car | null = null;
  private carTime = NaN; // [s]
  private place = { x: (): number => NaN, y: (): number => NaN }; // of the car on the ground [m]
  private readonly hidden = new Set<CarPart>();

  constructor(private readonly stage: Stage | null) {}

  setCar({ scene, course = null }: CarMessage, frame: LiveFrame): void {
    const stage = this.stage;
    if (!stage) return;
    if (this.car) {
      stage.remove(this.car);
      this.car.dispose();
    }
    stage.clearTiles();
    stage.setRoad(roadOf(scene.road, course), course ?? noMarkings);
    this.car = new Car(scene, frame.channels);
    for (const part of this.hidden) this.car.show(part, false);
    this.carTime = NaN;
    const chassis = scene.frames[0]?.name;
    this.place = { x: frame.reader("pose_x", chassis), y: frame.reader("pose_y", chassis) };
  }

  addTile(tile: RoadTile): void {
    this.stage?.addTile(tile);
    const [x, y] = [this.place.x(), this.place.y()];
    if (Number.isFinite(x) && Number.isFinite(y)) this.stage?.keepTilesNear(x, y, tileReach);
  }

  show(part: CarPart, on: boolean): void {
    if (on) this.hidden.delete(part);
    else this.hidden.add(part);
    this.car?.show(part, on);
  }

  set camera(mode: CameraMode) {
    if (this.stage) this.stage.camera.mode = mode;
  }

  // A car enters the picture with its first frame: before that nobody knows where it stands.
  move(frame: LiveFrame): void {
    const stage = this.stage;
    if (!this.car || !stage) return;
    const first = Number.isNaN(this.carTime);
    const seconds = first ? 0 : Math.min(Math.max(frame.time - this.carTime, 0), longestStep);
    this.carTime = frame.time;
    this.car.update(frame.row, seconds);
    if (first) stage.add(this.car);
  }

  draw(seconds: number, fresh: boolean): void {
    this.stage?.render(seconds);
    if (fresh) this.framesDrawn += 1;
  }
}
