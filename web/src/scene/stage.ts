// The view: renderer, sky, road and cars, and one camera for each picture in it. It draws when asked to, never by
// itself.
import * as THREE from "three";
import type { RoadScene } from "../contract";
import type { RoadTile } from "../document";
import { element } from "../dom";
import { onThemeChange } from "../theme";
import { CameraRig, type Shot } from "./camera";
import type { Car } from "./car";
import { listenToGestures } from "./gestures";
import { noMarkings, type Markings } from "./markings";
import { Road } from "./road";
import { Sharpness, drawsInSoftware, paused } from "./sharpness";
import { Sky } from "./sky";
import "./stage.css";

const proving: RoadScene = { name: "", grade: 0, bank: 0, friction: 1, uneven: false, patches: [], cones: [] };

// null: the browser has no WebGL; the host then says so in words.
export function openStage(host: HTMLElement): Stage | null {
  const canvas = element("canvas", {
    class: "stage", tabindex: 0, role: "img", "aria-label": "Three-dimensional view of the vehicle; drag to turn",
  });
  const context = canvas.getContext("webgl2", { antialias: !drawsInSoftware(), powerPreference: "high-performance" });
  if (context !== null) return new Stage(host, canvas, context);
  host.append(
    element("p", { class: "stage-missing", role: "status" },
      "This browser shows no WebGL, which the three-dimensional view needs. Everything else works all the same."),
  );
  return null;
}

export class Stage {
  readonly camera: CameraRig; // pointer, wheel and touch on the view move it; keys are the caller's
  // A new picture is wanted: view resized, theme changed, camera moved.
  onChange: () => void = () => {};
  private readonly renderer: THREE.WebGLRenderer;
  private readonly world = new THREE.Scene();
  private readonly sky = new Sky();
  private readonly road = new Road(proving);
  private readonly cars: Car[] = [];
  private readonly sharpness = new Sharpness();
  private settling: ReturnType<typeof setTimeout> | undefined;
  private apart = false; // each car in its own picture
  private readonly closing: (() => void)[] = [];

  constructor(
    private readonly host: HTMLElement,
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.setScissorTest(true);
    this.renderer.debug.checkShaderErrors = false; // asking waits for the compiler
    this.camera = new CameraRig((x, y) => this.road.height(x, y));
    this.camera.onChange = () => this.onChange();
    this.world.fog = this.sky.haze;
    this.world.add(this.sky.root, this.road.root);
    host.append(canvas);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(host);
    this.closing.push(
      () => observer.disconnect(),
      listenToGestures(canvas, this.camera),
      onThemeChange(() => this.setTheme()),
    );
    this.resize();
  }

  // The camera is still on its way: draw again even if nothing else changed.
  get moving(): boolean {
    return this.camera.moving;
  }

  // The first car is followed.
  add(car: Car): void {
    this.cars.push(car);
    this.world.add(car.root);
    if (this.camera.car === null) this.camera.follow(car);
  }

  // Takes it out of the picture; the caller disposes of it.
  remove(car: Car): void {
    this.cars.splice(this.cars.indexOf(car), 1);
    this.world.remove(car.root);
    const rest = this.camera.shots.map((shot) => shot.car).filter((other) => other !== car);
    this.camera.follow(...rest);
  }

  // Each in its own picture, side by side; []: one picture of all, which follows the first.
  split(cars: readonly Car[]): void {
    this.apart = cars.length > 0;
    const followed = this.apart ? cars : this.cars.slice(0, 1);
    this.camera.follow(...followed);
  }

  // And forgets all tiles.
  setRoad(road: RoadScene, markings: Markings = noMarkings): void {
    this.road.set(road, markings);
    this.onChange();
  }

  // One that is there already is replaced.
  addTile(tile: RoadTile): void {
    this.road.addTile(tile);
    this.onChange();
  }

  // Drops tiles farther than `reach` along either axis [m].
  keepTilesNear(x: number, y: number, reach: number): void {
    this.road.keepTilesNear(x, y, reach);
  }

  clearTiles(): void {
    this.road.clearTiles();
    this.onChange();
  }

  // seconds: of real time since the last call
  render(seconds: number): void {
    if (this.sharpness.observe(seconds)) this.resize();
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.sharpness.rest() && this.resize(), 2000 * paused);
    this.camera.place(seconds);
    const { shots } = this.camera;
    const width = this.canvas.clientWidth / Math.max(shots.length, 1);
    for (let i = 0; i < shots.length; ++i) this.draw(shots[i]!, Math.round(i * width), Math.round((i + 1) * width));
  }

  dispose(): void {
    for (const close of this.closing) close();
    clearTimeout(this.settling);
    this.onChange = () => {};
    this.road.dispose();
    this.sky.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }

  private draw(shot: Shot, left: number, right: number): void {
    const { camera } = shot;
    const height = this.canvas.clientHeight;
    const aspect = Math.max(right - left, 1) / Math.max(height, 1);
    if (Math.abs(camera.aspect - aspect) > 1e-6) {
      camera.aspect = aspect;
      camera.updateProjectionMatrix();
    }
    if (this.apart) for (let i = 0; i < this.cars.length; ++i) this.cars[i]!.root.visible = this.cars[i] === shot.car;
    const within = this.camera.mode === "driver" ? shot.car : null;
    for (const car of this.cars) car.setSeenFromWithin(car === within);
    this.road.center(camera.position.x, camera.position.y);
    this.renderer.setViewport(left, 0, right - left, height);
    this.renderer.setScissor(left, 0, right - left, height);
    this.renderer.render(this.world, camera);
    if (this.apart) for (let i = 0; i < this.cars.length; ++i) this.cars[i]!.root.visible = true;
  }

  private setTheme(): void {
    this.sky.setTheme();
    this.road.setTheme();
    for (const car of this.cars) car.setTheme();
    this.onChange();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.host;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(this.sharpness.ratio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.onChange();
  }
}
