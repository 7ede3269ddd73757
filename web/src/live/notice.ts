// What must not be missed: a lost connection, the end of the car's run, a request refused.
import { element } from "../dom";
import { write } from "./gauge";

const toastTime = 6000; // [ms]

export class Notices {
  readonly root: HTMLElement;
  private readonly title = element("h2");
  private readonly text = element("p");
  private readonly box = element("div", { class: "notice", role: "alert", hidden: true }, this.title, this.text);
  private readonly toast = element("p", { class: "toast", role: "status", hidden: true });
  private timer: ReturnType<typeof setTimeout> | undefined;

  // below: what else stands in the middle of the picture
  constructor(below: HTMLElement) {
    this.root = element("div", { class: "notices" }, this.box, this.toast, below);
  }

  // Stays until it is shown anew; title "": none.
  show(title: string, text: string, dims: boolean): void {
    this.box.hidden = title === "";
    this.root.classList.toggle("dims", dims && title !== "");
    write(this.title, title);
    write(this.text, text);
  }

  // For a moment.
  say(message: string): void {
    write(this.toast, message);
    this.toast.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (this.toast.hidden = true), toastTime);
  }
}
