// Force feedback: the gamepad that drives vibrates with what rumble.ts makes of the car. It takes every frame that arrives: a kick is
// often over before the next picture. Each effect ends by itself soon after the next one is due, so that nothing has to be stopped
// where no frames come, in a pause or on a lost connection, or where the pad drives no longer.
import type { CarMessage } from "../contract";
import { LiveFrame } from "./frame";
import { recall, remember } from "./memory";
import { Rumble } from "./rumble";
import type { Felt, Magnitudes } from "./rumble";
import { slipReader } from "./wheels";

const interval = 50; // of effects, at least: devices and their links are slow [ms]
const duration = 150; // of an effect, which bridges frames that come late [ms]
const faintest = 0.02; // less turns no motor

// What browsers know of a pad's motors, each its own part of it.
interface Motors {
  readonly vibrationActuator?: Partial<Pick<GamepadHapticActuator, "playEffect">> | null;
  readonly hapticActuators?: readonly { pulse(strength: number, duration: number): Promise<unknown> }[];
}

// A browser may refuse for reasons of its own, at once or later, and the drive goes on.
async function vibrate(pad: Motors, { strong, weak }: Magnitudes): Promise<void> {
  try {
    if (pad.vibrationActuator?.playEffect) {
      await pad.vibrationActuator.playEffect("dual-rumble", { duration, strongMagnitude: strong, weakMagnitude: weak });
    } else {
      await pad.hapticActuators?.[0]?.pulse(Math.max(strong, weak), duration);
    }
  } catch {
    return;
  }
}

interface Car {
  readonly frame: LiveFrame; // of its own, not that of the picture
  readonly rumble: Rumble;
  felt(): Felt;
}

export class Feedback {
  private wanted = recall("feedback") !== false;
  private car: Car | null = null;
  private due = -Infinity; // the next effect [ms]

  // pad: the one that drives
  constructor(private readonly pad: () => Gamepad | null) {}

  get on(): boolean {
    return this.wanted;
  }

  set on(on: boolean) {
    this.wanted = on;
    remember("feedback", on);
  }

  setCar(car: CarMessage): void {
    const frame = new LiveFrame(car);
    const torque = frame.reader("steering_torque");
    const angle = frame.reader("steering_wheel_angle");
    const slip = slipReader(frame, car.scene.tires);
    const antiLock = frame.reader("controller_activity", "abs");
    const felt = (): Felt => ({ torque: torque(), angle: angle(), slip: slip(), antiLock: antiLock() });
    this.car = { frame, rumble: new Rumble(), felt };
  }

  receive(bytes: ArrayBuffer): void {
    const { car } = this;
    if (!car?.frame.read(bytes)) return;
    const felt = car.rumble.follow(car.frame.time, car.felt());
    const now = performance.now();
    if (!this.on || now < this.due || Math.max(felt.strong, felt.weak) < faintest) return;
    const pad = this.pad();
    if (pad === null) return;
    this.due = now + interval;
    void vibrate(pad, felt);
  }
}
