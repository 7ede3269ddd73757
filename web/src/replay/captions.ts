// Words over the picture: whose car is whose, and what the arrows measure.
import { element } from "../dom";
import { seriesCount } from "../theme";
import type { World } from "./world";

const chip = (shade: string): HTMLElement =>
  element("span", { class: "replay-chip", style: `background: var(--${shade})` });

export class Captions {
  readonly root = element("div", { class: "replay-captions" });
  private readonly runs = element("ul", { class: "replay-runs", "aria-label": "Runs" });
  // On a narrow screen names would cover the picture: they wait behind it.
  private readonly names = element("button", {
    type: "button",
    class: "replay-button replay-names",
    "aria-expanded": "false",
    onclick: () => this.unfold(),
  });
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
      const chips = tracks.map(({ index }) => chip(`series-${(index % seriesCount) + 1}`));
      this.runs.append(...tracks.map(({ run }, i) => element("li", {}, chips[i]!.cloneNode(), run.name)));
      this.names.append(...chips, `${tracks.length} runs`);
      this.root.append(this.names);
    }
    this.root.append(this.runs, this.arrows);
    this.show();
  }

  private unfold(): void {
    const open = this.runs.classList.toggle("open");
    this.names.setAttribute("aria-expanded", String(open));
  }

  show(): void {
    this.runs.classList.toggle("apart", this.world.together === "side by side");
    this.arrows.hidden = !(this.world.cars[0]?.shows("forces") ?? false);
  }
}
