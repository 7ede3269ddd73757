// What stands beside the curves of a chart: cones, barriers, limits. And charts that are maps, both axes to one scale.
import uPlot from "uplot";
import type { ChartBlock } from "../contract";
import type { LoadedDocument } from "../document";
import { color } from "../theme";
import type { Limits, Samples, View } from "./curves";
import type { LegendEntry } from "./legend";
import { font } from "./style";

const coneSize = 4.5; // from its middle to its tip [px]

export const conesOf = (block: ChartBlock, loaded: LoadedDocument): Samples[] =>
  (block.cones ?? []).map(({ label, x, y }) => ({
    label,
    x: loaded.column(x),
    y: loaded.column(y),
    points: true,
    rising: false,
  }));

export const namesOf = (cones: readonly Samples[]): LegendEntry[] =>
  cones.filter(({ label }) => label !== "").map(({ label }) => ({ label, color: null }));

// The ends of barriers, so that a view has room for them.
export function endsOf({ lines = [] }: ChartBlock): Samples[] {
  if (lines.length === 0) return [];
  const x = Float64Array.from(lines.flatMap(([x0, , x1]) => [x0, x1]));
  const y = Float64Array.from(lines.flatMap(([, y0, , y1]) => [y0, y1]));
  return [{ label: "", x, y, points: false, rising: false }];
}

const widened = ([low, high]: Limits, span: number): Limits => {
  const middle = (low + high) / 2;
  return [middle - span / 2, middle + span / 2];
};

// The smallest view that shows all of this one on so many pixels with both axes to one scale.
export function leveled({ x, y }: View, { width, height }: { readonly width: number; readonly height: number }): View {
  const scale = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
  return { x: widened(x, scale * width), y: widened(y, scale * height) };
}

// How high a map stands for its width, within what a page has room for; the rest of its place is left empty.
export function mapHeight({ x, y }: View, width: number): number {
  const beside = 66; // axis and margin
  const around = 70; // name, axis and its name
  const needed = ((width - beside) * (y[1] - y[0])) / (x[1] - x[0]) + around;
  return Math.round(Math.min(Math.max(needed, 170), 440, Math.max(width * 0.9, 300)));
}

// A lane of cones is far longer than wide: it gets a row of its own.
export const spreads = ({ x, y }: View): boolean => x[1] - x[0] > 2.5 * (y[1] - y[0]);

// One CSS pixel is `unit` dots of the canvas.
function trace(ctx: CanvasRenderingContext2D, x: number, y: number, unit: number): void {
  const size = coneSize * unit;
  ctx.beginPath();
  ctx.moveTo(x, y - size);
  ctx.lineTo(x + size, y + 0.8 * size);
  ctx.lineTo(x - size, y + 0.8 * size);
  ctx.closePath();
}

export function drawCone(ctx: CanvasRenderingContext2D, x: number, y: number, unit: number): void {
  trace(ctx, x, y, unit);
  ctx.fillStyle = color("cone");
  ctx.fill();
  ctx.strokeStyle = color("ink");
  ctx.lineWidth = 0.5 * unit;
  ctx.setLineDash([]);
  ctx.stroke();
}

function drawBarriers({ ctx, valToPos }: uPlot, { lines = [] }: ChartBlock, unit: number): void {
  ctx.strokeStyle = color("ink-soft");
  ctx.lineWidth = 1.2 * unit;
  ctx.setLineDash([]);
  ctx.beginPath();
  for (const [x0, y0, x1, y1] of lines) {
    ctx.moveTo(valToPos(x0, "x", true), valToPos(y0, "y", true));
    ctx.lineTo(valToPos(x1, "x", true), valToPos(y1, "y", true));
  }
  ctx.stroke();
}

// Its name stands on the line, or below it where there is no room, with a rim in the page's color where curves pass.
function drawLimits({ ctx, bbox, valToPos }: uPlot, { horizontal_marks = [] }: ChartBlock, unit: number): void {
  const right = bbox.left + bbox.width;
  ctx.font = font(unit);
  ctx.textAlign = "right";
  for (const { y, label } of horizontal_marks) {
    const level = valToPos(y, "y", true);
    ctx.strokeStyle = color("ink-soft");
    ctx.lineWidth = unit;
    ctx.setLineDash([3 * unit, 2 * unit]);
    ctx.beginPath();
    ctx.moveTo(bbox.left, level);
    ctx.lineTo(right, level);
    ctx.stroke();
    ctx.setLineDash([]);
    ctx.lineWidth = 3 * unit;
    ctx.strokeStyle = color("panel");
    ctx.fillStyle = color("ink");
    const below = level - bbox.top < 14 * unit;
    ctx.textBaseline = below ? "top" : "bottom";
    const at = [right - 2 * unit, level + (below ? 3 : -1) * unit] as const;
    ctx.strokeText(label, ...at);
    ctx.fillText(label, ...at);
  }
}

export function drawGround(plot: uPlot, block: ChartBlock, cones: readonly Samples[], unit: number): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  const margin = (coneSize + 1) * unit; // a cone at the edge is seen whole
  ctx.rect(bbox.left - margin, bbox.top - margin, bbox.width + 2 * margin, bbox.height + 2 * margin);
  ctx.clip();
  drawBarriers(plot, block, unit);
  for (const { x, y } of cones)
    for (let i = 0; i < x.length; ++i)
      drawCone(ctx, plot.valToPos(x[i] ?? NaN, "x", true), plot.valToPos(y[i] ?? NaN, "y", true), unit);
  drawLimits(plot, block, unit);
  ctx.restore();
}
