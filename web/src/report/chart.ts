// One chart of a report: read by pointer or keys, zoomed by dragging, saved as numbers or as a picture, crisp on paper.
import uPlot from "uplot";
import type { ChartBlock } from "../contract";
import type { LoadedDocument } from "../document";
import { element } from "../dom";
import { onThemeChange } from "../theme";
import { nearest, samplesOf, viewOf, visible, type Samples, type View, type Zoom } from "./curves";
import { saveCsv, savePicture } from "./files";
import { conesOf, endsOf, mapHeight, namesOf, spreads } from "./ground";
import { createLegend } from "./legend";
import { reading } from "./numbers";
import { dataOf, drawPicture, framePicture, optionsOf, showView, type Setting } from "./picture";
import { fitToWidth } from "./plot";
import { announce, onPrint, shareCursor } from "./sharing";
import { walk, type Place } from "./walk";
import { chartText, sampleText, valueText, withPowers } from "./words";
import "./chart.css";

const onPaper = { width: 340, height: 200, dots: 3 }; // [px] of half a page, and how many dots each
const inFile = { width: 640, height: 360, dots: 2 };

export function createChart(block: ChartBlock, loaded: LoadedDocument): HTMLElement {
  const shown = withPowers(block);
  const save = (): void => saveCsv(block, samplesOf(block, loaded));
  return new Chart(shown, samplesOf(shown, loaded), conesOf(shown, loaded), save).root;
}

class Chart {
  readonly root: HTMLElement;
  private readonly plot: uPlot;
  private readonly stage = element("div", { class: "drawing", tabindex: 0, role: "img" });
  private readonly readout = element("div", { class: "readout", "aria-hidden": "true" });
  private readonly reset = element(
    "button",
    { type: "button", hidden: true, onclick: () => this.zoomTo(null) },
    "Reset zoom",
  );
  private readonly legend;
  private readonly around: readonly Samples[];
  private readonly whole: View; // not zoomed
  private readonly wide: boolean; // has a row for itself
  private readonly unnamed: boolean;
  private readonly loops: boolean;
  private readonly shown: boolean[];
  private readonly tellOthers: (x: number | null) => void;
  private zoom: Zoom | null = null;
  private view: View;
  private place: Place | null = null; // where the keys have led
  private following = false;

  constructor(
    private readonly block: ChartBlock,
    private readonly curves: readonly Samples[],
    private readonly cones: readonly Samples[],
    private readonly saveNumbers: () => void,
  ) {
    this.around = [...cones, ...endsOf(block)];
    this.unnamed = curves.length === 1 && curves[0]?.label === "";
    this.loops = block.equal_axes === true || curves.some(({ rising }) => !rising);
    this.shown = curves.map(() => true);
    this.view = this.whole = viewOf(block, curves, null, this.around);
    this.wide = block.equal_axes === true && spreads(this.whole);
    this.legend = createLegend(
      curves.map(({ label }, color) => ({ label, color })),
      (index, shown) => this.switchCurve(index, shown),
    );
    this.root = this.compose();
    this.plot = new uPlot(this.options(), dataOf(curves), this.stage);
    this.stage.append(this.readout);
    this.tellOthers = shareCursor(block.x.label, (x) => this.follow(x));
    this.describe();
    this.listen();
  }

  private compose(): HTMLElement {
    const { title } = this.block;
    const button = (name: string, what: string, onclick: () => void): HTMLElement =>
      element("button", { type: "button", "aria-label": `${what} of ${title}`, title: what, onclick }, name);
    return element(
      "figure",
      { class: this.wide ? "chart wide" : "chart" },
      element(
        "figcaption",
        {},
        element("span", { class: "title" }, title),
        element(
          "span",
          { class: "actions" },
          this.reset,
          button("CSV", "Numbers", this.saveNumbers),
          button("PNG", "Picture", () => this.save()),
        ),
      ),
      this.stage,
      this.names(),
    );
  }

  private names(): HTMLElement | null {
    const cones = createLegend(namesOf(this.cones)).root;
    if (this.unnamed) return cones.childElementCount > 0 ? cones : null;
    this.legend.root.append(...cones.children);
    return this.legend.root;
  }

  private height(width: number): number {
    if (this.block.equal_axes) return mapHeight(this.whole, width);
    return Math.round(Math.min(320, Math.max(190, width * 0.58)));
  }

  private setting(width: number, height: number, factor: number): Setting {
    const { block, curves, cones } = this;
    return { block, curves, cones, view: () => this.view, width, height, factor };
  }

  // For paper and for a file; `height` is that of charts that are no maps.
  private picture({ width, height, dots }: typeof inFile): HTMLCanvasElement {
    const own = this.block.equal_axes ? mapHeight(this.whole, width) : height;
    return drawPicture(this.setting(width, own, dots / devicePixelRatio), this.shown);
  }

  private options(): uPlot.Options {
    const options = optionsOf(this.setting(360, this.height(360), 1));
    return {
      ...options,
      cursor: {
        y: false,
        drag: { x: true, y: this.loops, setScale: false, dist: 4 },
        dataIdx: (plot, series) => this.sampleAt(plot, series - 1),
        points: { size: 7 },
        bind: { dblclick: () => () => (this.zoomTo(null), null) },
      },
      hooks: {
        ...options.hooks,
        setCursor: [(plot) => this.showValues(plot)],
        setSelect: [(plot) => this.zoomToSelection(plot)],
      },
    };
  }

  private listen(): void {
    fitToWidth(this.plot, this.stage, (width) => this.height(width), () => this.block.equal_axes && this.show());
    onThemeChange(() => this.plot.redraw(false));
    this.stage.addEventListener("keydown", (event) => this.press(event));
    this.stage.addEventListener("pointermove", () => (this.place = null));
    this.stage.addEventListener("blur", () => this.hideCursor());
    onPrint({
      prepare: () => {
        const picture = this.picture(this.wide ? { ...onPaper, width: 2 * onPaper.width } : onPaper);
        picture.className = "on-paper";
        this.stage.after(picture);
      },
      restore: () => this.root.querySelectorAll(".on-paper").forEach((picture) => picture.remove()),
    });
  }

  private save(): void {
    const seen = [...this.curves.keys()].filter((i) => this.shown[i]);
    const entries = seen.map((color) => ({ label: this.curves[color]?.label ?? "", color }));
    const { title } = this.block;
    savePicture(title, framePicture(this.picture(inFile), title, [...entries, ...namesOf(this.cones)], inFile.dots));
  }

  private show(): void {
    const seen = this.curves.filter((_curve, i) => this.shown[i]);
    const wanted = viewOf(this.block, seen.length > 0 ? seen : this.curves, this.zoom, this.around);
    this.view = showView(this.plot, this.block, wanted);
    this.reset.hidden = this.zoom === null;
    this.describe();
  }

  private describe(): void {
    this.stage.setAttribute("aria-label", chartText(this.block, this.curves, this.cones, this.view));
  }

  private switchCurve(index: number, shown: boolean): void {
    this.shown[index] = shown;
    this.plot.setSeries(index + 1, { show: shown });
    this.show();
  }

  private zoomTo(zoom: Zoom | null): void {
    this.zoom = zoom;
    this.show();
  }

  private zoomToSelection(plot: uPlot): void {
    const { left, top, width, height } = plot.select;
    if (width < 4 || height < 4) return;
    const x = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")] as const;
    const y = [plot.posToVal(top + height, "y"), plot.posToVal(top, "y")] as const;
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.zoomTo({ x, y: this.loops ? y : null });
  }

  private sampleAt(plot: uPlot, index: number): number | null {
    const curve = this.curves[index];
    const { left = -10, top = -10 } = plot.cursor;
    if (!curve || left < 0) return null;
    if (this.place?.curve === index) return this.place.sample;
    const sample = nearest(curve, plot.posToVal(left, "x"), (x, y) =>
      Math.hypot(plot.valToPos(x, "x") - left, plot.valToPos(y, "y") - top),
    );
    return sample !== null && visible(curve, sample) ? sample : null;
  }

  private showValues(plot: uPlot): void {
    const { left = -10, idxs = [] } = plot.cursor;
    const x = left < 0 ? null : plot.posToVal(left, "x");
    const { block, view } = this;
    const values = this.curves.map(({ y }, i) => y[idxs[i + 1] ?? -1] ?? NaN);
    const height = block.y.logarithmic ? 0 : view.y[1] - view.y[0];
    this.legend.setValues(x === null ? [] : values.map((value) => reading(value, height)));
    const own = this.unnamed && !Number.isNaN(values[0]) ? ` · ${valueText(block.y, values[0] ?? NaN, view.y)}` : "";
    this.readout.textContent = x === null ? "" : valueText(block.x, x, view.x) + own;
    if (!this.following) this.tellOthers(x);
  }

  private follow(x: number | null): void {
    if (this.loops) return;
    this.following = true;
    const left = x === null ? -10 : this.plot.valToPos(x, "x");
    const inside = left >= 0 && left <= this.plot.over.clientWidth;
    this.plot.setCursor(inside ? { left, top: 0 } : { left: -10, top: -10 });
    this.following = false;
  }

  private hideCursor(): void {
    this.place = null;
    this.plot.setCursor({ left: -10, top: -10 });
  }

  private press(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === "Escape") return this.zoomTo(null);
    const curves = [...this.curves, ...this.cones]; // cones are read like the samples of one more curve
    const ground = { curves, shown: curves.map((_one, i) => this.shown[i] ?? true), x: this.view.x };
    const place = walk(ground, this.place, event.key, event.shiftKey ? 10 : 1);
    if (!place) return;
    event.preventDefault();
    event.stopPropagation(); // the player may move by these keys too
    const curve = curves[place.curve];
    if (curve) this.readAloud(place, curve);
  }

  private readAloud(place: Place, curve: Samples): void {
    this.place = place;
    const { plot } = this;
    const { [place.sample]: x = NaN } = curve.x;
    const { [place.sample]: y = NaN } = curve.y;
    plot.setCursor({ left: plot.valToPos(x, "x"), top: plot.valToPos(y, "y") });
    announce(sampleText(this.block, curve, place.sample, this.view));
  }
}
