// Speed, steering, pedals and how the car answers.
import { element } from "../dom";
import type { LiveFrame, Shown } from "./frame";
import { bar, figure, readout, withUnit, write } from "./gauge";
import { GearSign } from "./gear";
import { GravityCircle } from "./gravity";
import type { CarMessage } from "../contract";
import { Tachometers } from "./tachometer";

const usualTorque = 2000; // at the driven wheels together, until a car has more [N m]

const side = (value: number): string => (Math.abs(value) < 0.5 ? "" : value > 0 ? " left" : " right");

type Felt = "speed" | "steer" | "hands" | "throttle" | "torque" | "brake" | "ahead" | "left" | "yaw" | "roll";

const pair = (one: { root: HTMLElement }, its: { root: HTMLElement }): HTMLElement =>
  element("div", { class: "pair" }, one.root, its.root);

export class Dashboard {
  readonly root: HTMLElement;
  readonly gear: GearSign;
  private readonly speed = element("output", { class: "speed", "aria-label": "Speed" }, "–");
  private readonly speedUnit = element("small");
  private readonly units = new Tachometers();
  private readonly circle = new GravityCircle();
  private readonly steer = readout("steering wheel");
  private readonly steerBar = bar(true);
  private readonly hands = readout("steering torque");
  private readonly throttle = readout("throttle");
  private readonly throttleBar = bar(false);
  private readonly throttlePair = pair(this.throttle, this.throttleBar);
  private readonly drive = readout("drive");
  private readonly driveBar = bar(true);
  private readonly drivePair = pair(this.drive, this.driveBar);
  private readonly brake = readout("brake");
  private readonly brakeBar = bar(false);
  private readonly ahead = readout("ahead", "g");
  private readonly left = readout("left", "g");
  private readonly yaw = readout("yaw rate");
  private readonly roll = readout("roll");
  private read: Readonly<Record<Felt, Shown>> | null = null;
  private throttleOf: () => number = () => NaN; // 0 to 1
  private brakeOf: () => number = () => NaN; // 0 to 1
  private fullTorque = usualTorque;
  private lock = 0; // of the steering wheel, each way [deg]

  // aids: their lamps, which stand below everything else
  constructor(nextSelector: () => void, aids: HTMLElement) {
    this.gear = new GearSign(nextSelector);
    this.root = element(
      "section",
      { class: "panel dashboard", "aria-label": "Dashboard" },
      this.units.root,
      element("p", { class: "figure" }, this.speed, this.speedUnit, this.gear.root),
      element(
        "dl",
        { class: "felt" },
        pair(this.steer, this.steerBar),
        this.hands.root,
        this.throttlePair,
        this.drivePair,
        pair(this.brake, this.brakeBar),
      ),
      this.circle.root,
      element("dl", { class: "motion" }, this.ahead.root, this.left.root, this.yaw.root, this.roll.root),
      aids,
    );
  }

  setCar(car: CarMessage, frame: LiveFrame): void {
    const inGravities = (role: "longitudinal_acceleration" | "lateral_acceleration"): Shown => {
      const read = frame.reader(role);
      return { unit: "g", read: () => read() / (car.gravity_m_per_s2 || NaN) };
    };
    const { driveline = null } = car;
    const first = driveline?.units[0]?.name;
    const read = {
      speed: frame.shown("longitudinal_velocity"),
      steer: frame.shown("steering_wheel_angle"),
      hands: frame.shown("steering_torque"),
      throttle: frame.shown("unit_throttle", first),
      torque: frame.shown("drive_torque"),
      brake: frame.shown("brake"),
      ahead: inGravities("longitudinal_acceleration"),
      left: inGravities("lateral_acceleration"),
      yaw: frame.shown("yaw_rate"),
      roll: frame.shown("roll_angle"),
    };
    this.read = read;
    write(this.speedUnit, read.speed.unit);
    this.hands.unit = read.hands.unit;
    this.throttle.unit = read.throttle.unit;
    this.drive.unit = read.torque.unit;
    this.brake.unit = read.brake.unit;
    this.yaw.unit = read.yaw.unit;
    this.roll.unit = read.roll.unit;
    this.throttleOf = frame.reader("unit_throttle", first);
    this.brakeOf = frame.reader("brake");
    this.fullTorque = usualTorque;
    this.lock = car.steering_lock_deg;
    this.circle.clear();
    this.units.setCar(driveline, frame);
    this.gear.setCar(driveline, frame);
    this.hands.root.hidden = !frame.has("steering_torque");
    this.throttlePair.hidden = !frame.has("unit_throttle", first);
    this.drivePair.hidden = driveline !== null;
  }

  show(texts: boolean): void {
    const read = this.read;
    if (!read) return;
    const [steer, torque] = [read.steer.read(), read.torque.read()];
    this.fullTorque = Math.max(this.fullTorque, Math.abs(torque) || 0);
    this.circle.show(read.ahead.read(), read.left.read());
    this.steerBar.show(this.lock > 0 ? -steer / this.lock : 0);
    this.driveBar.show(torque / this.fullTorque);
    this.throttleBar.show(this.throttleOf());
    this.brakeBar.show(this.brakeOf());
    this.units.show(texts);
    if (!texts) return;
    this.gear.show();
    this.hands.show(figure(read.hands.read(), 1));
    this.throttle.show(figure(read.throttle.read(), 0));
    write(this.speed, figure(Math.abs(read.speed.read()), 0));
    this.steer.show(withUnit(figure(Math.abs(steer), 0), read.steer.unit) + side(steer));
    this.drive.show(figure(torque, 0));
    this.brake.show(figure(read.brake.read(), 0));
    this.ahead.show(figure(read.ahead.read(), 2));
    this.left.show(figure(read.left.read(), 2));
    this.yaw.show(figure(read.yaw.read(), 1));
    this.roll.show(figure(read.roll.read(), 1));
  }
}
