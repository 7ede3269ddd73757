// Vertical lines with their names, like flags above the plot: no curve is hidden.
import uPlot from "uplot";
import type { ChartBlock } from "../contract";
import { color } from "../theme";
import type { View } from "./curves";
import { font, typeSize } from "./style";

const rowHeight = typeSize + 3; // [px]
const rowsAtMost = 4;
const axisSpace = 70; // about what stands beside the plot [px]

export interface Flag {
  readonly x: number;
  readonly label: string;
  readonly row: number; // from the top
  readonly toLeft: boolean; // at the right edge
}

// A name that would run into one before it takes a row below, so that its staff crosses none.
export function flagsOf(
  block: ChartBlock,
  { x: [low, high] }: View,
  chartWidth: number,
  measure: (text: string) => number,
): Flag[] {
  const along = block.x.logarithmic ? Math.log10 : (x: number): number => x;
  const width = chartWidth - axisSpace;
  const ends: number[] = [];
  const seen = block.marks.filter(({ x }) => x >= low && x <= high).sort((a, b) => a.x - b.x);
  return seen.map(({ x, label }) => {
    const staff = ((along(x) - along(low)) / (along(high) - along(low))) * width;
    const length = measure(label) + 10;
    const toLeft = staff + length > width + 20;
    const start = toLeft ? staff - length : staff;
    let row = ends.length;
    while (row > 0 && (ends[row - 1] ?? 0) <= start) --row;
    row = Math.min(row, rowsAtMost - 1);
    ends[row] = start + length;
    return { x, label, row, toLeft };
  });
}

export const heightOf = (flags: readonly Flag[]): number => Math.max(0, ...flags.map(({ row }) => row + 1)) * rowHeight;

// One CSS pixel is `unit` dots of the canvas.
export function drawFlags({ ctx, bbox, valToPos }: uPlot, flags: readonly Flag[], unit: number): void {
  ctx.save();
  ctx.font = font(unit);
  ctx.textBaseline = "top";
  ctx.lineWidth = unit;
  ctx.strokeStyle = color("ink-soft");
  ctx.fillStyle = color("ink");
  for (const { x, label, row, toLeft } of flags) {
    const staff = valToPos(x, "x", true);
    const top = bbox.top - heightOf(flags) * unit + row * rowHeight * unit;
    ctx.setLineDash([3 * unit, 2 * unit]);
    ctx.beginPath();
    ctx.moveTo(staff, top);
    ctx.lineTo(staff, bbox.top + bbox.height);
    ctx.stroke();
    ctx.textAlign = toLeft ? "right" : "left";
    ctx.fillText(label, staff + (toLeft ? -4 : 4) * unit, top + unit);
  }
  ctx.restore();
}
