// The wire to the program: typed messages, the newest frame, and a new connection after a loss.
import { frameKind, tileKind } from "../contract";
import type { ClientMessage, ServerMessage } from "../contract";

// refused: the program answers, but not to this page's cookie; it was started anew and has printed another address.
export type LinkState = "connecting" | "open" | "lost" | "refused";

export interface LinkListener {
  stateChanged(state: LinkState): void;
  received(message: ServerMessage): void;
  frameReceived(bytes: ArrayBuffer): void; // each of them, drawn or not
  tileReceived(bytes: ArrayBuffer): void;
}

const firstDelay = 250; // [ms]
const lastDelay = 2000;

export function liveAddress(page: Location): string {
  const address = new URL("live", page.href);
  address.protocol = page.protocol === "https:" ? "wss:" : "ws:";
  return address.href;
}

export class Link {
  state: LinkState = "connecting";
  private socket: WebSocket | null = null;
  private newest: ArrayBuffer | null = null;
  private delay = firstDelay;

  constructor(
    private readonly address: string,
    private readonly listener: LinkListener,
  ) {
    this.connect();
  }

  send(message: ClientMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  // The newest frame since the last call; those between were never looked at.
  takeFrame(): ArrayBuffer | null {
    const frame = this.newest;
    this.newest = null;
    return frame;
  }

  private connect(): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    let opened = false;
    socket.onopen = () => {
      opened = true;
      this.delay = firstDelay;
      this.enter("open");
    };
    socket.onmessage = ({ data }) => this.receive(data as string | ArrayBuffer);
    socket.onclose = () => {
      this.newest = null;
      if (opened) this.enter("lost");
      else void this.askWhy();
      setTimeout(() => this.connect(), this.delay);
      this.delay = Math.min(2 * this.delay, lastDelay);
    };
    this.socket = socket;
  }

  // A browser does not tell why a handshake failed; whether the page itself is still given out does. A program that was
  // started anew has its page elsewhere.
  private async askWhy(): Promise<void> {
    const stranger = await fetch(location.href, { cache: "no-store", method: "HEAD" }).then(
      ({ status }) => status === 403 || status === 404,
      () => false,
    );
    if (this.state !== "open") this.enter(stranger ? "refused" : "lost");
  }

  private enter(state: LinkState): void {
    if (state === this.state) return;
    this.state = state;
    this.listener.stateChanged(state);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data === "string") {
      // What was sent before a new car is of the old one.
      const message = JSON.parse(data) as ServerMessage;
      if (message.type === "car") this.newest = null;
      this.listener.received(message);
      return;
    }
    const kind = new DataView(data).getUint32(0, true);
    if (kind === frameKind) {
      this.newest = data;
      this.listener.frameReceived(data);
    } else if (kind === tileKind) {
      this.listener.tileReceived(data);
    }
  }
}
