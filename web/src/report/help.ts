// "?" tells the keys. Whoever listens to keys describes them here.
import { element } from "../dom";
import "./help.css";

export interface Key {
  readonly keys: readonly string[]; // ["←", "→"]
  readonly does: string;
}
const sections = new Map<string, readonly Key[]>();

export const describeKeys = (section: string, keys: readonly Key[]): void => void sections.set(section, keys);

const rowOf = ({ keys, does }: Key): HTMLElement =>
  element("div", {}, element("dt", {}, ...keys.map((key) => element("kbd", {}, key))), element("dd", {}, does));

const sectionOf = ([name, keys]: readonly [string, readonly Key[]]): HTMLElement =>
  element("section", {}, element("h3", {}, name), element("dl", {}, ...keys.map(rowOf)));

let dialog: HTMLDialogElement | null = null;

export function showKeys(): void {
  if (dialog?.open) return dialog.close();
  dialog?.remove();
  dialog = element(
    "dialog",
    { class: "keys", "aria-label": "Keys", onclick: (event) => event.target === dialog && dialog?.close() },
    element(
      "div",
      { class: "sheet" },
      element(
        "header",
        {},
        element("h2", {}, "Keys"),
        element("button", { type: "button", onclick: () => dialog?.close() }, "Close"),
      ),
      ...[...sections].map(sectionOf),
    ),
  );
  document.body.append(dialog);
  dialog.showModal();
}

const typedInto = "input:not([type=radio], [type=checkbox], [type=range]), textarea, select";
const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement && target.closest(typedInto) !== null;

export function listenForHelp(): void {
  describeKeys("Page", [{ keys: ["?"], does: "show or hide these keys" }]);
  addEventListener("keydown", (event) => {
    if (event.key !== "?" || event.ctrlKey || event.metaKey || event.altKey || typing(event.target)) return;
    event.preventDefault();
    showKeys();
  });
}
