// One line about the program itself: does the physics keep real time, who listens, how long from a key to the picture.
import { element } from "../dom";
import { figure, readout } from "./gauge";
import type { Latency } from "./latency";
import type { Status } from "../contract";

export class MachineLine {
  readonly root: HTMLElement;
  private readonly items = {
    time: readout("time", "s"),
    step: readout("step", "ms"),
    period: readout("period", "ms"),
    compute: readout("compute", "µs"),
    worst: readout("worst overrun", "ms"),
    overruns: readout("overruns", ""),
    pages: readout("pages", ""),
    lost: readout("pictures lost", ""),
    latency: readout("input to picture", "ms"),
    recording: readout("recording", ""),
  };

  constructor() {
    const list = element("dl", {}, ...Object.values(this.items).map((item) => item.root));
    this.root = element("section", { class: "panel machine", "aria-label": "The program" }, list);
    this.items.latency.root.title = "median of the last 50 key strokes (least to most)";
    this.items.overruns.root.title = "steps that began more than one period late";
    this.items.lost.root.title = "frames that were not sent because this page was too slow";
    this.items.worst.root.title = "latest start of a step since the car was put on the road";
  }

  showStatus(status: Status): void {
    const items = this.items;
    items.time.show(figure(status.time, 1));
    items.step.show(figure(status.step_ms, 2));
    items.period.show(figure(status.period_ms, 3));
    items.compute.show(figure(status.compute_us, 0));
    items.worst.show(figure(status.worst_overrun_ms, 2));
    items.overruns.show(String(status.overruns));
    items.pages.show(String(status.pages));
    items.lost.show(String(status.lost_frames));
    items.lost.root.hidden = status.lost_frames === 0;
    const lost = status.lost_rows > 0 ? `, ${status.lost_rows} rows lost` : "";
    const recorded = `${status.recording}, ${figure(status.recorded_s, 1)} s${lost}`;
    items.recording.show(status.recording === "" ? "off" : recorded);
    items.recording.root.classList.toggle("on", status.recording !== "");
  }

  showLatency(latency: Latency): void {
    const summary = latency.summary();
    if (!summary) return;
    const { min, median, max } = summary;
    this.items.latency.show(`${figure(median, 0)} (${figure(min, 0)} to ${figure(max, 0)})`);
  }
}
