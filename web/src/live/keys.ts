// The keyboard. Driving keys go by their place on it, commands by their letter.
import { cameraModes } from "../scene/camera";
import type { CameraMode } from "../scene/camera";
import type { Held } from "./held";

export const aidKeys: readonly string[] = ["6", "7", "8", "9"]; // behind those of the cameras

// Keys that do the same stand side by side.
export const liveKeys: readonly { readonly keys: string; readonly meaning: string }[] = [
  { keys: "↑ W", meaning: "throttle" },
  { keys: "↓ S Space", meaning: "brake" },
  { keys: "← → A D", meaning: "steer" },
  { keys: "R", meaning: "reverse on and off, at a standstill" },
  { keys: "E Q", meaning: "gear up, gear down: by hand from then on" },
  { keys: "G", meaning: "selector: drive, manual, neutral, reverse" },
  { keys: "C", meaning: "clutch, as long as it is held" },
  { keys: "Enter Backspace", meaning: "back to the start" },
  { keys: "P", meaning: "pause" },
  { keys: "1 2 3 4 5", meaning: "camera: chase, orbit, top, driver, wheel" },
  { keys: aidKeys.join(" "), meaning: "the car's aids (ABS, ESC, ...), from the left: off and on" },
  { keys: "V", meaning: "force feedback: the gamepad vibrates or not" },
  { keys: "M", meaning: "menu" },
];

export interface KeyListener {
  held(at: number, press: boolean): void; // a driving key moved, at that time [ms]
  reset(): void;
  togglePause(): void;
  toggleReverse(): void;
  nextSelector(): void;
  shift(by: 1 | -1): void;
  chooseCamera(mode: CameraMode): void;
  switchAid(number: number): void; // from the left, counted from 0
  toggleFeedback(): void;
  toggleMenu(): void;
  closePanels(): void;
}

type Pull = "left" | "right" | "throttle" | "brake" | "clutch";
const pulls: Readonly<Record<string, Pull>> = {
  ArrowLeft: "left",
  KeyA: "left",
  ArrowRight: "right",
  KeyD: "right",
  ArrowUp: "throttle",
  KeyW: "throttle",
  ArrowDown: "brake",
  KeyS: "brake",
  Space: "brake",
  KeyC: "clutch",
};
const shifts: Readonly<Record<string, 1 | -1>> = { KeyE: 1, KeyQ: -1 }; // beside the keys that steer

// Keys that the focused control needs for itself.
function belongsTo(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest("input, select, textarea, dialog") !== null) return key !== "Escape";
  return target.closest("button, a, summary") !== null && (key === "Enter" || key === " ");
}

export class Keys {
  private readonly down = new Set<string>();

  constructor(private readonly listener: KeyListener) {
    addEventListener("keydown", (event) => this.press(event));
    addEventListener("keyup", (event) => this.lift(event));
  }

  get held(): Held {
    const on = (pull: Pull): number => (this.holds(pull) ? 1 : 0);
    const steer = on("left") - on("right");
    return { steer, throttle: on("throttle"), brake: on("brake"), clutch: on("clutch") };
  }

  release(): void {
    this.down.clear();
  }

  private holds(pull: Pull): boolean {
    for (const code of this.down) if (pulls[code] === pull) return true;
    return false;
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || belongsTo(event.target, event.key)) return;
    if (event.code in pulls) {
      event.preventDefault();
      if (event.repeat || this.down.has(event.code)) return;
      this.down.add(event.code);
      this.listener.held(event.timeStamp, true);
    } else if (event.code in shifts) {
      event.preventDefault();
      if (!event.repeat) this.listener.shift(shifts[event.code] ?? 1);
    } else if (!event.repeat && this.command(event.key)) {
      event.preventDefault();
    }
  }

  private lift(event: KeyboardEvent): void {
    if (this.down.delete(event.code)) this.listener.held(event.timeStamp, false);
  }

  private command(key: string): boolean {
    const camera = cameraModes.find((mode) => mode.key === key);
    if (camera) {
      this.listener.chooseCamera(camera.mode);
      return true;
    }
    const aid = aidKeys.indexOf(key);
    if (aid >= 0) {
      this.listener.switchAid(aid);
      return true;
    }
    const commands: Readonly<Record<string, () => void>> = {
      Enter: () => this.listener.reset(),
      Backspace: () => this.listener.reset(),
      p: () => this.listener.togglePause(),
      r: () => this.listener.toggleReverse(),
      g: () => this.listener.nextSelector(),
      v: () => this.listener.toggleFeedback(),
      m: () => this.listener.toggleMenu(),
      Escape: () => this.listener.closePanels(),
    };
    const command = commands[key.length === 1 ? key.toLowerCase() : key];
    command?.();
    return command !== undefined;
  }
}
