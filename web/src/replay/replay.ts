// The player: runs of a document in motion, with their curves and numbers at the same time.
import { element } from "../dom";
import type { LoadedDocument } from "../document";
import { describeKeys } from "../report/help";
import { button, setPressed } from "./buttons";
import { Captions } from "./captions";
import { listenToKeys, replayKeys, type KeyActions } from "./keys";
import { Picker } from "./picker";
import { Player } from "./player";
import { Plots } from "./plots";
import { Readout } from "./readout";
import { firstChoice } from "./sheet";
import { Track } from "./track";
import { Transport } from "./transport";
import { ViewBar } from "./viewbar";
import { World } from "./world";
import "./replay.css";

export { replayKeys };

const longestFrame = 0.1; // a page that was away does not jump ahead [s]

function playerOf(tracks: readonly Track[]): Player {
  const start = Math.min(...tracks.map((track) => track.start));
  const end = Math.max(...tracks.map((track) => track.end));
  const spacings = tracks.map((track) => (track.end - track.start) / Math.max(track.time.length - 1, 1));
  return new Player(start, end, Math.min(...spacings.filter((spacing) => spacing > 0), 1));
}

class Replay {
  private readonly view = element("div", { class: "replay-view" });
  private readonly side = element("div", { class: "replay-side" });
  private readonly player: Player;
  private readonly world: World;
  private readonly transport: Transport;
  private readonly plots: Plots;
  private readonly readout: Readout;
  private readonly picker: Picker;
  private readonly viewBar: ViewBar | null;
  private readonly channels = button({ text: "Channels" }, "Choose channels", () => this.togglePicker());
  private framesDrawn = 0;
  private waiting = false; // for the next picture
  private stale = true; // the picture is of another time
  private drawnAt = 0; // [ms]

  constructor(private readonly host: HTMLElement, loaded: LoadedDocument, private readonly tracks: readonly Track[]) {
    this.player = playerOf(tracks);
    this.transport = new Transport(this.player);
    this.plots = new Plots(tracks);
    this.readout = new Readout(tracks);
    const names = firstChoice(tracks);
    this.picker = new Picker(tracks, names);
    this.assemble();
    this.world = new World(this.view, loaded, tracks);
    this.viewBar = this.dressView();
    this.connect();
    this.sample();
    this.choose(names);
    listenToKeys(host, this.keyActions());
    this.expose();
    this.ask();
  }

  private assemble(): void {
    this.picker.root.hidden = true;
    setPressed(this.channels, false);
    const { picker, plots, readout } = this;
    this.side.append(element("div", { class: "replay-sidebar" }, this.channels), picker.root, plots.root, readout.root);
    this.host.classList.add("replay-player");
    this.host.append(this.view, this.side, this.transport.root);
  }

  private dressView(): ViewBar | null {
    const { stage } = this.world;
    if (stage === null) return null;
    if (this.world.cars.length === 0) {
      this.host.classList.add("replay-still");
      return null;
    }
    const captions = new Captions(this.world);
    const bar = new ViewBar(this.world, stage);
    bar.onChange = () => {
      captions.show();
      this.ask();
    };
    this.view.append(bar.root, captions.root);
    stage.onChange = () => this.ask();
    return bar;
  }

  private connect(): void {
    this.player.onChange = () => {
      this.transport.showState();
      this.stale = true;
      this.ask();
    };
    this.plots.onSeek = (time) => this.player.seek(time);
    this.picker.onChange = (names) => this.choose(names);
    this.side.addEventListener("scroll", () => this.showRest(), { passive: true });
    const growing = new ResizeObserver(() => this.showRest());
    for (const part of [this.side, ...this.side.children]) growing.observe(part);
    for (const part of [this.view, this.transport.root]) {
      part.addEventListener("click", (event) => this.releaseFocus(event));
    }
  }

  // Whether there is more below the plots that are seen.
  private showRest(): void {
    const { scrollTop, scrollHeight, clientHeight } = this.side;
    this.side.classList.toggle("more", scrollHeight - scrollTop - clientHeight > 20);
  }

  // After a click with the mouse the space bar plays again; who came by the tab key stays.
  private releaseFocus({ target, detail }: MouseEvent): void {
    const pressed = target instanceof Element ? target.closest("button") : null;
    if (detail === 0 || pressed === null) return;
    pressed.blur();
    this.world.stage?.canvas.focus({ preventScroll: true });
  }

  private choose(names: readonly string[]): void {
    this.plots.choose(names);
    this.readout.choose(names);
  }

  private togglePicker(): void {
    this.picker.root.hidden = !this.picker.root.hidden;
    setPressed(this.channels, !this.picker.root.hidden);
    if (!this.picker.root.hidden) this.picker.focus();
  }

  // For one more picture; none is drawn unasked.
  private ask(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  private draw(now: number): void {
    this.waiting = false;
    const seconds = Math.max((now - this.drawnAt) / 1000, 0);
    this.drawnAt = now;
    if (this.player.advance(Math.min(seconds, longestFrame))) this.stale = true;
    if (this.stale) this.sample();
    this.world.stage?.render(seconds);
    this.framesDrawn += 1;
    if (this.player.playing || this.world.stage?.moving) this.ask();
  }

  private sample(): void {
    this.stale = false;
    const { time } = this.player;
    for (let i = 0; i < this.tracks.length; ++i) this.tracks[i]!.sample(time);
    this.world.update();
    this.transport.showTime();
    this.plots.showTime(time);
    this.readout.show();
  }

  private keyActions(): KeyActions {
    const { player } = this;
    const camera = this.world.stage?.camera;
    return {
      toggle: () => player.toggle(),
      step: (direction) => player.step(direction),
      skip: (seconds) => player.seek(player.time + seconds),
      toStart: () => player.seek(player.start),
      toEnd: () => player.seek(player.end),
      faster: (direction) => player.faster(direction),
      reverse: () => player.toggleReverse(),
      loop: () => player.toggleLoop(),
      camera: (mode) => this.viewBar?.choose(mode),
      zoom: (factor) => camera?.zoom(factor),
      turn: (angle) => camera?.turn(angle, 0),
      resetCamera: () => camera?.reset(),
      forces: () => this.viewBar?.toggle("forces"),
      body: () => this.viewBar?.toggle("body"),
      solid: () => this.viewBar?.toggle("solid"),
      arrange: () => this.viewBar?.arrange(),
      channels: () => this.togglePicker(),
    };
  }

  // What browser tests ask and tell the page.
  private expose(): void {
    const { player } = this;
    const hooks = {
      time: () => player.time,
      seek: (time: number) => {
        player.seek(time);
        this.sample();
      },
      playing: () => player.playing,
      framesDrawn: () => this.framesDrawn,
    };
    Object.assign(window, { hamilcar: hooks });
  }
}

export function mountReplay(host: HTMLElement, loaded: LoadedDocument): void {
  const all = loaded.document.runs.map((run, index) => new Track(run, index, loaded));
  const tracks = all.filter((track) => track.time.length > 0);
  if (tracks.length === 0) {
    host.append(element("p", { class: "replay-empty" }, "This document holds no runs."));
    return;
  }
  describeKeys("Replay", replayKeys);
  new Replay(host, loaded, tracks);
}
