// Numbers of the chosen channels at the time that is shown, one column for each run.
import { element } from "../dom";
import { significant } from "../report/numbers";
import { unitText, words } from "./sheet";
import type { Track } from "./track";

interface Reading {
  readonly cell: HTMLTableCellElement;
  readonly text: Text;
  readonly track: Track;
  readonly channel: number;
}

export class Readout {
  readonly root = element("div", { class: "replay-readout" });
  private readings: Reading[] = [];

  constructor(private readonly tracks: readonly Track[]) {}

  choose(names: readonly string[]): void {
    this.readings = [];
    const rows = names.map((name) => this.rowOf(name));
    const several = this.tracks.length > 1;
    const heads = this.tracks.map(({ run }) => element("th", { scope: "col" }, run.name));
    const head = element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "Channel"), ...heads));
    const caption = element("caption", { class: "unseen" }, "Values of the chosen channels at the time shown");
    this.root.replaceChildren(element("table", {}, caption, several ? head : null, element("tbody", {}, ...rows)));
    this.show();
  }

  // Of the rows as they were sampled last.
  show(): void {
    for (let i = 0; i < this.readings.length; ++i) {
      const { cell, text, track, channel } = this.readings[i]!;
      const value = track.row[channel]!;
      cell.dataset["value"] = String(value);
      text.data = significant(value, 5);
    }
  }

  private rowOf(name: string): HTMLElement {
    const unit = this.tracks.map((track) => track.channel(name)).find((channel) => channel !== null)?.unit ?? "";
    const unitOf = element("span", { class: "replay-unit" }, unitText(unit));
    const head = element("th", { scope: "row" }, words(name), unitOf);
    return element("tr", {}, head, ...this.tracks.map((track, run) => this.cellOf(name, track, run)));
  }

  private cellOf(name: string, track: Track, run: number): HTMLElement {
    const channel = track.names.indexOf(name);
    if (channel < 0) return element("td", {}, "–");
    const text = document.createTextNode("");
    const cell = element("td", { "data-channel": name, "data-run": run }, text);
    this.readings.push({ cell, text, track, channel });
    return cell;
  }
}
