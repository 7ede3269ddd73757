// Which vehicle on which road, and how slippery: chosen together, because any change puts a car at its start.
import { element } from "../dom";
import { figure } from "./gauge";
import type { CarMessage, Choice, Hello } from "../contract";

const surfaces: readonly (readonly [number, string])[] = [
  [0.2, "ice"],
  [0.45, "snow"],
  [0.85, "wet"],
  [Infinity, "dry"],
];
export const surface = (friction: number): string => surfaces.find(([below]) => friction < below)?.[1] ?? "dry";

export interface Course {
  readonly vehicle: string;
  readonly road: string;
  readonly friction: number;
}

const optionOf = ({ id, name }: Choice): HTMLElement => element("option", { value: id }, name);

const offer = (list: HTMLSelectElement, all: readonly Choice[]): void => list.replaceChildren(...all.map(optionOf));

function offerRoads(list: HTMLSelectElement, all: readonly Choice[]): void {
  const courses = all.filter(({ course }) => course);
  const roads = all.filter((road) => !courses.includes(road));
  if (courses.length === 0) return offer(list, roads);
  const group = (label: string, of: readonly Choice[]): HTMLElement =>
    element("optgroup", { label }, ...of.map(optionOf));
  list.replaceChildren(group("Roads", roads), group("Courses", courses));
}

const labeled = (label: string, control: HTMLElement): HTMLElement =>
  element("label", {}, element("span", {}, label), control);

export class CourseForm {
  readonly root: HTMLFormElement;
  private readonly vehicle = element("select", { name: "vehicle" });
  private readonly road = element("select", { name: "road" });
  private readonly word = element("output");
  private readonly friction: HTMLInputElement;

  constructor(load: (course: Course) => void) {
    this.friction = element("input", {
      type: "range",
      name: "friction",
      min: 0.05,
      max: 1.5,
      step: 0.05,
      value: 1,
      oninput: () => this.showWord(),
    });
    this.root = element(
      "form",
      {
        class: "course",
        onsubmit: (event) => {
          event.preventDefault();
          load(this.course);
        },
      },
      labeled("Vehicle", this.vehicle),
      labeled("Road", this.road),
      element("label", {}, element("span", {}, "Friction ", this.word), this.friction),
      element("p", { class: "scale", "aria-hidden": "true" }, ...surfaces.map(([, word]) => element("span", {}, word))),
      element("button", { type: "submit", class: "primary" }, "Put it on the road"),
    );
    this.showWord();
  }

  greet(hello: Hello): void {
    offer(this.vehicle, hello.vehicles);
    offerRoads(this.road, hello.roads);
  }

  show(car: CarMessage): void {
    this.vehicle.value = car.vehicle;
    this.road.value = car.road;
    this.friction.value = String(car.friction);
    this.showWord();
  }

  private get course(): Course {
    return { vehicle: this.vehicle.value, road: this.road.value, friction: this.friction.valueAsNumber };
  }

  private showWord(): void {
    const friction = this.friction.valueAsNumber;
    this.word.value = `${figure(friction, 2)} ${surface(friction)}`;
    this.friction.setAttribute("aria-valuetext", this.word.value);
  }
}
