// A steering wheel and two pedals on the glass, for phones.
import { drawing, element } from "../dom";
import { clamp } from "./held";
import type { Held } from "./held";

const fullTurn = 120; // of the drawn wheel, for full lock [deg]
const degree = 180 / Math.PI;

function wheelPicture(): SVGSVGElement {
  return drawing(
    "svg",
    { viewBox: "-50 -50 100 100", "aria-hidden": "true" },
    drawing("circle", { r: 44, class: "rim" }),
    drawing("path", { d: "M-42 0H42M0 0V42", class: "spoke" }),
    drawing("circle", { r: 9, class: "hub" }),
    drawing("path", { d: "M0 -48V-40", class: "top" }),
  );
}

export class TouchControls {
  readonly root: HTMLElement;
  private steer = 0;
  private throttle = 0;
  private brake = 0;

  private readonly shifter: HTMLElement;

  constructor(
    private readonly changed: (at: number, press: boolean) => void,
    shift: (by: 1 | -1) => void,
  ) {
    const button = (sign: string, label: string, by: 1 | -1): HTMLElement =>
      element("button", { type: "button", "aria-label": label, onclick: () => shift(by) }, sign);
    this.shifter = element(
      "div",
      { class: "shifter", role: "group", "aria-label": "Gears", hidden: true },
      button("+", "Gear up", 1),
      button("−", "Gear down", -1),
    );
    this.root = element(
      "div",
      { class: "touch" },
      this.wheel(),
      element(
        "div",
        { class: "pedals" },
        this.shifter,
        this.pedal("Brake", (value) => (this.brake = value)),
        this.pedal("Throttle", (value) => (this.throttle = value)),
      ),
    );
  }

  get held(): Held {
    return { steer: this.steer, throttle: this.throttle, brake: this.brake, clutch: 0 };
  }

  set shifts(on: boolean) {
    this.shifter.hidden = !on;
  }

  private wheel(): HTMLElement {
    const picture = wheelPicture();
    const label = "Steering wheel: turn it by touch";
    const wheel = element("div", { class: "touch-wheel", role: "img", "aria-label": label }, picture);
    const angleAt = (event: PointerEvent): number => {
      const box = wheel.getBoundingClientRect();
      return degree * Math.atan2(box.left + box.width / 2 - event.clientX, box.top + box.height / 2 - event.clientY);
    };
    let last = 0;
    const turnTo = (steer: number): void => {
      this.steer = steer;
      picture.style.transform = `rotate(${-fullTurn * steer}deg)`;
    };
    dragged(wheel, {
      start: (event) => (last = angleAt(event)),
      move: (event) => {
        const angle = angleAt(event);
        const turned = ((angle - last + 540) % 360) - 180;
        last = angle;
        turnTo(clamp(this.steer + turned / fullTurn, -1, 1));
      },
      end: () => turnTo(0),
      changed: this.changed,
    });
    return wheel;
  }

  private pedal(name: string, press: (value: number) => void): HTMLElement {
    const level = element("span", { class: "level" });
    const pedal = element(
      "div",
      { class: "pedal", role: "img", "aria-label": `${name}: the higher the touch, the more` },
      level,
      element("span", { class: "name" }, name),
    );
    const pressTo = (value: number): void => {
      press(value);
      level.style.transform = `scaleY(${value})`;
    };
    const follow = (event: PointerEvent): void => {
      const box = pedal.getBoundingClientRect();
      // The upper fifth is all of it: nobody aims for a line.
      pressTo(clamp((box.bottom - event.clientY) / (0.8 * box.height), 0, 1));
    };
    dragged(pedal, { start: follow, move: follow, end: () => pressTo(0), changed: this.changed });
    return pedal;
  }
}

interface Drag {
  start(event: PointerEvent): void;
  move(event: PointerEvent): void;
  end(): void;
  changed(at: number, press: boolean): void;
}

// Each element follows the finger that came to it first, wherever that goes.
function dragged(target: HTMLElement, drag: Drag): void {
  let finger: number | null = null;
  target.addEventListener("pointerdown", (event) => {
    if (finger !== null) return;
    finger = event.pointerId;
    target.setPointerCapture(finger);
    event.preventDefault();
    drag.start(event);
    drag.changed(event.timeStamp, true);
  });
  target.addEventListener("pointermove", (event) => {
    if (event.pointerId !== finger) return;
    drag.move(event);
    drag.changed(event.timeStamp, false);
  });
  const end = (event: PointerEvent): void => {
    if (event.pointerId !== finger) return;
    finger = null;
    drag.end();
    drag.changed(event.timeStamp, false);
  };
  target.addEventListener("pointerup", end);
  target.addEventListener("pointercancel", end);
  target.addEventListener("lostpointercapture", end);
}
