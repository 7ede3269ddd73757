// Buttons that stay pressed, one by one or one of several.
import { element } from "../dom";

export interface Toggle {
  readonly root: HTMLButtonElement;
  set(on: boolean): void;
}

export function toggle(label: string, pressed: boolean, change: (on: boolean) => void): Toggle {
  let on = pressed;
  const root = element("button", { type: "button", "aria-pressed": String(on), onclick: () => change(!on) }, label);
  return {
    root,
    set: (now) => {
      on = now;
      root.setAttribute("aria-pressed", String(on));
    },
  };
}

export interface Choices<T> {
  readonly root: HTMLElement;
  set(value: T): void;
}

export function choices<T>(
  label: string,
  options: readonly { readonly value: T; readonly label: string }[],
  choose: (value: T) => void,
): Choices<T> {
  const buttons = options.map((option) => toggle(option.label, false, () => choose(option.value)));
  const roots = buttons.map((button) => button.root);
  const root = element("div", { class: "choices", role: "group", "aria-label": label }, ...roots);
  return { root, set: (value) => buttons.forEach((button, i) => button.set(options[i]?.value === value)) };
}
