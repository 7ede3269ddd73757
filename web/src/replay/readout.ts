// Numbers of the chosen channels at the time that is shown, one column for each run.
import { displayOf } from "../channels";
import { element } from "../dom";
import { largest, significant, withoutRoundOff } from "../report/numbers";
import { unitText, words } from "./sheet";
import type { Track } from "./track";

interface Reading {
  readonly cell: HTMLTableCellElement;
  readonly text: Text;
  readonly track: Track;
  readonly channel: number;
  readonly factor: number; // of the unit that is shown
  readonly size: number; // of the run's largest value
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
      const { cell, text, track, channel, factor, size } = this.readings[i]!;
      const value = track.row[channel]!;
      cell.dataset["value"] = String(value);
      text.data = significant(factor * withoutRoundOff(value, size), 5);
    }
  }

  private rowOf(name: string): HTMLElement {
    const channel = this.tracks.map((track) => track.channel(name)).find((found) => found !== null);
    const unitOf = element("span", { class: "replay-unit" }, unitText(channel));
    const head = element("th", { scope: "row" }, words(name), unitOf);
    return element("tr", {}, head, ...this.tracks.map((track, run) => this.cellOf(name, track, run)));
  }

  private cellOf(name: string, track: Track, run: number): HTMLElement {
    const channel = track.channels.named(name);
    if (channel < 0) return element("td", {}, "–");
    const text = document.createTextNode("");
    const cell = element("td", { "data-channel": name, "data-run": run }, text);
    const { factor } = displayOf(track.channels.list[channel]!);
    this.readings.push({ cell, text, track, channel, factor, size: largest(track.column(name) ?? []) });
    return cell;
  }
}
