// Words over the picture: whose car is whose, and what the arrows measure.
import { element } from "../dom";
import type { World } from "./world";

const chip = (shade: string): HTMLElement =>
  element("span", { class: "replay-chip", style: `background: var(--${shade})` });

export class Captions {
  readonly root = element("div", { class: "replay-captions" });
  private readonly runs = element("ul", { class: "replay-runs", "aria-label": "Runs" });
  private readonly arrows: HTMLElement;

  constructor(private readonly world: World) {
    const newtons = world.cars[0]?.newtonsPerMeter ?? 0;
    this.arrows = element(
      "p", { class: "replay-arrows" },
      chip("series-3"), "force of the road on the tire", chip("series-4"), "its friction",
      element("span", {}, `1 m is ${newtons / 1000} kN`),
    );
    const { tracks } = world;
    if (tracks.length > 1) {
      this.runs.append(
        ...tracks.map(({ run, index }) => element("li", {}, chip(`series-${(index % 8) + 1}`), run.name)),
      );
    }
    this.root.append(this.runs, this.arrows);
    this.show();
  }

  show(): void {
    this.runs.classList.toggle("apart", this.world.together === "side by side");
    this.arrows.hidden = !(this.world.cars[0]?.shows("forces") ?? false);
  }
}
