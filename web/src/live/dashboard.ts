// Speed, steering, pedals and how the car answers.
import { element } from "../dom";
import type { LiveFrame } from "./frame";
import { bar, figure, readout, write } from "./gauge";
import { GearSign } from "./gear";
import { GravityCircle, gravity } from "./gravity";
import type { CarMessage } from "./protocol";
import { Tachometers } from "./tachometer";

const usualTorque = 2000; // at the driven wheels together, until a car has more [N m]

const side = (value: number): string => (Math.abs(value) < 0.5 ? "" : value > 0 ? " left" : " right");

type Felt = "speed" | "steer" | "hands" | "throttle" | "torque" | "brake" | "ahead" | "left" | "yaw" | "roll";

const pair = (one: { root: HTMLElement }, its: { root: HTMLElement }): HTMLElement =>
  element("div", { class: "pair" }, one.root, its.root);

export class Dashboard {
  readonly root: HTMLElement;
  readonly gear: GearSign;
  private readonly speed = element("output", { class: "speed", "aria-label": "Speed in kilometers per hour" }, "–");
  private readonly units = new Tachometers();
  private readonly circle = new GravityCircle();
  private readonly steer = readout("steering wheel", "");
  private readonly steerBar = bar(true);
  private readonly hands = readout("steering torque", "N m");
  private readonly throttle = readout("throttle", "%");
  private readonly throttleBar = bar(false);
  private readonly throttlePair = pair(this.throttle, this.throttleBar);
  private readonly drive = readout("drive", "N m");
  private readonly driveBar = bar(true);
  private readonly drivePair = pair(this.drive, this.driveBar);
  private readonly brake = readout("brake", "%");
  private readonly brakeBar = bar(false);
  private readonly ahead = readout("ahead", "g");
  private readonly left = readout("left", "g");
  private readonly yaw = readout("yaw rate", "°/s");
  private readonly roll = readout("roll", "°");
  private read: Readonly<Record<Felt, () => number>> | null = null;
  private fullTorque = usualTorque;
  private lock = 0; // of the steering wheel, each way [deg]

  constructor(nextSelector: () => void) {
    this.gear = new GearSign(nextSelector);
    this.root = element(
      "section",
      { class: "panel dashboard", "aria-label": "Dashboard" },
      this.units.root,
      element("p", { class: "figure" }, this.speed, element("small", {}, "km/h"), this.gear.root),
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
    );
  }

  setCar(car: CarMessage, frame: LiveFrame): void {
    const acceleration = (name: string): (() => number) => {
      const read = frame.reader(`chassis.${name}_acceleration`);
      return () => read() / gravity;
    };
    const { driveline = null } = car;
    const throttle = `${driveline?.units[0]?.name ?? ""}.throttle`;
    this.read = {
      speed: frame.reader("chassis.longitudinal_velocity"),
      steer: frame.reader("input.steering_wheel"),
      hands: frame.reader("input.steering_torque"),
      throttle: frame.reader(throttle),
      torque: frame.reader("input.drive_torque"),
      brake: frame.reader("input.brake"),
      ahead: acceleration("longitudinal"),
      left: acceleration("lateral"),
      yaw: frame.reader("chassis.rate.yaw"),
      roll: frame.reader("chassis.angle.roll"),
    };
    this.fullTorque = usualTorque;
    this.lock = car.steering_lock_deg;
    this.circle.clear();
    this.units.setCar(driveline, frame);
    this.gear.setCar(driveline, frame);
    this.hands.root.hidden = !frame.has("input.steering_torque");
    this.throttlePair.hidden = !frame.has(throttle);
    this.drivePair.hidden = driveline !== null;
  }

  show(texts: boolean): void {
    const read = this.read;
    if (!read) return;
    const [steer, torque, brake] = [read.steer(), read.torque(), read.brake()];
    this.fullTorque = Math.max(this.fullTorque, Math.abs(torque) || 0);
    this.circle.show(read.ahead(), read.left());
    this.steerBar.show(this.lock > 0 ? -steer / this.lock : 0);
    this.driveBar.show(torque / this.fullTorque);
    this.throttleBar.show(read.throttle());
    this.brakeBar.show(brake);
    this.units.show(texts);
    if (!texts) return;
    this.gear.show();
    this.hands.show(figure(read.hands(), 1));
    this.throttle.show(figure(100 * read.throttle(), 0));
    write(this.speed, figure(Math.abs(3.6 * read.speed()), 0));
    this.steer.show(`${figure(Math.abs(steer), 0)}°${side(steer)}`);
    this.drive.show(figure(torque, 0));
    this.brake.show(figure(100 * brake, 0));
    this.ahead.show(figure(read.ahead(), 2));
    this.left.show(figure(read.left(), 2));
    this.yaw.show(figure(read.yaw(), 1));
    this.roll.show(figure(read.roll(), 1));
  }
}
