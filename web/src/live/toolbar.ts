// What is needed while driving.
import { element } from "../dom";
import { cameraModes } from "../scene/camera";
import type { CameraMode } from "../scene/camera";
import { toggle } from "./switches";
import type { Status } from "../contract";

export interface ToolbarListener {
  reset(): void;
  pause(on: boolean): void;
  record(on: boolean): void;
  chooseCamera(mode: CameraMode): void;
  toggleMenu(): void;
}

export class Toolbar {
  readonly root: HTMLElement;
  private readonly pause = toggle("Pause", false, (on) => this.listener.pause(on));
  private readonly record = toggle("Record", false, (on) => this.listener.record(on));
  private readonly camera: HTMLSelectElement;
  private readonly menu: HTMLButtonElement;

  constructor(private readonly listener: ToolbarListener) {
    this.camera = element(
      "select",
      { "aria-label": "Camera", onchange: () => listener.chooseCamera(this.camera.value as CameraMode) },
      ...cameraModes.map(({ mode, label }) => element("option", { value: mode }, label)),
    );
    this.menu = element(
      "button",
      { type: "button", "aria-expanded": "false", "aria-controls": "live-menu", onclick: () => listener.toggleMenu() },
      "Menu",
    );
    const reset = element("button", { type: "button", onclick: () => listener.reset() }, "Restart");
    this.root = element(
      "div",
      { class: "panel toolbar", role: "toolbar", "aria-label": "Driving" },
      this.pause.root,
      reset,
      this.record.root,
      this.camera,
      this.menu,
    );
  }

  showStatus(status: Status): void {
    this.pause.set(status.paused === "driver");
    this.record.set(status.recording !== "");
    this.record.root.title = status.recording;
  }

  showCamera(mode: CameraMode): void {
    this.camera.value = mode;
  }

  showMenu(open: boolean): void {
    this.menu.setAttribute("aria-expanded", String(open));
  }
}
