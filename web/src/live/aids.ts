// The car's aids, such as its anti-lock system: a lamp for each, lit while it intervenes, that a press switches off and on.
import { element } from "../dom";
import type { Aid, CarMessage, Status } from "../contract";
import type { LiveFrame } from "./frame";
import { aidKeys } from "./keys";

// As drivers call them; any other goes by its keyword.
const labels: Readonly<Record<string, string>> = { abs: "ABS", esc: "ESC", traction_control: "TC" };

const afterglow = 0.1; // a shorter intervention than this could not be seen [s]

class Lamp {
  readonly root: HTMLButtonElement;
  on = true;
  private litAt = NaN; // when it was seen to intervene last [s]

  constructor(
    { keyword, meaning }: Aid,
    key: string | undefined,
    private readonly activity: () => number, // 0 to 1
    press: () => void,
  ) {
    const title = key === undefined ? meaning : `${meaning} (key ${key})`;
    const label = labels[keyword] ?? keyword.replaceAll("_", " ");
    this.root = element("button", { type: "button", role: "switch", title, onclick: press }, label);
    this.turn(true);
  }

  turn(on: boolean): void {
    this.on = on;
    this.root.ariaChecked = String(on);
  }

  show(time: number): void {
    if (this.activity() > 0) this.litAt = time;
    const since = time - this.litAt; // negative where the car is back at its start
    this.root.classList.toggle("lit", since >= 0 && since < afterglow);
  }
}

export class Aids {
  readonly root = element("div", { class: "aids", role: "group", "aria-label": "Aids", hidden: true });
  private lamps = new Map<string, Lamp>(); // by keyword, in the car's order

  constructor(private readonly change: (aid: string, on: boolean) => void) {}

  setCar({ aids }: CarMessage, frame: LiveFrame): void {
    const lampOf = (aid: Aid, i: number): Lamp =>
      new Lamp(aid, aidKeys[i], frame.reader("controller_activity", aid.keyword), () => this.press(aid.keyword));
    this.lamps = new Map(aids.map((aid, i) => [aid.keyword, lampOf(aid, i)]));
    this.root.replaceChildren(...[...this.lamps.values()].map((lamp) => lamp.root));
    this.root.hidden = aids.length === 0;
  }

  showStatus({ switched_off }: Status): void {
    for (const [keyword, lamp] of this.lamps) lamp.turn(!switched_off.includes(keyword));
  }

  show(time: number): void {
    for (const lamp of this.lamps.values()) lamp.show(time);
  }

  // The one of this number from the left, counted from 0.
  pressNumber(number: number): void {
    const keyword = [...this.lamps.keys()][number];
    if (keyword !== undefined) this.press(keyword);
  }

  private press(keyword: string): void {
    const lamp = this.lamps.get(keyword);
    if (lamp) this.change(keyword, !lamp.on);
  }
}
