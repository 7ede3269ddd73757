// The driving simulator: the car goes where the keys say, in time; strangers stay outside; a lost link comes back.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import WebSocket from "ws";
import type { Status } from "../src/contract";
import { openBrowser, openPage, patience } from "./browser";
import { hamilcar, repository, startDrive, temporaryFolder, visit, type Drive, type Visit } from "./program";

interface Hooks {
  felt(): number;
  statuses(): number;
  status(): Status | null;
  speed(): number;
  time(): number;
  role(): string;
  state(): string;
  row(name: string): number;
  framesDrawn(): number;
}
declare const window: { hamilcar: Hooks };

const folder = temporaryFolder();
let browser: Browser;
let drive: Drive;

before(async () => {
  browser = await openBrowser();
  drive = await startDrive(folder.path, join(repository, "vehicles/bmw_323i.toml"));
});
after(async () => {
  await browser.close();
  await drive.stop();
  folder.remove();
});

const until = (page: Page, condition: () => boolean) => page.waitForFunction(condition);

// Waits for two statuses more: the second of them was made after this was called.
async function newStatus(page: Page): Promise<void> {
  const before = await page.evaluate(() => window.hamilcar.statuses());
  await page.waitForFunction((count) => window.hamilcar.statuses() > count + 1, before);
}

// How a WebSocket to a server ends: opened, or refused with an HTTP status.
function knock({ link, cookie }: Visit, origin: string, host?: string): Promise<number> {
  const headers = { Cookie: cookie, ...(host === undefined ? {} : { Host: host }) };
  const socket = new WebSocket(link, { origin, headers });
  return new Promise((done, failed) => {
    socket.once("open", () => (socket.close(), done(101)));
    socket.once("unexpected-response", (_, response) => (socket.terminate(), done(response.statusCode ?? 0)));
    socket.once("error", failed);
  });
}

test("a page drives, turns, stops and starts again; a second one watches", async () => {
  const { page, complaints } = await openPage(browser, drive.url.href);
  await until(page, () => window.hamilcar.role() === "driver");
  await page.keyboard.down("ArrowUp");
  await until(page, () => window.hamilcar.speed() > 5);
  await page.keyboard.down("ArrowLeft");
  await until(page, () => window.hamilcar.row("chassis.angle.yaw") > 10);
  await page.keyboard.up("ArrowLeft");
  await page.keyboard.up("ArrowUp");

  const second = await openPage(await browser.newContext(), drive.url.href);
  await until(second.page, () => window.hamilcar.role() === "watcher");
  await second.page.keyboard.down("ArrowUp"); // nobody hears a watcher
  await page.keyboard.down("ArrowDown");
  await until(page, () => Math.abs(window.hamilcar.speed()) < 0.05);
  await until(second.page, () => Math.abs(window.hamilcar.speed()) < 0.1);
  await page.keyboard.up("ArrowDown");
  await until(page, () => window.hamilcar.felt() > 0); // input to picture is measured
  await page.keyboard.press("Enter");
  await until(page, () => Math.abs(window.hamilcar.row("chassis.angle.yaw")) < 1);

  await page.close(); // the driver leaves, the car stands still until somebody takes the wheel
  await until(second.page, () => window.hamilcar.role() === "nobody");
  await newStatus(second.page); // the last one before may be older than the leaving
  const stood = await second.page.evaluate(() => window.hamilcar.status()?.time);
  await newStatus(second.page);
  assert.equal(await second.page.evaluate(() => window.hamilcar.status()?.time), stood);
  await second.page.getByRole("button", { name: /take the wheel/i }).click();
  await until(second.page, () => window.hamilcar.role() === "driver");
  await second.page.close();
  assert.deepEqual([...complaints(), ...second.complaints()], []);
});

test("a recording is a result that view opens", async () => {
  const { page, complaints } = await openPage(browser, drive.url.href);
  await until(page, () => window.hamilcar.role() === "driver");
  await page.getByRole("button", { name: /record/i }).click();
  await page.keyboard.down("ArrowUp");
  await until(page, () => window.hamilcar.speed() > 3);
  await page.keyboard.up("ArrowUp");
  const file = await page.waitForFunction(
    () => /[\w./-]+\.nc/.exec(document.body.innerText)?.[0] ?? false,
  );
  const path = String(await file.jsonValue());
  await page.getByRole("button", { name: /record/i }).click();
  await until(page, () => window.hamilcar.status()?.recording === ""); // closed
  await page.close();
  assert.ok(existsSync(join(folder.path, path)), path);
  hamilcar(folder.path, "view", path, "-o", "drive.html");
  const replay = await openPage(browser, `file://${join(folder.path, "drive.html")}`);
  assert.ok((await replay.page.locator("canvas").count()) > 0);
  assert.deepEqual([...complaints(), ...replay.complaints()], []);
});

test("strangers stay outside", async () => {
  const own = `http://${drive.url.host}`;
  const status = async (path: string, headers: Record<string, string> = {}) =>
    (await fetch(new URL(path, drive.url), { headers })).status;
  const client = await visit(drive.url);
  assert.equal(await status(drive.url.href), 200);
  assert.equal(await status(client.page.href, { Cookie: client.cookie }), 200);
  assert.equal(await status(client.page.href), 403);
  assert.equal(await status("/"), 403);
  assert.equal(await status("/?token=0123456789abcdef0123456789abcdef"), 403);
  assert.equal(await status(`/elsewhere${drive.url.search}`), 404);
  assert.equal(await knock(client, own), 101);
  assert.equal(await knock(client, "http://evil.example"), 403);
  assert.equal(await knock(client, `${own}.evil.example`), 403);
  assert.equal(await knock({ ...client, cookie: `hamilcar=${"0".repeat(32)}` }, own), 403);
  assert.equal(await knock(client, own, "evil.example"), 403);
});

test("the address that opens the page is not the page's own; reloading and further pages need it no more", async () => {
  const context = await browser.newContext();
  const { page, complaints } = await openPage(context, drive.url.href);
  const token = drive.url.searchParams.get("token") ?? "";
  assert.ok(token.length > 20 && !page.url().includes(token), page.url());
  assert.equal(await page.evaluate(() => document.cookie), ""); // no script reads it
  await page.reload();
  await until(page, () => window.hamilcar.state() === "open");
  const again = await openPage(context, page.url());
  await until(again.page, () => window.hamilcar.state() === "open");
  await page.goBack();
  assert.equal(page.url(), "about:blank"); // the entrance has been replaced
  await context.close();
  assert.deepEqual([...complaints(), ...again.complaints()], []);
});

test("the page obeys no script but its own", async () => {
  const { page, complaints } = await openPage(browser, drive.url.href);
  await page.evaluate(() => {
    const stranger = document.createElement("script");
    stranger.textContent = "document.title = 'obeyed'";
    document.body.append(stranger);
    document.body.setAttribute("style", "opacity: 0.5");
  });
  assert.notEqual(await page.title(), "obeyed");
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).opacity), "1");
  assert.equal(complaints().filter((complaint) => complaint.includes("Content Security Policy")).length, complaints().length);
  await page.close();
});

test("nonsense and too much of it disturb nobody", async () => {
  const { page, complaints } = await openPage(browser, drive.url.href);
  await until(page, () => window.hamilcar.role() === "driver");
  const { link, cookie } = await visit(drive.url);
  const rude = (messages: readonly (string | Buffer)[]) =>
    new Promise<number>((done) => {
      const socket = new WebSocket(link, { origin: `http://${drive.url.host}`, headers: { Cookie: cookie } });
      socket.on("error", () => undefined);
      socket.once("open", () => messages.forEach((message) => socket.send(message)));
      socket.once("close", done);
    });
  assert.equal(await rude(["x".repeat(100000)]), 1009);
  const nonsense = ["{", "[]", "null", '{"type":"input"}', '{"type":"pace","factor":1e9}', '{"type":"?"}', "\u0000"];
  assert.equal(await rude(Array.from({ length: 30 }, (_, i) => nonsense[i % nonsense.length] ?? "")), 1008);
  assert.ok([1003, 1007, 1008].includes(await rude(Array.from({ length: 30 }, () => Buffer.from([0, 255, 1])))));
  const before = await page.evaluate(() => window.hamilcar.time());
  await until(page, () => window.hamilcar.state() === "open");
  await page.waitForFunction((time) => window.hamilcar.time() > time, before);
  await page.close();
  assert.deepEqual(complaints(), []);
});

test("the driver switches an aid off, which stays off at the start; a watcher does not", async () => {
  const other = await startDrive(folder.path, join(repository, "vehicles/bmw_e90_330i.toml"));
  const { page, complaints } = await openPage(await browser.newContext(), other.url.href);
  await until(page, () => window.hamilcar.role() === "driver");
  await page.getByRole("switch", { name: "ESC" }).click();
  await until(page, () => window.hamilcar.status()?.switched_off.join() === "esc");
  await page.keyboard.press("Enter");
  await newStatus(page);
  const second = await openPage(await browser.newContext(), other.url.href);
  await until(second.page, () => window.hamilcar.role() === "watcher");
  await second.page.locator("[role=switch][aria-checked=false]").click(); // it is told as it is
  await second.page.getByText("Page 1 has control").waitFor();
  assert.deepEqual(await page.evaluate(() => window.hamilcar.status()?.switched_off), ["esc"]);
  await page.keyboard.press("8");
  await until(page, () => window.hamilcar.status()?.switched_off.length === 0);
  await Promise.all([page.close(), second.page.close()]);
  assert.equal(await other.stop(), 0);
  assert.deepEqual([...complaints(), ...second.complaints()], []);
});

test("a lost link is told and comes back", async () => {
  const other = await startDrive(folder.path, join(repository, "vehicles/formula.toml"));
  const page = await (await browser.newContext()).newPage();
  page.setDefaultTimeout(patience);
  await page.routeWebSocket(/live/, (route) => {
    const server = route.connectToServer();
    page.once("dialog", () => undefined);
    (globalThis as { cut?: () => void }).cut = () => (server.close(), route.close());
  });
  await page.goto(other.url.href);
  await page.waitForSelector("html[data-ready=true]", { state: "attached" });
  (globalThis as { cut?: () => void }).cut?.();
  await until(page, () => window.hamilcar.state() !== "open");
  await until(page, () => window.hamilcar.state() === "open" && window.hamilcar.role() === "driver");
  assert.equal(await other.stop(), 0);
  await page.getByText(/has ended|connection lost/i).first().waitFor();
});

test("what cannot be driven is told before a server is there", () => {
  assert.throws(
    () => hamilcar(folder.path, "drive", "--no-browser", "nowhere.toml"),
    (error: { status?: number; stderr?: string }) => error.status === 3 || error.status === 5,
  );
});
