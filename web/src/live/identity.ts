// The name plate.
import { element } from "../dom";
import { write } from "./gauge";

// Which car on which road, and who drives it.
export class Identity {
  readonly root: HTMLElement;
  private readonly car = element("h1", {}, "Hamilcar");
  private readonly road = element("p", { class: "road" });
  private readonly role = element("p", { class: "role", role: "status" });
  private readonly take: HTMLButtonElement;

  constructor(take: () => void) {
    this.take = element("button", { type: "button", class: "primary", hidden: true, onclick: take }, "Take the wheel");
    const content = [this.car, this.road, this.role, this.take];
    this.root = element("section", { class: "panel identity", "aria-label": "Car and road" }, ...content);
  }

  showCar(car: string, road: string): void {
    write(this.car, car);
    write(this.road, road);
  }

  showRole(text: string, free: boolean): void {
    write(this.role, text);
    this.take.hidden = !free;
  }
}
