// What the page knows of the program: who drives, which car on which road, and its newest frame.
import type { RoadTile } from "../document";
import { LiveFrame, readTile } from "./frame";
import { Link } from "./link";
import type { LinkState } from "./link";
import type { CarMessage, ClientMessage, CourseResult, Hello, ServerMessage, Status } from "../contract";

export type Role = "driver" | "watcher" | "nobody"; // nobody: no page drives

export interface SessionListener {
  linkChanged(state: LinkState): void;
  greeted(hello: Hello): void;
  carChanged(car: CarMessage, frame: LiveFrame): void;
  frameArrived(bytes: ArrayBuffer): void; // each of them, drawn or not
  tileArrived(tile: RoadTile): void;
  courseEnded(car: CarMessage, result: CourseResult): void;
  statusChanged(status: Status): void;
  refused(message: string): void;
}

export class Session {
  hello: Hello | null = null;
  car: CarMessage | null = null;
  status: Status | null = null;
  frame: LiveFrame | null = null;
  statuses = 0; // received so far
  private readonly link: Link;

  constructor(
    address: string,
    private readonly listener: SessionListener,
  ) {
    this.link = new Link(address, {
      stateChanged: (state) => this.linkChanged(state),
      received: (message) => this.receive(message),
      frameReceived: (bytes) => this.listener.frameArrived(bytes),
      tileReceived: (bytes) => this.receiveTile(bytes),
    });
  }

  get linkState(): LinkState {
    return this.link.state;
  }

  get role(): Role {
    const driver = this.status?.driver ?? 0;
    if (driver === 0) return "nobody";
    return driver === this.hello?.page ? "driver" : "watcher";
  }

  get running(): boolean {
    return this.linkState === "open" && this.status?.paused === "";
  }

  send(message: ClientMessage): void {
    this.link.send(message);
  }

  // True if the frame changed since the last call.
  takeFrame(): boolean {
    const bytes = this.link.takeFrame();
    return bytes !== null && (this.frame?.read(bytes) ?? false);
  }

  private linkChanged(state: LinkState): void {
    if (state !== "open") this.status = null;
    this.listener.linkChanged(state);
  }

  private receive(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        this.hello = message;
        return this.listener.greeted(message);
      case "car":
        this.car = message;
        this.frame = new LiveFrame(message);
        return this.listener.carChanged(message, this.frame);
      case "result":
        if (this.car?.course?.id === message.course) this.listener.courseEnded(this.car, message);
        return;
      case "status":
        this.status = message;
        this.statuses += 1;
        return this.listener.statusChanged(message);
      case "refusal":
        return this.listener.refused(message.message);
    }
  }

  private receiveTile(bytes: ArrayBuffer): void {
    const tile = this.car && readTile(bytes, this.car.car);
    if (tile) this.listener.tileArrived(tile);
  }
}
