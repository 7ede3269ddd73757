// Drives for a long time with two clients and looks whether the period holds and the memory stays.
// Usage: npm run soak [-- MINUTES]     10 if nothing is said
import { readFileSync } from "node:fs";
import { join } from "node:path";
import WebSocket from "ws";
import type { ServerMessage, Status } from "../src/contract";
import { repository, startDrive, temporaryFolder, visit } from "../tests/program";

const minutes = Number(process.argv[2] ?? 10);
const folder = temporaryFolder();
const drive = await startDrive(folder.path, join(repository, "vehicles/bmw_323i.toml"), "--road", join(repository, "scenarios/proving_ground.toml"));
const { link, cookie } = await visit(drive.url);

class Client {
  frames = 0;
  bytes = 0;
  status: Status | null = null;
  private readonly socket: WebSocket;
  private sequence = 0;

  constructor() {
    this.socket = new WebSocket(link, { origin: `http://${drive.url.host}`, headers: { Cookie: cookie } });
    this.socket.on("message", (data: Buffer, binary: boolean) => {
      this.bytes += data.length;
      if (binary) this.frames += data.readUInt32LE(0) === 1 ? 1 : 0;
      else this.hear(JSON.parse(data.toString()) as ServerMessage);
    });
  }
  private hear(message: ServerMessage): void {
    if (message.type === "status") this.status = message;
    if (message.type === "refusal") console.log(`refused: ${message.message}`);
  }
  send(message: object): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
  // Round and round, now and then back to the start.
  hold(seconds: number): void {
    if (Math.floor(seconds) % 40 === 39 && Math.floor(10 * seconds) % 10 === 0) this.send({ type: "reset" });
    const steer = Math.sin(0.7 * seconds);
    const throttle = Math.sin(0.31 * seconds) > -0.3 ? 0.6 : 0;
    const brake = throttle > 0 ? 0 : 0.4;
    this.send({ type: "input", sequence: ++this.sequence, device: "axes", steer: 0.3 * steer, throttle, brake, reverse: false });
  }
  close(): void {
    this.socket.close();
  }
}

const residentMB = (): number =>
  Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${drive.process.pid}/status`, "utf8"))?.[1]) / 1024;

const driver = new Client();
const watcher = new Client();
const began = Date.now();
const seconds = (): number => (Date.now() - began) / 1000;
const hands = setInterval(() => driver.hold(seconds()), 20);
const memory: number[] = [];

await new Promise<void>((done) => {
  const look = setInterval(() => {
    const { status } = driver;
    memory.push(residentMB());
    if (status !== null)
      console.log(
        `${seconds().toFixed(0).padStart(4)} s  simulated ${status.time.toFixed(1)} s, period ${status.period_ms.toFixed(4)} ms, ` +
          `step ${status.compute_us.toFixed(1)} us, overruns ${status.overruns} of ${status.steps}, worst ${status.worst_overrun_ms.toFixed(2)} ms, ` +
          `memory ${memory.at(-1)?.toFixed(1)} MB, frames ${driver.frames} and ${watcher.frames}${status.ended === "" ? "" : `, ended: ${status.ended}`}`,
      );
    if (seconds() < 60 * minutes) return;
    clearInterval(look);
    done();
  }, Math.min(30000, 6000 * minutes));
});
clearInterval(hands);
const { status } = driver;
driver.close();
watcher.close();
const code = await drive.stop();
console.log(drive.said().trim());
folder.remove();
const settled = memory.slice(Math.floor(memory.length / 3));
const growth = (settled.at(-1) ?? NaN) - (settled[0] ?? NaN);
console.log(`memory after the first third: ${settled[0]?.toFixed(1)} MB, at the end ${settled.at(-1)?.toFixed(1)} MB (${growth.toFixed(1)} MB more)`);
const held = status !== null && Math.abs(status.period_ms - status.step_ms) < 0.01 * status.step_ms;
const kept = growth < 2;
if (!held) console.log("the period was not held");
if (!kept) console.log("memory grows");
process.exit(held && kept && code === 0 ? 0 : 1);
