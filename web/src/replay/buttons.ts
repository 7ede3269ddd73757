// Buttons of the player: with a picture or with words, pressed or not.
import { drawing, element } from "../dom";

const icons = {
  play: "M4 2.5v11l9-5.5z",
  pause: "M4 2.5h3v11H4zM9 2.5h3v11H9z",
  back: "M10.5 3v10L4.5 8zM3 3h1.5v10H3z",
  forward: "M5.5 3v10l6-5zM11.5 3H13v10h-1.5z",
  start: "M13 3v10L7.5 8zM8 3v10L2.5 8zM2 3h1v10H2z",
  reverse: "M8.5 4v3H13v2H8.5v3L3 8z",
  loop: "M3 8V5.5h7v-2L13.2 6.3 10 9V7H4.5v1zM13 8v2.5H6v2L2.8 9.7 6 7v2h5.5V8z",
} as const;
export type Icon = keyof typeof icons;

const iconOf = (icon: Icon): SVGSVGElement =>
  drawing(
    "svg", { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" }, drawing("path", { d: icons[icon] }),
  );

export function button(content: Icon | { readonly text: string }, label: string, press: () => void): HTMLButtonElement {
  const inside = typeof content === "string" ? iconOf(content) : content.text;
  const name = { "aria-label": label, title: label };
  return element("button", { type: "button", class: "replay-button", ...name, onclick: press }, inside);
}

export function changeIcon(target: HTMLButtonElement, icon: Icon, label: string): void {
  target.querySelector("path")?.setAttribute("d", icons[icon]);
  target.setAttribute("aria-label", label);
  target.title = label;
}

export function setPressed(target: HTMLButtonElement, on: boolean): void {
  target.setAttribute("aria-pressed", String(on));
}
