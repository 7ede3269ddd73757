// Names of the curves with their dashes, and their values where the cursor stands. A name may switch its curve off.
import { drawing, element } from "../dom";
import { seriesCount, seriesDash } from "../theme";

export interface LegendEntry {
  readonly label: string;
  readonly color: number | null; // index of seriesColor() and seriesDash(); null: cones
}

export interface Legend {
  readonly root: HTMLElement;
  setValues(values: readonly string[]): void; // []: none
}

const coneSample = (): SVGElement =>
  drawing("path", { d: "M14 0L18.5 8H9.5Z", fill: "var(--cone)", stroke: "var(--ink)", "stroke-width": 0.8 });

const lineSample = (index: number): SVGElement =>
  drawing("line", {
    x1: 0,
    y1: 4,
    x2: 28,
    y2: 4,
    stroke: `var(--series-${(index % seriesCount) + 1})`,
    "stroke-width": 2,
    "stroke-dasharray": seriesDash(index).join(" ") || null,
  });

const sampleOf = (index: number | null): SVGElement =>
  drawing(
    "svg",
    { class: "sample", viewBox: "0 -1 28 10", width: 28, height: 10, "aria-hidden": "true" },
    index === null ? coneSample() : lineSample(index),
  );

export function createLegend(
  entries: readonly LegendEntry[],
  onToggle?: (index: number, shown: boolean) => void,
): Legend {
  const values = entries.map(() => element("span", { class: "value", "aria-hidden": "true" }));
  const items = entries.map(({ label, color }, i) => {
    const content = [sampleOf(color), element("span", { class: "name" }, label), values[i] ?? null];
    if (!onToggle) return element("li", {}, ...content);
    const button: HTMLButtonElement = element(
      "button",
      {
        type: "button",
        "aria-pressed": "true",
        title: `Show or hide ${label}`,
        onclick: () => {
          const shown = button.getAttribute("aria-pressed") !== "true";
          button.setAttribute("aria-pressed", String(shown));
          onToggle(i, shown);
        },
      },
      ...content,
    );
    return element("li", {}, button);
  });
  return {
    root: element("ul", { class: "legend" }, ...items),
    setValues: (texts) => values.forEach((value, i) => (value.textContent = texts[i] ?? "")),
  };
}
