// A chart in words, for those who do not see it.
import type { Axis, ChartBlock } from "../contract";
import { visible, type Limits, type Samples, type View } from "./curves";
import { raisePowers, reading } from "./numbers";

// Units of all its texts as people read them.
export function withPowers(block: ChartBlock): ChartBlock {
  const raised = <Labeled extends { readonly label: string }>(one: Labeled): Labeled =>
    ({ ...one, label: raisePowers(one.label) });
  return {
    ...block,
    title: raisePowers(block.title),
    x: raised(block.x),
    y: raised(block.y),
    curves: block.curves.map(raised),
    marks: block.marks.map(raised),
    ...(block.horizontal_marks ? { horizontal_marks: block.horizontal_marks.map(raised) } : {}),
  };
}

const partsOf = ({ label }: Axis): readonly [string, string] => {
  const [, name = label, unit = ""] = /^(.*?)\s*\[(.*)\]$/.exec(label) ?? [];
  return [name, unit === "1" ? "" : unit];
};

export function valueText(axis: Axis, value: number, [low, high]: Limits): string {
  const [, unit] = partsOf(axis);
  return `${reading(value, axis.logarithmic ? 0 : high - low)}${unit === "" ? "" : ` ${unit}`}`;
}

const rangeText = (axis: Axis, limits: Limits): string =>
  `${partsOf(axis)[0]} from ${valueText(axis, limits[0], limits)} to ${valueText(axis, limits[1], limits)}`;

const counted = (count: number, one: string): string => `${count} ${one}${count === 1 ? "" : "s"}`;

// Cones, barriers and limits; [] where there are none.
function groundTexts({ y, lines = [], horizontal_marks = [] }: ChartBlock, cones: readonly Samples[], view: View): string[] {
  const standing = cones.reduce((sum, { x }) => sum + x.length, 0);
  const things = [
    standing > 0 ? counted(standing, "cone") : "",
    lines.length > 0 ? counted(lines.length, "barrier") : "",
  ].filter((text) => text !== "");
  const limits = horizontal_marks.map((mark) => `${mark.label} at ${valueText(y, mark.y, view.y)}`);
  return [
    ...(things.length > 0 ? [`On the ground: ${things.join(" and ")}`] : []),
    ...(limits.length > 0 ? [`Limits: ${limits.join(", ")}`] : []),
  ];
}

export function chartText(
  block: ChartBlock,
  curves: readonly Samples[],
  cones: readonly Samples[],
  view: View,
): string {
  const names = curves.map(({ label }) => label).filter((label) => label !== "");
  const count = counted(curves.length, "curve");
  const named = names.length > 0 ? `${count}: ${names.join(", ")}` : count;
  return [
    `${block.title}. ${partsOf(block.y)[0]} over ${partsOf(block.x)[0]}, ${named}`,
    ...groundTexts(block, cones, view),
    `Shown: ${rangeText(block.x, view.x)}, ${rangeText(block.y, view.y)}`,
    "Arrow keys read the curves.",
  ].join(". ");
}

export function sampleText(block: ChartBlock, curve: Samples, i: number, view: View): string {
  const name = curve.label === "" ? "" : `${curve.label}: `;
  const y = visible(curve, i) ? valueText(block.y, curve.y[i] ?? NaN, view.y) : "nothing";
  return `${name}${valueText(block.x, curve.x[i] ?? NaN, view.x)}, ${y}`;
}
