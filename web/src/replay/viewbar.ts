// The bar over the picture: which camera, what is drawn, how several runs share the picture.
import { element } from "../dom";
import { cameraModes, type CameraMode } from "../scene/camera";
import type { CarPart } from "../scene/car";
import type { Stage } from "../scene/stage";
import { button, setPressed } from "./buttons";
import { words } from "./sheet";
import type { World } from "./world";

const parts: readonly { readonly part: CarPart; readonly label: string }[] = [
  { part: "body", label: "Body" },
  { part: "solid", label: "Solid" },
  { part: "suspension", label: "Links" },
  { part: "wheels", label: "Wheels" },
  { part: "forces", label: "Forces" },
];

export class ViewBar {
  readonly root = element("div", { class: "replay-viewbar" });
  onChange: () => void = () => {}; // something else is drawn
  private readonly cameras = new Map<CameraMode, HTMLButtonElement>();
  private readonly toggles = new Map<CarPart, HTMLButtonElement>();
  private readonly wheel: HTMLSelectElement;
  private readonly together: HTMLButtonElement;
  private readonly compare: HTMLButtonElement;

  constructor(private readonly world: World, private readonly stage: Stage) {
    for (const { mode, label } of cameraModes) {
      this.cameras.set(mode, button({ text: label }, `${label} camera`, () => this.choose(mode)));
    }
    const wheels = world.cars[0]?.scene.wheels ?? [];
    this.wheel = element(
      "select", { "aria-label": "Wheel to look at", onchange: () => (stage.camera.wheel = this.wheel.selectedIndex) },
      ...wheels.map(({ name }) => element("option", {}, words(name))),
    );
    for (const { part, label } of parts) {
      this.toggles.set(part, button({ text: label }, `Show ${label.toLowerCase()}`, () => this.toggle(part)));
    }
    this.together = button({ text: "Side by side" }, "Runs side by side", () => this.arrange());
    const comparing = "Compare suspensions: side by side, close to a wheel, without body";
    this.compare = button({ text: "Suspensions" }, comparing, () => this.closeUp());
    this.assemble();
    this.show();
  }

  choose(mode: CameraMode): void {
    this.stage.camera.mode = mode;
    this.show();
  }

  toggle(part: CarPart): void {
    this.world.show(part, !(this.world.cars[0]?.shows(part) ?? false));
    this.changed();
  }

  arrange(): void {
    if (this.world.cars.length < 2) return;
    this.world.arrange(this.world.together === "ghosts" ? "side by side" : "ghosts");
    this.changed();
  }

  private closeUp(): void {
    this.world.arrange("side by side");
    this.world.show("body", false);
    this.choose("wheel");
    this.changed();
  }

  private changed(): void {
    this.show();
    this.onChange();
  }

  private assemble(): void {
    const group = (label: string, ...inside: HTMLElement[]): HTMLElement =>
      element("div", { class: "replay-group", role: "group", "aria-label": label }, ...inside);
    const several = this.world.cars.length > 1;
    this.root.append(
      group("Camera", ...this.cameras.values(), this.wheel),
      group("Shown", ...this.toggles.values()),
      ...(several ? [group("Runs", this.together, this.compare)] : []),
    );
  }

  private show(): void {
    for (const [mode, one] of this.cameras) setPressed(one, mode === this.stage.camera.mode);
    this.wheel.hidden = this.stage.camera.mode !== "wheel" || this.wheel.options.length === 0;
    for (const [part, one] of this.toggles) setPressed(one, this.world.cars[0]?.shows(part) ?? false);
    setPressed(this.together, this.world.together === "side by side");
  }
}
