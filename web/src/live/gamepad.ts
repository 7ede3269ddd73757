// Gamepads and steering wheels. A gamepad of the standard mapping is known; of everything else the page learns which
// axis is which (calibration.ts).
import { clamp, letGo } from "./held";
import type { Held } from "./held";
import { recall, remember } from "./memory";

export interface Pedal {
  readonly kind: "axis" | "button";
  readonly index: number;
  readonly released: number;
  readonly pressed: number;
}

export interface Calibration {
  readonly steer: { readonly axis: number; readonly left: number; readonly straight: number; readonly right: number };
  readonly throttle: Pedal;
  readonly brake: Pedal;
}

export type PadCommand = "up" | "down" | "next" | "reverse" | "reset" | "pause";
const commandButtons: readonly (readonly [number, PadCommand])[] = [
  [1, "next"], // B or circle: selector
  [3, "reverse"], // Y or triangle
  [4, "down"], // LB or L1: gears
  [5, "up"], // RB or R1
  [8, "reset"], // back
  [9, "pause"], // start
];
const deadZone = 0.08; // of a stick

export const connectedPads = (): Gamepad[] => navigator.getGamepads().filter((pad) => pad !== null);

export function calibrationOf(pad: Gamepad): Calibration | null {
  return recall(`controller.${pad.id}`) as Calibration | null;
}
export function keepCalibration(pad: Gamepad, calibration: Calibration): void {
  remember(`controller.${pad.id}`, calibration);
}

// A thumb moves a few centimeters where hands move a meter: the square leaves it room around straight ahead.
function stick(x: number): number {
  const far = Math.max(Math.abs(x) - deadZone, 0) / (1 - deadZone);
  return Math.sign(x) * far * far;
}

function pedal(pad: Gamepad, { kind, index, released, pressed }: Pedal): number {
  const now = (kind === "axis" ? pad.axes[index] : pad.buttons[index]?.value) ?? released;
  return clamp((now - released) / (pressed - released), 0, 1);
}

function wheel(pad: Gamepad, { axis, left, straight, right }: Calibration["steer"]): number {
  const now = pad.axes[axis] ?? straight;
  const toLeft = (now - straight) / (left - straight);
  return toLeft >= 0 ? Math.min(toLeft, 1) : Math.max((straight - now) / (right - straight), -1);
}

export function readPad(pad: Gamepad, calibration: Calibration | null): Held {
  if (calibration !== null) {
    return {
      steer: wheel(pad, calibration.steer),
      throttle: pedal(pad, calibration.throttle),
      brake: pedal(pad, calibration.brake),
      clutch: 0,
    };
  }
  if (pad.mapping !== "standard") return letGo;
  return {
    steer: -stick(pad.axes[0] ?? 0),
    throttle: pad.buttons[7]?.value ?? 0,
    brake: pad.buttons[6]?.value ?? 0,
    clutch: pad.buttons[0]?.value ?? 0, // A or cross
  };
}

// Reads the first controller that can be read, once a picture.
export class Pads {
  held: Held = letGo;
  pad: Gamepad | null = null; // that was read last
  private readonly calibrations = new Map<string, Calibration | null>();
  private down = new Set<PadCommand>();

  constructor(private readonly command: (command: PadCommand) => void) {}

  forgetCalibrations(): void {
    this.calibrations.clear();
  }

  poll(): void {
    const pad = connectedPads().find((one) => one.mapping === "standard" || this.calibration(one) !== null);
    this.pad = pad ?? null;
    this.held = pad ? readPad(pad, this.calibration(pad)) : letGo;
    const down = new Set<PadCommand>();
    for (const [button, command] of pad?.mapping === "standard" ? commandButtons : []) {
      if (!pad?.buttons[button]?.pressed) continue;
      down.add(command);
      if (!this.down.has(command)) this.command(command);
    }
    this.down = down;
  }

  private calibration(pad: Gamepad): Calibration | null {
    const known = this.calibrations.get(pad.id);
    if (known !== undefined) return known;
    const read = calibrationOf(pad);
    this.calibrations.set(pad.id, read);
    return read;
  }
}
