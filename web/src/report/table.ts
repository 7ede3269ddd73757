// A table as a journal sets it: few rules, numbers under numbers; where a column names units, numbers of one row belong
// together. The full number is in the cell's title.
import type { Cell, TableBlock } from "../contract";
import { element } from "../dom";
import { fixed, raisePowers, significant, withoutRoundOff } from "./numbers";
import "./table.css";

const digits = 4;
const fewDigits = 3; // of the smallest number beside a large one
const aligned = 1e3; // numbers that differ more than so have no decimals in common
const manyRows = 40; // of a table that scrolls

type Format = (value: number) => string;

const magnitude = (value: number): number => Math.floor(Math.log10(Math.abs(value)));

// As somebody types it, without the noise of binary fractions: "0.19"; null where that takes too many digits.
function typed(value: number): string | null {
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return String(value);
  const text = String(Number(value.toPrecision(12)));
  const long = text.includes("e") || text.replace(/[-.]/g, "").replace(/^0+/, "").length > digits;
  return long ? null : text;
}

const decimalsOf = (text: string): number => text.split(".")[1]?.length ?? 0;

function alone(value: number): string {
  const text = typed(value);
  return text === null ? significant(value, digits) : fixed(value, decimalsOf(text));
}

// Numbers that belong together have as many decimals as the largest needs and the smallest is to keep.
function formatOf(cells: readonly Cell[]): Format {
  const numbers = cells
    .filter((cell) => typeof cell === "number" && Number.isFinite(cell))
    .map((cell) => withoutRoundOff(cell as number, 0));
  const texts = numbers.map(typed);
  if (texts.every((text) => text !== null)) {
    const decimals = Math.max(0, ...texts.map(decimalsOf));
    return (value) => fixed(value, decimals);
  }
  const sizes = numbers.map(Math.abs).filter((size) => size > 0);
  const [smallest, largest] = [Math.min(...sizes), Math.max(...sizes)];
  if (!(largest < 1e7 && smallest >= 1e-4 && largest / smallest < aligned)) return alone;
  const decimals = Math.max(0, digits - 1 - magnitude(largest), fewDigits - 1 - magnitude(smallest));
  return (value) => (Number.isFinite(value) ? fixed(value, decimals) : significant(value));
}

function textOf(cell: Cell): string {
  if (cell === null) return "";
  return typeof cell === "object" ? cell.text : String(cell);
}

// A path's parts, so that no folder's name is taken for a query or another site.
const addressOf = (file: string): string => "./" + file.split("/").map(encodeURIComponent).join("/");

// Short words stay on one line, though the table may scroll for it.
function kindOf(cells: readonly Cell[]): string | null {
  if (cells.some((cell) => typeof cell === "number")) return "number";
  return cells.every((cell) => textOf(cell).length <= 24) ? "short" : null;
}

function cellOf(cell: Cell, format: Format, kind: string | null, leads: boolean): HTMLElement {
  if (cell === null) return element("td", { class: kind }, element("span", { "aria-label": "none" }, "–"));
  if (typeof cell === "number") return element("td", { class: kind, title: String(cell) }, format(withoutRoundOff(cell, 0)));
  if (typeof cell === "object") return element("td", { class: kind }, element("a", { href: addressOf(cell.file) }, cell.text));
  return leads ? element("th", { scope: "row", class: kind }, cell) : element("td", { class: kind }, cell);
}

export function createTable({ title, columns, rows }: TableBlock): HTMLElement {
  const cells = columns.map((_column, i) => rows.map((row) => row[i] ?? null));
  const byRow = columns.some(({ name }) => name === "unit");
  const formats = (byRow ? rows : cells).map(formatOf);
  const kinds = cells.map(kindOf);
  const head = columns.map(({ name, unit }, i) =>
    element(
      "th",
      { scope: "col", class: kinds[i] === "number" ? "number" : null },
      name,
      unit === "" || unit === "1" ? null : element("span", { class: "unit" }, ` [${raisePowers(unit)}]`),
    ),
  );
  const cellAt = (row: number, i: number): HTMLElement => {
    const cell = rows[row]?.[i] ?? null;
    const shown = typeof cell === "string" && columns[i]?.name === "unit" ? raisePowers(cell) : cell;
    return cellOf(shown, formats[byRow ? row : i] ?? String, kinds[i] ?? null, i === 0);
  };
  const body = rows.map((_row, at) => element("tr", {}, ...columns.map((_column, i) => cellAt(at, i))));
  const table = element(
    "table",
    {},
    element("caption", {}, title),
    element("thead", {}, element("tr", {}, ...head)),
    element("tbody", {}, ...body),
  );
  const frame = element(
    "div",
    { class: rows.length > manyRows ? "table long" : "table", role: "region", "aria-label": title },
    table,
  );
  // Only what scrolls needs to be reached by keys.
  new ResizeObserver(() => {
    const scrolls = frame.scrollHeight > frame.clientHeight + 1 || frame.scrollWidth > frame.clientWidth + 1;
    if (scrolls) frame.tabIndex = 0;
    else frame.removeAttribute("tabindex");
  }).observe(frame);
  return frame;
}
