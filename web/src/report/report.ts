// The blocks of a document in their order: charts that follow each other share a grid, tables a row; all else takes the
// width.
import type { Block } from "../contract";
import type { LoadedDocument } from "../document";
import { element } from "../dom";
import { createChart } from "./chart";
import { raisePowers } from "./numbers";
import { createTable } from "./table";
import { createVerdicts } from "./verdicts";

// Puts the player where the document wants it.
export type PlaceReplay = (host: HTMLElement) => void;

// Four charts stand two by two.
const columnsFor = (count: number): number => (count === 4 ? 2 : Math.max(Math.min(3, count), 1));

function elementOf(block: Block, loaded: LoadedDocument, placeReplay: PlaceReplay): HTMLElement {
  switch (block.kind) {
    case "heading":
      return element("h2", {}, raisePowers(block.text));
    case "text":
      return element("p", {}, raisePowers(block.text));
    case "chart":
      return createChart(block, loaded);
    case "table":
      return createTable(block);
    case "verdicts":
      return createVerdicts(block.list);
    case "replay": {
      const host = element("section", { class: "replay", "aria-label": "Replay" });
      placeReplay(host);
      return host;
    }
  }
}

// Blocks of one kind that follow each other.
function neighbors(blocks: readonly Block[]): Block[][] {
  const groups: Block[][] = [];
  for (const block of blocks) {
    const last = groups[groups.length - 1];
    if (last?.[0]?.kind === block.kind) last.push(block);
    else groups.push([block]);
  }
  return groups;
}

export function renderReport(loaded: LoadedDocument, blocks: readonly Block[], placeReplay: PlaceReplay): HTMLElement {
  const report = element("article", { class: "report" });
  for (const group of neighbors(blocks)) {
    const made = group.map((block) => elementOf(block, loaded, placeReplay));
    const kind = group[0]?.kind;
    const style = `--columns: ${columnsFor(made.filter((one) => !one.classList.contains("wide")).length)}`;
    if (kind === "chart") report.append(element("div", { class: "charts", style }, ...made));
    else if (kind === "table") report.append(element("div", { class: "tables" }, ...made));
    else report.append(...made);
  }
  return report;
}
