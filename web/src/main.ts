// The page: a report with its charts and its player where a document stands in it, otherwise the driving simulator.
import { loadDocument, type LoadedDocument } from "./document";
import { element } from "./dom";
import { startLive } from "./live/live";
import { mountReplay } from "./replay/replay";
import { createHeader } from "./report/header";
import { describeKeys, listenForHelp } from "./report/help";
import { renderReport } from "./report/report";
import "./theme.css";
import "./page.css";

function showReport(host: HTMLElement, loaded: LoadedDocument): void {
  const { title, blocks } = loaded.document;
  document.title = `${title} – Hamilcar`;
  if (blocks.some(({ kind }) => kind === "chart"))
    describeKeys("Chart that has the focus", [
      { keys: ["←", "→"], does: "read the curve, sample by sample; with Shift by ten" },
      { keys: ["↑", "↓"], does: "read another curve" },
      { keys: ["Home", "End"], does: "go to either end" },
      { keys: ["Esc"], does: "show all again after zooming" },
    ]);

  // The player measures its host: it comes once everything is in the page.
  const players: HTMLElement[] = [];
  const place = (player: HTMLElement): void => void players.push(player);
  const header = createHeader(loaded.document);
  const leads = blocks[0]?.kind === "replay";
  const report = renderReport(loaded, blocks, place);
  if (leads) host.append(element("div", { class: "screenful" }, header, ...players));
  else host.append(header);
  if (report.childElementCount > 0) host.append(report);
  players.forEach((player) => mountReplay(player, loaded));
}

function markReady(): void {
  performance.mark("hamilcar-ready");
  performance.measure("hamilcar-ready", { start: 0, end: "hamilcar-ready" });
  document.documentElement.dataset["ready"] = "true";
}

const host = document.getElementById("page");
if (!host) throw new Error("The page has no place for its content.");
listenForHelp();
const loaded = loadDocument(document);
if (loaded) {
  showReport(host, loaded);
  // Two frames on, what was built has been laid out and drawn.
  requestAnimationFrame(() => requestAnimationFrame(markReady));
} else {
  startLive(host); // ready when the first picture of the car has come
}
