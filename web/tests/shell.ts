// The page without its program: documents and servers of the test's own making around it.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page, WebSocketRoute } from "playwright-core";
import type { ColumnReference, PageDocument } from "../src/contract";
import { frameHeader, frameKind } from "../src/contract";
import type { CarMessage, ClientMessage, ServerMessage } from "../src/contract";
import { patience } from "./browser";
import { hamilcar, repository } from "./program";

// HAMILCAR_PAGE, as CMake knows it, or what stands in the program.
export function shell(folder: string): string {
  const built = process.env["HAMILCAR_PAGE"];
  if (built !== undefined) return readFileSync(built, "utf8");
  hamilcar(folder, "tire", join(repository, "vehicles/tires/pacejka_205_60_r15.tir"), "-o", "shell");
  const report = readFileSync(join(folder, "shell/tire.html"), "utf8");
  return ["document", "columns"].reduce((text, id) => filled(text, id, ""), report);
}

function filled(page: string, id: string, content: string): string {
  const start = page.indexOf(">", page.lastIndexOf(`<script id="hamilcar-${id}"`)) + 1;
  return page.slice(0, start) + content + page.slice(page.indexOf("</script>", start));
}

// The numbers of a document.
export class Columns {
  private readonly values: number[] = [];

  add(column: readonly number[]): ColumnReference {
    const offset = 8 * this.values.length;
    this.values.push(...column);
    return { type: "f64", offset, count: column.length };
  }

  get base64(): string {
    return Buffer.from(Float64Array.from(this.values).buffer).toString("base64");
  }
}

export function writeReport(path: string, page: string, document: PageDocument, columns: Columns): void {
  const text = JSON.stringify(document).replaceAll("<", "\\u003c");
  writeFileSync(path, filled(filled(page, "document", text), "columns", columns.base64));
}

// A server that does as the test says: it keeps what the page sends.
export class FakeServer {
  readonly url = "http://hamilcar.test/?token=0";
  readonly heard: ClientMessage[] = [];
  private listening: (() => void) | null = null; // to what is heard next
  private asked = 0; // messages that were looked at
  private socket: WebSocketRoute | null = null;

  constructor(private readonly greeting: readonly ServerMessage[]) {}

  async serve(page: Page, shell: string): Promise<void> {
    await page.route("http://hamilcar.test/**", (route) => route.fulfill({ contentType: "text/html", body: shell }));
    await page.routeWebSocket(/\/live/, (socket) => {
      this.socket = socket;
      socket.onMessage((text) => {
        this.heard.push(JSON.parse(String(text)) as ClientMessage);
        this.listening?.();
      });
      this.greeting.forEach((message) => this.say(message));
    });
  }

  // The next message that passes, none of those that were looked at before.
  hears(what: string, passes: (message: ClientMessage) => boolean): Promise<ClientMessage> {
    return new Promise((found, failed) => {
      const giveUp = setTimeout(() => failed(new Error(`the page has not sent ${what}`)), patience);
      this.listening = () => {
        while (this.asked < this.heard.length) {
          const message = this.heard[this.asked++];
          if (message === undefined || !passes(message)) continue;
          clearTimeout(giveUp);
          this.listening = null;
          return found(message);
        }
      };
      this.listening();
    });
  }

  say(message: ServerMessage): void {
    this.socket?.send(JSON.stringify(message));
  }

  show(car: CarMessage, time: number, values: Readonly<Record<string, number>>): void {
    const bytes = Buffer.alloc(frameHeader + 4 * car.channels.length);
    bytes.writeUInt32LE(frameKind, 0);
    bytes.writeUInt32LE(car.car, 4);
    bytes.writeDoubleLE(time, 8);
    car.channels.forEach(({ name }, i) => bytes.writeFloatLE(values[name] ?? 0, frameHeader + 4 * i));
    this.socket?.send(bytes);
  }
}
