// Keys of the player.
import type { Key } from "../report/help";
import type { CameraMode } from "../scene/camera";
import { cameraModes } from "../scene/camera";

export const replayKeys: readonly Key[] = [
  { keys: ["Space"], does: "play or pause" },
  { keys: ["←", "→"], does: "step; with Shift by 1 s" },
  { keys: ["Home", "End"], does: "go to the start or the end" },
  { keys: ["↑", "↓"], does: "play faster or slower" },
  { keys: ["r"], does: "play backward" },
  { keys: ["l"], does: "loop" },
  ...cameraModes.map(({ key, label }) => ({ keys: [key], does: `${label.toLowerCase()} camera` })),
  { keys: ["+", "−"], does: "camera nearer or farther" },
  { keys: ["[", "]"], does: "camera round to the left or right" },
  { keys: ["0"], does: "camera back to its own place" },
  { keys: ["f"], does: "forces" },
  { keys: ["b"], does: "body" },
  { keys: ["x"], does: "see through the body to the linkages" },
  { keys: ["g"], does: "runs as ghosts or side by side" },
  { keys: ["c"], does: "choose channels" },
];

export interface KeyActions {
  toggle(): void;
  step(direction: 1 | -1): void;
  skip(seconds: number): void;
  toStart(): void;
  toEnd(): void;
  faster(direction: 1 | -1): void;
  reverse(): void;
  loop(): void;
  camera(mode: CameraMode): void;
  zoom(factor: number): void;
  turn(angle: number): void;
  resetCamera(): void;
  forces(): void;
  body(): void;
  solid(): void;
  arrange(): void;
  channels(): void;
}

const typing = (target: Element): boolean =>
  target.closest("input:not([type=radio], [type=checkbox], [type=range]), textarea, select, dialog") !== null;

// Space presses the button that has the focus, and ticks a box.
const pressing = (target: Element): boolean =>
  target.closest("button, summary, [type=checkbox], [type=radio]") !== null;

function actionOf(event: KeyboardEvent, does: KeyActions): (() => void) | null {
  const mode = cameraModes.find(({ key }) => key === event.key)?.mode;
  if (mode !== undefined) return () => does.camera(mode);
  switch (event.key) {
    case " ": return () => does.toggle();
    case "ArrowLeft": return () => (event.shiftKey ? does.skip(-1) : does.step(-1));
    case "ArrowRight": return () => (event.shiftKey ? does.skip(1) : does.step(1));
    case "Home": return () => does.toStart();
    case "End": return () => does.toEnd();
    case "ArrowUp": return () => does.faster(1);
    case "ArrowDown": return () => does.faster(-1);
    case "r": return () => does.reverse();
    case "l": return () => does.loop();
    case "+": case "=": return () => does.zoom(1 / 1.15);
    case "-": return () => does.zoom(1.15);
    case "[": return () => does.turn(-0.12);
    case "]": return () => does.turn(0.12);
    case "0": return () => does.resetCamera();
    case "f": return () => does.forces();
    case "b": return () => does.body();
    case "x": return () => does.solid();
    case "g": return () => does.arrange();
    case "c": return () => does.channels();
    default: return null;
  }
}

// Where the player has the screen for itself the keys are its own; in a report, while the focus is in it.
export function listenToKeys(host: HTMLElement, does: KeyActions): void {
  document.addEventListener("keydown", (event) => {
    const target = event.target instanceof Element ? event.target : document.body;
    const own = host.contains(target) || (target === document.body && host.closest(".screenful") !== null);
    if (!own || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || typing(target)) return;
    if (event.key === " " && pressing(target)) return;
    const action = actionOf(event, does);
    if (action === null) return;
    event.preventDefault();
    action();
  });
}
