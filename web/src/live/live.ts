// The simulator's page: the car in the whole window, instruments over it, the driver's hands on the wire.
import { element } from "../dom";
import { describeKeys } from "../report/help";
import { openStage } from "../scene/stage";
import { App } from "./app";
import { liveKeys } from "./keys";
import "./live.css";

export function startLive(host: HTMLElement): void {
  const label = "The car on its road";
  const view = element("div", { class: "live-view", tabindex: -1, role: "application", "aria-label": label });
  host.classList.add("live");
  host.append(view);
  describeKeys("Driving", liveKeys.map(({ keys, meaning }) => ({ keys: keys.split(" "), does: meaning })));
  new App(host, view, openStage(view)).run();
}
