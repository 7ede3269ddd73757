// The program under test: commands that end, and the server of `drive`, which is stopped.
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";

const program = resolve(process.env["HAMILCAR_PROGRAM"] ?? "../build/release/hamilcar");
export const repository = resolve(process.env["HAMILCAR_SOURCE"] ?? "..");

export function temporaryFolder(): { path: string; remove(): void } {
  const path = mkdtempSync(join(tmpdir(), "hamilcar-web-"));
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}

export function hamilcar(folder: string, ...words: string[]): string {
  return execFileSync(program, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
}

export interface Drive {
  readonly url: URL;
  readonly process: ChildProcess;
  said(): string; // on standard error so far
  stop(): Promise<number | null>;
}

export async function startDrive(folder: string, ...words: string[]): Promise<Drive> {
  const child = spawn(program, ["drive", "--no-browser", ...words], { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  child.stderr.on("data", (text: Buffer) => (said += text.toString()));
  const first = await new Promise<string>((found, failed) => {
    createInterface({ input: child.stdout }).once("line", found);
    child.once("exit", (code) => failed(new Error(`drive ended with ${code}: ${said}`)));
  });
  const ended = new Promise<number | null>((done) => child.once("exit", done));
  return {
    url: new URL(first),
    process: child,
    said: () => said,
    stop: () => {
      child.kill("SIGINT");
      return ended;
    },
  };
}

// What a browser knows after it has opened the printed address: where the page is, and the cookie that opens it.
export interface Visit {
  readonly page: URL;
  readonly link: URL;
  readonly cookie: string;
}

export async function visit(url: URL): Promise<Visit> {
  const [cookie = "", path = ""] = ((await fetch(url)).headers.get("set-cookie") ?? "").split(/; (?:Path=)?/);
  const page = new URL(path, url);
  const link = new URL("live", page);
  link.protocol = "ws:";
  return { page, link, cookie };
}
