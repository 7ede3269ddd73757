// Colors come from the style sheet, so that light, dark and print are chosen in one place (theme.css).

export type Theme = "" | "light" | "dark"; // "" follows the system

// Eight colors that color-blind people tell apart (Okabe and Ito 2008); theme.css gives each a light and a dark shade.
export const seriesCount = 8;

const root = document.documentElement;
const systemDark = matchMedia("(prefers-color-scheme: dark)");
const paper = matchMedia("print");
const shades = new Map<string, string>(); // plots ask sixty times a second
let chosen: Theme = remembered();

export function color(name: string): string {
  let shade = shades.get(name);
  if (shade === undefined) shades.set(name, (shade = getComputedStyle(root).getPropertyValue(`--${name}`).trim()));
  return shade;
}
export const seriesColor = (index: number): string => color(`series-${(index % seriesCount) + 1}`);

// Beside its color every curve has its own dashes: readable in gray.
const dashes: readonly (readonly number[])[] = [
  [],
  [8, 4],
  [2, 3],
  [10, 3, 2, 3],
  [14, 4],
  [5, 2],
  [1, 2],
  [12, 3, 2, 3, 2, 3],
];
// After each round of colors they move on by one: sixty-four curves differ in one or the other.
export const seriesDash = (index: number): readonly number[] =>
  dashes[(index + Math.floor(index / seriesCount)) % dashes.length] ?? [];

// Calls back whenever the colors change: the system's choice, the page's own switch, the start and end of printing.
// Returns how to stop that.
export function onThemeChange(listener: () => void): () => void {
  root.addEventListener("hamilcar-theme", listener);
  return () => root.removeEventListener("hamilcar-theme", listener);
}

function show(theme: "light" | "dark"): void {
  root.dataset["theme"] = theme;
  shades.clear();
}

function follow(): void {
  show(chosen || (systemDark.matches ? "dark" : "light"));
  root.dispatchEvent(new Event("hamilcar-theme"));
}

export const chosenTheme = (): Theme => chosen;

export function chooseTheme(theme: Theme): void {
  chosen = theme;
  try {
    localStorage.setItem("hamilcar-theme", theme);
  } catch {
    // A page from file:// may own no storage: then the choice holds as long as the page is open.
  }
  follow();
}

function remembered(): Theme {
  try {
    const theme = localStorage.getItem("hamilcar-theme");
    return theme === "light" || theme === "dark" ? theme : "";
  } catch {
    return "";
  }
}

// Draws for paper while the screen may be dark.
export function inLight(draw: () => void): void {
  const before = root.dataset["theme"];
  show("light");
  draw();
  show(before === "dark" ? "dark" : "light");
}

systemDark.addEventListener("change", follow);
paper.addEventListener("change", follow);
follow();
