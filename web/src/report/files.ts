// A chart's numbers and picture as files.
import type { ChartBlock } from "../contract";
import { download } from "../dom";
import type { Samples } from "./curves";

type Column = Samples["x"];

export const fileName = (title: string, ending: string): string =>
  `${title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "chart"}.${ending}`;

const quoted = (text: string): string => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

// The shortest digits that give the same number back.
function digits(value: number | undefined, single: boolean): string {
  if (value === undefined || Number.isNaN(value)) return "";
  if (!single) return String(value);
  const rounded = [6, 7, 8].map((count) => Number(value.toPrecision(count)));
  const short = rounded.find((candidate) => Math.fround(candidate) === value);
  return String(short ?? Number(value.toPrecision(9)));
}

const same = (a: Column, b: Column): boolean => a.length === b.length && a.every((value, i) => value === b[i]);

// One column of x where all curves share it, otherwise one beside each curve.
export function csvOf(block: ChartBlock, curves: readonly Samples[]): string {
  const [first] = curves;
  const shared = first !== undefined && curves.every((curve) => same(curve.x, first.x));
  const columns: [string, Column][] = shared ? [[block.x.label, first.x]] : [];
  for (const curve of curves) {
    const named = (axis: string): string => (curve.label === "" ? axis : `${curve.label}: ${axis}`);
    if (!shared) columns.push([named(block.x.label), curve.x]);
    columns.push([named(block.y.label), curve.y]);
  }
  const rows = Math.max(0, ...columns.map(([, column]) => column.length));
  const lines = [columns.map(([name]) => quoted(name)).join(",")];
  for (let i = 0; i < rows; ++i)
    lines.push(columns.map(([, column]) => digits(column[i], column instanceof Float32Array)).join(","));
  return lines.join("\n") + "\n";
}

export const saveCsv = (block: ChartBlock, curves: readonly Samples[]): void =>
  download(fileName(block.title, "csv"), new Blob([csvOf(block, curves)], { type: "text/csv" }));

export const savePicture = (title: string, picture: HTMLCanvasElement): void =>
  picture.toBlob((blob) => blob && download(fileName(title, "png"), blob));
