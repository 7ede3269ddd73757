// uPlot set up for one chart, on the screen and, larger, as a picture for paper.
import uPlot from "uplot";
import type { ChartBlock } from "../contract";
import { color, seriesColor, seriesDash } from "../theme";
import { visible, type Samples, type View } from "./curves";
import type { LegendEntry } from "./legend";
import { drawCone, drawGround, leveled } from "./ground";
import { drawFlags, flagsOf, heightOf, type Flag } from "./marks";
import { drawAxisName } from "./plot";
import { axisOf, curveOf, font, textWidth } from "./style";

// uPlot wants one curve at least; a map may have nothing but cones.
const none = new Float64Array(0);
const nothing: readonly Samples[] = [{ label: "", x: none, y: none, points: false, rising: true }];
const plotted = (curves: readonly Samples[]): readonly Samples[] => (curves.length > 0 ? curves : nothing);

// Many x at once: uPlot's faceted mode, where every curve has its own.
export const dataOf = (curves: readonly Samples[]): uPlot.AlignedData =>
  [null, ...plotted(curves).map(({ x, y }) => [x, y])] as unknown as uPlot.AlignedData;

function seriesOf(curve: Samples, index: number, factor: number): uPlot.Series {
  const seen = curve.points ? [...curve.x.keys()].filter((i) => visible(curve, i)) : [];
  return {
    ...curveOf(index, factor),
    facets: [{ scale: "x" }, { scale: "y" }],
    points: {
      show: curve.points,
      filter: () => seen,
      size: 5 * factor,
      width: 0,
      fill: () => seriesColor(index),
    },
  };
}

// Of a map the place of the drawing must not hang on its numbers, which hang on the place.
const mapAxis = (factor: number): { readonly size: number } => ({ size: 46 * factor });

// On the plot as it is laid out; a map shows more than it was asked for.
export function showView(plot: uPlot, block: ChartBlock, wanted: View): View {
  const view = block.equal_axes ? leveled(wanted, plot.bbox) : wanted;
  const [[left, right], [low, high]] = [view.x, view.y];
  plot.batch(() => {
    plot.setScale("x", { min: left, max: right });
    plot.setScale("y", { min: low, max: high });
  });
  return view;
}

export interface Setting {
  readonly block: ChartBlock;
  readonly curves: readonly Samples[];
  readonly cones: readonly Samples[];
  readonly view: () => View;
  readonly width: number;
  readonly height: number;
  readonly factor?: number;
}

export function optionsOf({ block, curves, cones, view, width, height, factor = 1 }: Setting): uPlot.Options {
  const scale = (which: "x" | "y"): uPlot.Scale => ({
    time: false,
    auto: false,
    distr: block[which].logarithmic ? 3 : 1,
    range: () => [...view()[which]],
  });
  const flags = (plot: uPlot): Flag[] =>
    flagsOf(block, view(), plot.width / factor, (text) => textWidth(plot, text));
  return {
    mode: 2,
    width: width * factor,
    height: height * factor,
    padding: [(plot) => (24 + heightOf(flags(plot))) * factor, 20 * factor, 0, 0],
    legend: { show: false },
    cursor: { show: false },
    scales: { x: scale("x"), y: scale("y") },
    axes: [
      axisOf({ scale: "x", label: block.x.label, logarithmic: block.x.logarithmic, factor }),
      axisOf({ scale: "y", logarithmic: block.y.logarithmic, factor, ...(block.equal_axes ? mapAxis(factor) : {}) }),
    ],
    series: [{}, ...plotted(curves).map((curve, i) => seriesOf(curve, i, factor))],
    hooks: {
      drawAxes: [(plot) => drawAxisName(plot, block.y.label, factor)],
      draw: [
        (plot) => drawGround(plot, block, cones, factor * devicePixelRatio),
        (plot) => drawFlags(plot, flags(plot), factor * devicePixelRatio),
      ],
    },
  };
}

// As it is zoomed, with curves left out that are switched off; drawn when the call returns.
export function drawPicture(setting: Setting, shown: readonly boolean[]): HTMLCanvasElement {
  const options = optionsOf(setting);
  shown.forEach((show, i) => Object.assign(options.series[i + 1] ?? {}, { show }));
  const plot = new uPlot(options, dataOf(setting.curves));
  plot.batch(() => undefined);
  if (setting.block.equal_axes) showView(plot, setting.block, setting.view());
  const picture = document.createElement("canvas");
  picture.width = plot.ctx.canvas.width;
  picture.height = plot.ctx.canvas.height;
  picture.getContext("2d")?.drawImage(plot.ctx.canvas, 0, 0);
  plot.destroy();
  return picture;
}

// A picture that stands alone: with its title above, the names of its curves below, on the color of the page.
export function framePicture(
  plot: HTMLCanvasElement,
  title: string,
  entries: readonly LegendEntry[],
  unit: number, // [dots] of one CSS pixel
): HTMLCanvasElement {
  const margin = 12 * unit;
  const line = 20 * unit;
  const named = entries.filter(({ label }) => label !== "");
  const framed = document.createElement("canvas");
  const ctx = framed.getContext("2d");
  framed.width = plot.width + 2 * margin;
  framed.height = plot.height + 2 * margin + line * 1.5 + named.length * line;
  if (!ctx) return framed;
  ctx.fillStyle = color("panel");
  ctx.fillRect(0, 0, framed.width, framed.height);
  ctx.drawImage(plot, margin, margin + line * 1.5);
  ctx.textBaseline = "middle";
  ctx.fillStyle = color("ink");
  ctx.font = font(unit * 1.25, 600);
  ctx.fillText(title, margin, margin + line / 2);
  ctx.font = font(unit);
  named.forEach(({ label, color: index }, i) => {
    const y = plot.height + margin + line * (2 + i);
    ctx.fillStyle = color("ink");
    ctx.fillText(label, margin + 36 * unit, y);
    if (index === null) return drawCone(ctx, margin + 14 * unit, y, unit);
    ctx.lineWidth = 2 * unit;
    ctx.strokeStyle = seriesColor(index);
    ctx.setLineDash(seriesDash(index).map((length) => length * unit));
    ctx.beginPath();
    ctx.moveTo(margin, y);
    ctx.lineTo(margin + 28 * unit, y);
    ctx.stroke();
  });
  return framed;
}
