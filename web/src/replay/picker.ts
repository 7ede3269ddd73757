// Which channels are shown: all of them by their first word, found by typing.
import { isMotion } from "../channels";
import type { Channel } from "../contract";
import { element } from "../dom";
import { unitText, words } from "./sheet";
import type { Track } from "./track";

interface Entry {
  readonly channel: Channel;
  readonly row: HTMLElement;
  readonly box: HTMLInputElement;
}

interface Group {
  readonly root: HTMLDetailsElement;
  readonly count: HTMLElement;
  readonly entries: readonly Entry[];
}

function channelsOf(tracks: readonly Track[]): Channel[] {
  const all = new Map<string, Channel>();
  for (const channel of tracks.flatMap(({ run }) => run.channels)) {
    if (!all.has(channel.name)) all.set(channel.name, channel);
  }
  all.delete("time");
  return [...all.values()];
}

// Poses and contacts, which only the picture needs, stand last.
function groupName(channel: Channel): string {
  const { name } = channel;
  if (isMotion(channel)) return "motion";
  const dot = name.indexOf(".");
  return dot > 0 ? name.slice(0, dot) : "other";
}

export class Picker {
  readonly root = element("div", { class: "replay-picker" });
  onChange: (names: readonly string[]) => void = () => {};
  private readonly groups: readonly Group[];
  private readonly search = element("input", {
    type: "search", placeholder: "Find a channel", "aria-label": "Find a channel", oninput: () => this.filter(),
  });
  private readonly none = element("p", { class: "replay-empty", hidden: true }, "No channel has this in its name.");

  constructor(tracks: readonly Track[], private chosen: readonly string[]) {
    const byGroup = new Map<string, Channel[]>();
    for (const channel of channelsOf(tracks)) {
      const name = groupName(channel);
      byGroup.set(name, [...(byGroup.get(name) ?? []), channel]);
    }
    const order = [...byGroup].sort(([a], [b]) => Number(a === "motion") - Number(b === "motion"));
    this.groups = order.map(([name, channels]) => this.groupOf(name, channels));
    const list = element("div", { class: "replay-channels" }, ...this.groups.map((group) => group.root), this.none);
    const clear = element("button", { type: "button", class: "replay-button", onclick: () => this.clear() }, "Clear");
    this.root.append(element("div", { class: "replay-find" }, this.search, clear), list);
    this.countAll();
  }

  focus(): void {
    this.search.focus();
  }

  private groupOf(name: string, channels: readonly Channel[]): Group {
    const entries = channels.map((channel) => this.entryOf(channel));
    const count = element("span", { class: "replay-count" });
    const root = element(
      "details", {}, element("summary", {}, words(name), count),
      element("fieldset", {}, element("legend", { class: "unseen" }, words(name)), ...entries.map(({ row }) => row)),
    );
    return { root, count, entries };
  }

  private entryOf(channel: Channel): Entry {
    const box = element("input", {
      type: "checkbox", value: channel.name, checked: this.chosen.includes(channel.name),
      onchange: () => this.choose(channel.name, box.checked),
    });
    const dot = channel.name.indexOf(".");
    const name = element("span", {}, isMotion(channel) ? channel.name : channel.name.slice(dot + 1));
    const unit = element("span", { class: "replay-unit" }, unitText(channel));
    return { channel, box, row: element("label", { title: channel.description }, box, name, unit) };
  }

  private choose(name: string, on: boolean): void {
    this.chosen = on ? [...this.chosen, name] : this.chosen.filter((other) => other !== name);
    this.countAll();
    this.onChange(this.chosen);
  }

  private clear(): void {
    this.chosen = [];
    for (const { entries } of this.groups) for (const { box } of entries) box.checked = false;
    this.countAll();
    this.onChange(this.chosen);
  }

  private countAll(): void {
    for (const { count, entries } of this.groups) {
      const chosen = entries.filter(({ box }) => box.checked).length;
      count.textContent = chosen === 0 ? "" : String(chosen);
    }
  }

  // Every word must occur, in the name or in what it means; while one searches all groups stand open.
  private filter(): void {
    const wanted = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let found = 0;
    for (const { root, entries } of this.groups) {
      let here = 0;
      for (const { channel, row } of entries) {
        const text = `${channel.name} ${words(channel.name)} ${channel.description}`.toLowerCase();
        row.hidden = !wanted.every((word) => text.includes(word));
        if (!row.hidden) here += 1;
      }
      root.hidden = here === 0;
      root.open = wanted.length > 0 && here > 0;
      found += here;
    }
    this.none.hidden = found > 0;
  }
}
