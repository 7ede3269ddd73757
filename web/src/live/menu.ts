// Everything that is not needed while driving.
import { element } from "../dom";
import type { Child } from "../dom";
import { showKeys } from "../report/help";
import { chooseTheme, chosenTheme } from "../theme";
import type { Theme } from "../theme";
import { CourseForm } from "./course";
import type { Course } from "./course";
import { recall, remember } from "./memory";
import { choices, toggle } from "./switches";

export type Part = "body" | "solid" | "forces" | "wheels" | "curves" | "machine";
const parts: readonly { readonly part: Part; readonly label: string }[] = [
  { part: "body", label: "Body" },
  { part: "solid", label: "Solid body" },
  { part: "forces", label: "Forces" },
  { part: "wheels", label: "Wheels" },
  { part: "curves", label: "Curves" },
  { part: "machine", label: "Program" },
];
const paces = [0.05, 0.1, 0.25, 0.5, 1];
const themes: readonly { value: Theme; label: string }[] = [
  { value: "", label: "System" },
  { value: "light", label: "Light" },
  { value: "dark", label: "Dark" },
];
const onOrOff: readonly { value: boolean; label: string }[] = [
  { value: true, label: "On" },
  { value: false, label: "Off" },
];

export interface MenuListener {
  load(course: Course): void;
  setPace(factor: number): void;
  show(part: Part, on: boolean): void;
  calibrate(): void;
  setFeedback(on: boolean): void;
  closed(): void;
}

const section = (title: string, ...children: Child[]): HTMLElement =>
  element("section", {}, element("h2", {}, title), ...children);

export class Menu {
  readonly root: HTMLElement;
  readonly course: CourseForm;
  private readonly pace = choices(
    "Pace",
    paces.map((value) => ({ value, label: value === 1 ? "1" : String(value) })),
    (factor) => this.listener.setPace(factor),
  );
  private readonly feedback = choices("Force feedback", onOrOff, (on) => this.listener.setFeedback(on));
  private readonly theme = choices("Colors", themes, (theme) => {
    chooseTheme(theme);
    this.theme.set(theme);
  });

  // Small windows begin with the view alone.
  constructor(
    private readonly listener: MenuListener,
    roomy: boolean,
  ) {
    this.course = new CourseForm((course) => {
      this.close();
      listener.load(course);
    });
    this.theme.set(chosenTheme());
    this.root = element(
      "aside",
      { class: "panel menu", id: "live-menu", "aria-label": "Menu", hidden: true },
      section("Car and road", this.course.root),
      section("Pace", this.pace.root, element("p", { class: "hint" }, "Seconds of the car in a second of yours.")),
      section("Show", this.partToggles(roomy)),
      section("Colors", this.theme.root),
      section(
        "Controller",
        element("button", { type: "button", onclick: () => listener.calibrate() }, "Set up wheel and pedals…"),
      ),
      section(
        "Force feedback",
        this.feedback.root,
        element("p", { class: "hint" }, "A gamepad vibrates with the torque on the steering wheel."),
      ),
      section("Keys", element("button", { type: "button", onclick: showKeys }, "Show the keys")),
    );
  }

  get open(): boolean {
    return !this.root.hidden;
  }

  set open(on: boolean) {
    this.root.hidden = !on;
    if (on) this.root.querySelector("select")?.focus();
  }

  close(): void {
    if (!this.open) return;
    this.open = false;
    this.listener.closed();
  }

  showPace(factor: number): void {
    this.pace.set(factor);
  }

  showFeedback(on: boolean): void {
    this.feedback.set(on);
  }

  private partToggles(roomy: boolean): HTMLElement {
    const buttons = parts.map(({ part, label }) => {
      const kept = recall(`show.${part}`);
      const usual = part === "body" || part === "solid" || (roomy && (part === "wheels" || part === "machine"));
      const first = typeof kept === "boolean" ? kept : usual;
      const button = toggle(label, first, (on) => {
        button.set(on);
        remember(`show.${part}`, on);
        this.listener.show(part, on);
      });
      this.listener.show(part, first);
      return button.root;
    });
    return element("div", { class: "choices loose", role: "group", "aria-label": "Show" }, ...buttons);
  }
}
