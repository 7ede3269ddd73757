// What the charts of a page share: the place of the cursor along axes of one name, and the moment of printing.
import { inLight } from "../theme";

type Follower = (x: number | null) => void; // null: the cursor has left
const followers = new Map<string, Set<Follower>>();

// Returns how to tell the others.
export function shareCursor(axis: string, follow: Follower): Follower {
  const group = followers.get(axis) ?? new Set();
  followers.set(axis, group.add(follow));
  return (x) => group.forEach((other) => other !== follow && other(x));
}

export interface Printed {
  prepare(): void; // colors are those of paper
  restore(): void;
}
const printed = new Set<Printed>();
export const onPrint = (part: Printed): void => void printed.add(part);

addEventListener("beforeprint", () => inLight(() => printed.forEach((part) => part.prepare())));
addEventListener("afterprint", () => printed.forEach((part) => part.restore()));

// One voice for all charts.
let voice: HTMLElement | null = null;
export function announce(text: string): void {
  if (!voice) {
    voice = document.createElement("div");
    voice.className = "unseen";
    voice.setAttribute("aria-live", "polite");
    document.body.append(voice);
  }
  voice.textContent = text;
}
