// A table as a journal sets it: few rules, numbers under numbers. The full number is in the cell's title.
import type { Cell, TableBlock } from "../document";
import { element } from "../dom";
import { fixed, significant } from "./numbers";
import "./table.css";

const digits = 4;
const aligned = 1e3; // numbers that differ more than so have no decimals in common

type Format = (value: number) => string;

// Numbers of one column have as many decimals as the largest needs, as long as that leaves the smallest enough of them.
function formatOf(cells: readonly Cell[]): Format {
  const numbers = cells.filter((cell) => typeof cell === "number" && Number.isFinite(cell)) as number[];
  const sizes = numbers.map(Math.abs).filter((size) => size > 0);
  const [least, largest] = [Math.min(...sizes), Math.max(...sizes)];
  if (numbers.every(Number.isInteger) && largest < 1e9) return (value) => fixed(value, 0);
  if (!(largest < 1e7 && least >= 1e-4 && largest / least < aligned)) return (value) => significant(value, digits);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(largest)));
  return (value) => (Number.isFinite(value) ? fixed(value, decimals) : significant(value));
}

// Short words stay on one line, though the table may scroll for it.
function kindOf(cells: readonly Cell[]): string | null {
  if (cells.some((cell) => typeof cell === "number")) return "number";
  return cells.every((cell) => String(cell ?? "").length <= 24) ? "short" : null;
}

function cellOf(cell: Cell, format: Format, kind: string | null, leads: boolean): HTMLElement {
  if (cell === null) return element("td", { class: kind }, element("span", { "aria-label": "none" }, "–"));
  if (typeof cell === "number") return element("td", { class: kind, title: String(cell) }, format(cell));
  return leads ? element("th", { scope: "row", class: kind }, cell) : element("td", { class: kind }, cell);
}

export function createTable({ title, columns, rows }: TableBlock): HTMLElement {
  const cells = columns.map((_column, i) => rows.map((row) => row[i] ?? null));
  const formats = cells.map(formatOf);
  const kinds = cells.map(kindOf);
  const head = columns.map(({ name, unit }, i) =>
    element(
      "th",
      { scope: "col", class: kinds[i] === "number" ? "number" : null },
      name,
      unit === "" || unit === "1" ? null : element("span", { class: "unit" }, ` [${unit}]`),
    ),
  );
  const cellAt = (row: readonly Cell[], i: number): HTMLElement =>
    cellOf(row[i] ?? null, formats[i] ?? String, kinds[i] ?? null, i === 0);
  const body = rows.map((row) => element("tr", {}, ...columns.map((_column, i) => cellAt(row, i))));
  const table = element(
    "table",
    {},
    element("caption", {}, title),
    element("thead", {}, element("tr", {}, ...head)),
    element("tbody", {}, ...body),
  );
  const frame = element("div", { class: "table", role: "region", "aria-label": title }, table);
  // Only what scrolls needs to be reached by keys.
  new ResizeObserver(() => {
    const scrolls = frame.scrollHeight > frame.clientHeight + 1 || frame.scrollWidth > frame.clientWidth + 1;
    if (scrolls) frame.tabIndex = 0;
    else frame.removeAttribute("tabindex");
  }).observe(frame);
  return frame;
}
