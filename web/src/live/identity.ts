// The name plate.
import { element } from "../dom";
import { surface } from "./course";
import { figure, write } from "./gauge";
import type { CarMessage } from "../contract";

// Which car on which road, and who drives it.
export class Identity {
  readonly root: HTMLElement;
  private readonly car = element("h1", {}, "Hamilcar");
  private readonly road = element("p", { class: "road" });
  private readonly task = element("p", { class: "task" });
  private readonly role = element("p", { class: "role", role: "status" });
  private readonly take: HTMLButtonElement;

  constructor(take: () => void) {
    this.take = element("button", { type: "button", class: "primary", hidden: true, onclick: take }, "Take the wheel");
    const content = [this.car, this.road, this.task, this.role, this.take];
    this.root = element("section", { class: "panel identity", "aria-label": "Car and road" }, ...content);
  }

  showCar({ scene, friction, course }: CarMessage): void {
    write(this.car, scene.vehicle);
    write(this.road, `${scene.road.name}, ${surface(friction)} (${figure(friction, 2)})`);
    const told = course?.title === scene.road.name;
    write(this.task, course ? (told ? course.summary : `${course.title}: ${course.summary}`) : "");
  }

  showRole(text: string, free: boolean): void {
    write(this.role, text);
    this.take.hidden = !free;
  }
}
