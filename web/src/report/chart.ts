// One chart of a report: read by pointer or keys, zoomed by dragging, saved as numbers or as a picture, crisp on paper.
import uPlot from "uplot";
import type { ChartBlock, LoadedDocument } from "../document";
import { element } from "../dom";
import { onThemeChange } from "../theme";
import { nearest, samplesOf, viewOf, visible, type Samples, type View, type Zoom } from "./curves";
import { saveCsv, savePicture } from "./files";
import { createLegend } from "./legend";
import { reading } from "./numbers";
import { dataOf, drawPicture, framePicture, optionsOf, type Setting } from "./picture";
import { fitToWidth } from "./plot";
import { announce, onPrint, shareCursor } from "./sharing";
import { walk, type Place } from "./walk";
import { chartText, sampleText, valueText } from "./words";
import "./chart.css";

const heightFor = (width: number): number => Math.round(Math.min(320, Math.max(190, width * 0.58)));
const onPaper = { width: 340, height: 200, dots: 3 }; // [px] of half a page, and how many dots each
const inFile = { width: 640, height: 360, dots: 2 };

export const createChart = (block: ChartBlock, loaded: LoadedDocument): HTMLElement =>
  new Chart(block, samplesOf(block, loaded)).root;

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
  ) {
    this.unnamed = curves.length === 1 && curves[0]?.label === "";
    this.loops = curves.some(({ rising }) => !rising);
    this.shown = curves.map(() => true);
    this.view = viewOf(block, curves, null);
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
      { class: "chart" },
      element(
        "figcaption",
        {},
        element("span", { class: "title" }, title),
        element(
          "span",
          { class: "actions" },
          this.reset,
          button("CSV", "Numbers", () => saveCsv(this.block, this.curves)),
          button("PNG", "Picture", () => this.save()),
        ),
      ),
      this.stage,
      this.unnamed ? null : this.legend.root,
    );
  }

  private setting(width: number, height: number, factor: number): Setting {
    return { block: this.block, curves: this.curves, view: () => this.view, width, height, factor };
  }

  private options(): uPlot.Options {
    const options = optionsOf(this.setting(360, heightFor(360), 1));
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
    fitToWidth(this.plot, this.stage, heightFor);
    onThemeChange(() => this.plot.redraw(false));
    this.stage.addEventListener("keydown", (event) => this.press(event));
    this.stage.addEventListener("pointermove", () => (this.place = null));
    this.stage.addEventListener("blur", () => this.hideCursor());
    onPrint({
      prepare: () => {
        const { width, height, dots } = onPaper;
        const picture = drawPicture(this.setting(width, height, dots / devicePixelRatio), this.shown);
        picture.className = "on-paper";
        this.stage.after(picture);
      },
      restore: () => this.root.querySelectorAll(".on-paper").forEach((picture) => picture.remove()),
    });
  }

  private save(): void {
    const { width, height, dots } = inFile;
    const picture = drawPicture(this.setting(width, height, dots / devicePixelRatio), this.shown);
    const seen = [...this.curves.keys()].filter((i) => this.shown[i]);
    const entries = seen.flatMap((color) => ({ label: this.curves[color]?.label ?? "", color }));
    savePicture(this.block.title, framePicture(picture, this.block.title, entries, dots));
  }

  private show(): void {
    const seen = this.curves.filter((_curve, i) => this.shown[i]);
    this.view = viewOf(this.block, seen.length > 0 ? seen : this.curves, this.zoom);
    const [[left, right], [low, high]] = [this.view.x, this.view.y];
    this.plot.batch(() => {
      this.plot.setScale("x", { min: left, max: right });
      this.plot.setScale("y", { min: low, max: high });
    });
    this.reset.hidden = this.zoom === null;
    this.describe();
  }

  private describe(): void {
    this.stage.setAttribute("aria-label", chartText(this.block, this.curves, this.view));
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
    const ground = { curves: this.curves, shown: this.shown, x: this.view.x };
    const place = walk(ground, this.place, event.key, event.shiftKey ? 10 : 1);
    if (!place) return;
    event.preventDefault();
    event.stopPropagation(); // the player may move by these keys too
    this.readAloud(place);
  }

  private readAloud(place: Place): void {
    const curve = this.curves[place.curve];
    if (!curve) return;
    this.place = place;
    const { plot } = this;
    const { [place.sample]: x = NaN } = curve.x;
    const { [place.sample]: y = NaN } = curve.y;
    plot.setCursor({ left: plot.valToPos(x, "x"), top: plot.valToPos(y, "y") });
    announce(sampleText(this.block, curve, place.sample, this.view));
  }
}
