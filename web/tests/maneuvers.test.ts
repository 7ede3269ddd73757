// Reports of maneuvers: what was passed stands there in words, paths and cones on a map that does not stretch them.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import type { Block, Verdict } from "../src/contract";
import { openBrowser, openPage } from "./browser";
import { temporaryFolder } from "./program";
import { Columns, shell, writeReport } from "./shell";

const folder = temporaryFolder();
let browser: Browser;
let page: string;

before(async () => {
  browser = await openBrowser();
  page = shell(folder.path);
});
after(async () => {
  await browser.close();
  folder.remove();
});

const range = (count: number): number[] => Array.from({ length: count }, (_, i) => i);
const lane = (x: number): number => 1.75 * (1 - Math.cos(Math.PI * Math.min(Math.max((x - 15) / 30, 0), 1)));

function blocks(columns: Columns, verdicts: readonly Verdict[]): Block[] {
  const curve = (label: string, x: readonly number[], y: readonly number[]) =>
    ({ label, x: columns.add(x), y: columns.add(y), points: false });
  const along = range(121);
  const gates = [0, 15, 45, 70, 95, 125];
  const axis = (label: string) => ({ label, logarithmic: false });
  return [
    { kind: "verdicts", list: verdicts },
    {
      kind: "chart", title: "Path", x: axis("x [m]"), y: axis("y [m]"), marks: [], equal_axes: true,
      curves: [curve("center of mass", along, along.map(lane)), curve("to follow", [0, 120], [0, 3.5])],
      cones: [{
        label: "cones", x: columns.add(gates.flatMap((x) => [x, x])),
        y: columns.add(gates.flatMap((x) => [lane(x) - 1.2, lane(x) + 1.2])),
      }],
      lines: [[0, -1.2, 15, -1.2], [0, 1.2, 15, 1.2]],
    },
    {
      kind: "chart", title: "Circle", x: axis("x [m]"), y: axis("y [m]"), marks: [], equal_axes: true,
      curves: [curve("", along.map((i) => 40 * Math.cos(i / 19)), along.map((i) => 40 * Math.sin(i / 19)))],
    },
    {
      kind: "chart", title: "Yaw rate", x: axis("time [s]"), y: axis("yaw rate [deg/s]"), marks: [],
      horizontal_marks: [{ y: 12, label: "35 % of the peak" }],
      curves: [curve("", along.map((i) => i / 20), along.map((i) => 8 * Math.sin(i / 20)))],
    },
  ];
}

function report(name: string, verdicts: readonly Verdict[]): string {
  const columns = new Columns();
  const document = { title: name, subtitle: "", generator: "test", blocks: blocks(columns, verdicts), runs: [] };
  const path = join(folder.path, `${name}.html`);
  writeReport(path, page, document, columns);
  return `file://${path}`;
}

const good: Verdict = { criterion: "no cone is hit", passed: true, found: "0 cones" };
const bad: Verdict = { criterion: "speed at the exit at least 60 km/h", passed: false, found: "51.2 km/h" };

test("verdicts are words, the overall one first", async () => {
  const mixed = await openPage(browser, report("mixed", [good, bad]));
  const section = mixed.page.getByRole("region", { name: "Result" });
  const lines = (await section.innerText()).split("\n").map((line) => line.trim()).filter((line) => line !== "");
  assert.match(lines[0] ?? "", /^Not passed: 1 of 2 criteria/);
  const items = await section.getByRole("listitem").allInnerTexts();
  assert.match(items[0] ?? "", /^\s*passed\s+no cone is hit: 0 cones/);
  assert.match(items[1] ?? "", /^\s*not passed\s+speed at the exit at least 60 km\/h: 51.2 km\/h/);
  const all = await openPage(browser, report("all", [good, good]));
  assert.match(await all.page.getByRole("region", { name: "Result" }).innerText(), /^\s*Passed: all 2 criteria met/);
  assert.ok((await all.page.pdf({ format: "A4" })).length > 20000);
  assert.deepEqual([...mixed.complaints(), ...all.complaints()], []);
});

// What a map says that it shows, over the pixels it shows it on.
async function scales(shown: Page, title: string): Promise<readonly [number, number]> {
  const chart = shown.locator("figure", { hasText: title }).locator("[role=img]");
  const label = ((await chart.getAttribute("aria-label")) ?? "").replaceAll("−", "-");
  const [x0, x1, y0, y1] = (/x from (\S+) m to (\S+) m, y from (\S+) m to (\S+) m/.exec(label) ?? []).slice(1).map(Number);
  const box = await chart.locator(".u-over").boundingBox();
  assert.ok(x0 !== undefined && x1 !== undefined && y0 !== undefined && y1 !== undefined && box, label);
  return [(x1 - x0) / box.width, (y1 - y0) / box.height];
}

// Every chart has the size that its place has.
const fitted = (shown: Page) =>
  shown.waitForFunction(() =>
    [...document.querySelectorAll<HTMLElement>(".drawing")].every(
      (place) => Math.abs(Number(place.dataset["fitted"]) - place.getBoundingClientRect().width) <= 1,
    ),
  );

test("a map has one scale, in every window and after zooming", async () => {
  const { page: shown, complaints } = await openPage(browser, report("map", [good]));
  const same = async (title: string): Promise<void> => {
    const [x, y] = await scales(shown, title);
    assert.ok(Math.abs(x / y - 1) < 0.03, `${title}: ${x} and ${y} m a pixel`);
  };
  for (const width of [1500, 900, 420]) {
    await shown.setViewportSize({ width, height: 800 });
    await fitted(shown);
    for (const title of ["Path", "Circle"]) await same(title);
  }
  await shown.setViewportSize({ width: 1200, height: 900 });
  await fitted(shown);
  const box = await shown.locator("figure", { hasText: "Circle" }).locator(".u-over").boundingBox();
  assert.ok(box);
  await shown.mouse.move(box.x + 0.5 * box.width, box.y + 0.2 * box.height);
  await shown.mouse.down();
  await shown.mouse.move(box.x + 0.6 * box.width, box.y + 0.7 * box.height, { steps: 4 });
  await shown.mouse.up();
  await shown.getByRole("button", { name: "Reset zoom" }).waitFor();
  await same("Circle");
  assert.deepEqual(complaints(), []);
});

test("cones and limits are told and read by keys", async () => {
  const { page: shown, complaints } = await openPage(browser, report("keys", [good]));
  const path = shown.getByRole("img", { name: /^Path/ });
  assert.match((await path.getAttribute("aria-label")) ?? "", /12 cones and 2 barriers/);
  const limited = shown.getByRole("img", { name: /^Yaw rate/ });
  assert.match((await limited.getAttribute("aria-label")) ?? "", /Limits: 35 % of the peak at 12\.0 deg\/s/);
  await path.focus();
  for (const key of ["End", "ArrowDown", "ArrowDown"]) await shown.keyboard.press(key);
  assert.match((await shown.locator("[aria-live=polite]").textContent()) ?? "", /^cones: \d/);
  assert.deepEqual(complaints(), []);
});
