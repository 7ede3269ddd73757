// The head of a page: what it shows, what made it, and the choice of light and dark.
import type { PageDocument } from "../contract";
import { drawing, element } from "../dom";
import { chooseTheme, chosenTheme, type Theme } from "../theme";
import { showKeys } from "./help";
import "./header.css";

const rays = "M8 1v1.6M8 13.4V15M1 8h1.6M13.4 8H15M3 3l1.2 1.2M11.8 11.8L13 13M13 3l-1.2 1.2M4.2 11.8L3 13";
const sun = `M8 4.8a3.2 3.2 0 1 1 0 6.4a3.2 3.2 0 0 1 0-6.4${rays}`;
const moon = "M13.5 9.8A6 6 0 0 1 6.2 2.5a6 6 0 1 0 7.3 7.3";
const screen = "M2 3h12v8H2zM5.5 14h5M8 11v3";

const themes: readonly { readonly theme: Theme; readonly name: string; readonly icon: string }[] = [
  { theme: "", name: "As the system", icon: screen },
  { theme: "light", name: "Light", icon: sun },
  { theme: "dark", name: "Dark", icon: moon },
];

const iconOf = (path: string): SVGElement =>
  drawing("svg", { viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" }, drawing("path", { d: path }));

export function createThemeSwitch(): HTMLElement {
  const choices = themes.map(({ theme, name, icon }) =>
    element(
      "label",
      { title: name },
      element("input", {
        type: "radio",
        name: "theme",
        "aria-label": name,
        checked: chosenTheme() === theme,
        onchange: () => chooseTheme(theme),
      }),
      iconOf(icon),
    ),
  );
  return element("fieldset", { class: "themes" }, element("legend", { class: "unseen" }, "Colors"), ...choices);
}

export const createHelpButton = (): HTMLElement =>
  element("button", { type: "button", class: "help", "aria-label": "Keys", title: "Keys (?)", onclick: showKeys }, "?");

export const createHeader = ({ title, subtitle, generator }: PageDocument): HTMLElement =>
  element(
    "header",
    { class: "head" },
    element("div", { class: "names" }, element("h1", {}, title), subtitle === "" ? null : element("p", {}, subtitle)),
    element(
      "div",
      { class: "tools" },
      element("span", { class: "generator" }, generator),
      createThemeSwitch(),
      createHelpButton(),
    ),
  );
