// Where one looks from. A rig holds one choice of view and one hand on it; each of its shots applies them to its own
// car, so that views side by side stay alike.
import * as THREE from "three";
import type { Car } from "./car";
import type { GestureListener } from "./gestures";

export type CameraMode = "chase" | "orbit" | "top" | "driver" | "wheel";
export const cameraModes: readonly { readonly mode: CameraMode; readonly label: string; readonly key: string }[] = [
  { mode: "chase", label: "Chase", key: "1" },
  { mode: "orbit", label: "Orbit", key: "2" },
  { mode: "top", label: "Top", key: "3" },
  { mode: "driver", label: "Driver", key: "4" },
  { mode: "wheel", label: "Wheel", key: "5" },
];

// By hand, against each view's own way of looking.
interface Hand {
  azimuth: number; // counterclockwise from above [rad]
  elevation: number; // [rad]
  nearness: number; // factor on the distance
  readonly shift: THREE.Vector3; // of what is looked at, ground axes [m]
}

const untouched = (): Hand => ({ azimuth: 0, elevation: 0, nearness: 1, shift: new THREE.Vector3() });
const upward = new THREE.Vector3(0, 0, 1);
const clearance = 0.3; // above the road [m]
const settling = 3.5; // how fast the chase camera comes round [1/s]
const jump = 30; // farther in one picture than any car drives: the camera follows at once [m]
const stillness = 2e-4; // [rad]

const wrap = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));

// Turned to by hand, a view stays between the ground and the zenith.
const elevationOf = (own: number, hand: Hand): number => THREE.MathUtils.clamp(own + hand.elevation, -0.12, 1.54);

export class Shot {
  readonly camera = new THREE.PerspectiveCamera(38, 1, 0.1, 2500);
  moving = false;
  private heading: number | null = null; // of the chase camera
  private readonly focus = new THREE.Vector3();
  private readonly before = new THREE.Vector3();
  private readonly ahead = new THREE.Vector3();

  constructor(readonly car: Car) {
    this.camera.up.copy(upward);
  }

  place(rig: CameraRig, seconds: number): void {
    const { car, camera } = this;
    const hand = rig.hands[rig.mode];
    car.point(0, car.extent.middle, this.focus);
    this.comeRound(rig.smooth && this.focus.distanceTo(this.before) < jump ? seconds : Infinity);
    this.before.copy(this.focus);
    camera.up.copy(upward);
    const far = car.extent.length;
    switch (rig.mode) {
      case "chase":
        this.around((this.heading ?? 0) + Math.PI, 0.24, 1.15 * far + 2.2, hand);
        break;
      case "orbit":
        this.around(-0.75 * Math.PI, 0.4, 1.2 * far + 2.2, hand);
        break;
      case "top":
        this.fromTop(2.4 * far + 5, hand);
        break;
      case "driver":
        this.driver(hand);
        break;
      case "wheel":
        this.closeUp(rig.wheel, hand);
    }
    if (rig.mode !== "driver") this.stayAbove(rig.roadHeight);
    camera.updateMatrixWorld();
  }

  private comeRound(seconds: number): void {
    const goal = this.car.frames.heading;
    const lag = this.heading === null ? 0 : wrap(this.heading - goal);
    const rest = lag * Math.exp(-settling * seconds);
    this.moving = Math.abs(rest) > stillness;
    this.heading = this.moving ? goal + rest : goal;
  }

  private around(azimuth: number, elevation: number, distance: number, hand: Hand): void {
    const turn = azimuth + hand.azimuth;
    const rise = elevationOf(elevation, hand);
    const flat = Math.cos(rise) * distance * hand.nearness;
    this.focus.add(hand.shift);
    this.camera.position
      .set(Math.cos(turn) * flat, Math.sin(turn) * flat, Math.sin(rise) * distance * hand.nearness)
      .add(this.focus);
    this.look();
  }

  private fromTop(distance: number, hand: Hand): void {
    this.focus.add(hand.shift);
    this.camera.up.set(Math.cos(hand.azimuth), Math.sin(hand.azimuth), 0);
    this.camera.position.copy(this.focus).addScaledVector(upward, distance * hand.nearness);
    this.look();
  }

  private driver(hand: Hand): void {
    const { car, camera } = this;
    const eye = car.extent.eye;
    car.point(0, eye, camera.position);
    const turn = -hand.azimuth;
    const rise = THREE.MathUtils.clamp(hand.elevation - 0.06, -1.2, 1.2);
    const flat = Math.cos(rise);
    car.point(0, [eye[0] + Math.cos(turn) * flat, eye[1] + Math.sin(turn) * flat, eye[2] + Math.sin(rise)], this.focus);
    car.point(0, [eye[0], eye[1], eye[2] + 1], camera.up).sub(camera.position);
    this.look(55 * hand.nearness);
  }

  // From the car's middle plane outward, low: links hide behind the wheel from outside.
  private closeUp(index: number, hand: Hand): void {
    const { car } = this;
    const wheels = car.scene.wheels;
    const wheel = wheels[Math.min(index, wheels.length - 1)];
    if (wheel === undefined) {
      this.around(0, 0.3, car.extent.length, hand);
      return;
    }
    const [x, y, z] = wheel.center;
    const unit = car.scene.frames[wheel.frame]?.unit ?? 0;
    const aft = x < car.extent.middle[0];
    const inward = 0.62 * Math.sign(y) * (aft ? 1 : -1);
    car.point(unit, [x, 0.78 * y, z + 0.25 * wheel.radius], this.focus);
    this.around(car.frames.heading + (aft ? Math.PI : 0) + inward, 0.2, 6.4 * wheel.radius, hand);
  }

  private look(angle = 38): void {
    const { camera } = this;
    camera.lookAt(this.focus);
    const distance = camera.position.distanceTo(this.focus);
    const near = Math.min(Math.max(0.02 * distance, 0.04), 2);
    if (camera.near === near && camera.fov === angle) return;
    camera.near = near;
    camera.fov = angle;
    camera.updateProjectionMatrix();
  }

  private stayAbove(roadHeight: (x: number, y: number) => number): void {
    const { position } = this.camera;
    const lowest = roadHeight(position.x, position.y) + clearance;
    if (position.z >= lowest) return;
    position.z = lowest;
    this.look();
  }

  // Right and up in the picture become a shift on the ground.
  shiftBy(hand: Hand, right: number, up: number): void {
    const { camera } = this;
    const scale = 2 * Math.tan((camera.fov * Math.PI) / 360) * camera.position.distanceTo(this.focus);
    this.ahead.setFromMatrixColumn(camera.matrixWorld, 0).multiplyScalar(-right * scale);
    hand.shift.add(this.ahead);
    this.ahead.setFromMatrixColumn(camera.matrixWorld, 1).multiplyScalar(-up * scale);
    hand.shift.add(this.ahead);
  }
}

export class CameraRig implements GestureListener {
  readonly hands: Record<CameraMode, Hand> = {
    chase: untouched(), orbit: untouched(), top: untouched(), driver: untouched(), wheel: untouched(),
  };
  onChange: () => void = () => {};
  smooth = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  shots: readonly Shot[] = [];
  private chosen: CameraMode = "chase";
  private chosenWheel = 0;

  constructor(readonly roadHeight: (x: number, y: number) => number) {}

  get mode(): CameraMode {
    return this.chosen;
  }
  set mode(mode: CameraMode) {
    this.chosen = mode;
    this.onChange();
  }

  // Which of the scene's wheels the wheel camera shows.
  get wheel(): number {
    return this.chosenWheel;
  }
  set wheel(index: number) {
    this.chosenWheel = index;
    this.onChange();
  }

  get car(): Car | null {
    return this.shots[0]?.car ?? null;
  }

  get moving(): boolean {
    return this.chosen === "chase" && this.shots.some((shot) => shot.moving);
  }

  // One shot for each car.
  follow(...cars: readonly Car[]): void {
    this.shots = cars.map((car) => this.shots.find((shot) => shot.car === car) ?? new Shot(car));
    this.onChange();
  }

  place(seconds: number): void {
    for (let i = 0; i < this.shots.length; ++i) this.shots[i]!.place(this, seconds);
  }

  turn(right: number, up: number): void {
    const hand = this.hands[this.chosen];
    hand.azimuth -= right;
    hand.elevation = THREE.MathUtils.clamp(hand.elevation - up, -1.6, 1.6);
    this.onChange();
  }

  zoom(factor: number): void {
    const hand = this.hands[this.chosen];
    const [nearest, farthest] = this.chosen === "driver" ? [0.4, 1.6] : [0.15, 12];
    hand.nearness = THREE.MathUtils.clamp(hand.nearness * factor, nearest, farthest);
    this.onChange();
  }

  move(right: number, up: number): void {
    if (this.chosen !== "driver") this.shots[0]?.shiftBy(this.hands[this.chosen], right, up);
    this.onChange();
  }

  // Back to each view's own way of looking.
  reset(): void {
    Object.assign(this.hands, { [this.chosen]: untouched() });
    this.onChange();
  }
}
