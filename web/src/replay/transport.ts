// The bar below the picture: run, step, scrub, speed.
import { element } from "../dom";
import { button, changeIcon, setPressed } from "./buttons";
import { speeds, type Player } from "./player";

const ticks = 10_000; // of the slider

const speedText = (speed: number): string => `${speed}×`;

export class Transport {
  readonly root: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly loop: HTMLButtonElement;
  private readonly reverse: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly speed: HTMLSelectElement;
  private readonly now = document.createTextNode("");

  constructor(private readonly player: Player) {
    const { start, end } = player;
    this.play = button("play", "Play", () => player.toggle());
    this.play.classList.add("replay-play");
    this.loop = button("loop", "Loop", () => player.toggleLoop());
    this.reverse = button("reverse", "Backward", () => player.toggleReverse());
    this.slider = element("input", {
      type: "range", class: "replay-slider", min: 0, max: ticks, step: 1, value: 0, "aria-label": "Time",
      oninput: () => player.seek(start + ((end - start) * this.slider.valueAsNumber) / ticks),
    });
    this.speed = element(
      "select", { "aria-label": "Speed", title: "Speed", onchange: () => player.setSpeed(Number(this.speed.value)) },
      ...speeds.map((speed) => element("option", { value: speed }, speedText(speed))),
    );
    this.root = element(
      "div", { class: "replay-transport", role: "group", "aria-label": "Player" },
      button("start", "To the start", () => player.seek(start)),
      button("back", "Step back", () => player.step(-1)),
      this.play,
      button("forward", "Step forward", () => player.step(1)),
      this.slider,
      element("output", { class: "replay-time" }, this.now, element("span", {}, ` / ${end.toFixed(3)} s`)),
      this.speed, this.reverse, this.loop,
    );
    this.showState();
    this.showTime();
  }

  showState(): void {
    const { playing, loop, reverse, speed } = this.player;
    changeIcon(this.play, playing ? "pause" : "play", playing ? "Pause" : "Play");
    setPressed(this.loop, loop);
    setPressed(this.reverse, reverse);
    this.speed.value = String(speed);
  }

  showTime(): void {
    const { time, start, end } = this.player;
    const share = end > start ? (time - start) / (end - start) : 0;
    this.slider.value = String(Math.round(ticks * share));
    this.slider.style.setProperty("--share", String(share));
    this.slider.setAttribute("aria-valuetext", `${time.toFixed(3)} s`);
    this.now.data = time.toFixed(3);
  }
}
