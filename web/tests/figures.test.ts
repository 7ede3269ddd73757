// Numbers, units, legends and what fits on a page: as a person reads them.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import type { Axis, Block, Cell, ChannelRole, RecordedChannel, Run, Scene } from "../src/contract";
import { raisePowers, reading, tickTexts, withoutRoundOff } from "../src/report/numbers";
import { openBrowser, openPage } from "./browser";
import { temporaryFolder } from "./program";
import { Columns, shell, writeReport } from "./shell";

const folder = temporaryFolder();
let browser: Browser;
let html: string;

before(async () => {
  browser = await openBrowser();
  html = shell(folder.path);
});
after(async () => {
  await browser.close();
  folder.remove();
});

test("readings, ticks and units", () => {
  assert.equal(reading(-4.942e-17, 10), "0.0");
  assert.equal(reading(1.26, 10), "1.3");
  assert.equal(reading(3e-7, 1e-6), "3.000·10⁻⁷");
  assert.deepEqual(tickTexts([0.999998, 1, 1.000002], 2e-6), ["0.999998", "1.000000", "1.000002"]);
  assert.deepEqual(tickTexts([0, 1e-6], 1e-6), ["0", "10⁻⁶"]);
  assert.equal(raisePowers("(m/s^2)^2/Hz, kg m^3, 10^2, m^20"), "(m/s²)²/Hz, kg m³, 10^2, m^20");
  assert.equal(raisePowers("run^2.nc, v^2, N s^2/m^2"), "run^2.nc, v^2, N s²/m²");
});

async function show(name: string, columns: Columns, blocks: readonly Block[], runs: readonly Run[] = []): Promise<Page> {
  const path = join(folder.path, `${name}.html`);
  writeReport(path, html, { title: name, subtitle: "", generator: "test", blocks, runs }, columns);
  const { page, complaints } = await openPage(browser, `file://${path}`);
  assert.deepEqual(complaints(), []);
  return page;
}

const columnsOf = (...names: string[]) => names.map((name) => ({ name, unit: "" }));
const textsOf = (page: Page, selector: string): Promise<string[]> => page.locator(selector).allInnerTexts();

test("figures keep their digits beside others of another unit", async () => {
  const row = (name: string, value: Cell, unit: string): Cell[] => [name, value, unit];
  const values = [
    row("radius", 100.84509776762089, "m"), row("yaw rate ratio", 2.509822841459206, ""), row("lag", 0.07492608, "s"),
    row("cones", 0, ""), row("attempts", 6, ""), row("step", 0.001, "s"), row("lock", 0.18999999999999995, "s"),
    row("left", -2.1658e-7, "kJ"), row("seed", 123456, ""), row("speed", 80, "m/s^2"),
  ];
  const page = await show("figures", new Columns(), [
    { kind: "table", title: "Characteristic values", columns: columnsOf("", "value", "unit"), rows: values },
    {
      kind: "table", title: "Two cars", columns: columnsOf("", "unit", "a", "b"),
      rows: [["dive", "deg", 12.3456, 0.5], ["lock", "s", 0.25, null], ["heading", "deg", 1.2155567, 0.126418]],
    },
    { kind: "table", title: "Column", columns: columnsOf("axle", "load"), rows: [["front", 12.3456], ["rear", 1.25]] },
  ]);
  const table = (title: string): string => `.table[aria-label="${title}"] td.number`;
  const found = await textsOf(page, table("Characteristic values"));
  assert.deepEqual(found, ["100.8", "2.510", "0.07493", "0", "6", "0.001", "0.19", "−2.166·10⁻⁷", "123456", "80"]);
  assert.deepEqual(await textsOf(page, table("Two cars")), ["12.346", "0.500", "0.25", "–", "1.216", "0.126"]);
  assert.deepEqual(await textsOf(page, table("Column")), ["12.35", "1.25"]);
  assert.equal(await page.getByText("m/s²").count(), 1);
  await page.close();
});

test("what is nothing but round-off is zero, and what is small is not", async () => {
  assert.equal(withoutRoundOff(-4.9e-17, 3e-16), 0);
  assert.equal(withoutRoundOff(4.9e-9, 3e5), 0);
  assert.equal(withoutRoundOff(2e-12, 1), 2e-12);
  assert.equal(withoutRoundOff(2e-7, 3e-7), 2e-7);
  const columns = new Columns();
  const described = { unit: "m/s", description: "" };
  const channels: RecordedChannel[] = [
    { ...described, name: "time", column: columns.add([0, 1]) },
    {
      ...described, name: "ahead", column: columns.add([1e-15, 1e-15]),
      role: "longitudinal_velocity", of: "", display: { unit: "km/h", factor: 3.6 },
    },
  ];
  const page = await show("round", columns, [{ kind: "replay" }], [{ name: "still", file: "", scene: null, tiles: [], channels }]);
  assert.match((await textsOf(page, ".replay-readout"))[0] ?? "", /ahead\s*\[km\/h\]\s*0$/);
  await page.close();
});

test("a cell opens its file, whatever the file is called", async () => {
  const file = "point 1/a#b?/report.html";
  const rows: Cell[][] = [["1", { text: "passed", file }], ["2", "passed"]];
  const page = await show("files", new Columns(), [{ kind: "table", title: "Points", columns: columnsOf("", "turn"), rows }]);
  const link = page.getByRole("link", { name: "passed" });
  assert.equal(await link.count(), 1);
  assert.equal(await link.getAttribute("href"), "./point%201/a%23b%3F/report.html");
  await page.close();
});

test("a table scrolls only where it is long", async () => {
  const rows = (count: number): Cell[][] => Array.from({ length: count }, (_, i) => [`row ${i}`, i]);
  const table = (title: string, count: number): Block =>
    ({ kind: "table", title, columns: columnsOf("", "value"), rows: rows(count) });
  const page = await show("tables", new Columns(), [table("short", 36), table("long", 90)]);
  const cut = await page.$$eval(".table", (all) => all.map((one) => one.scrollHeight > one.clientHeight + 1));
  assert.deepEqual(cut, [false, true]);
  await page.close();
});

const axis = (label: string): Axis => ({ label, logarithmic: false });

test("many curves differ, names are words, a level line has an axis, and a map stands without curves", async () => {
  const columns = new Columns();
  const x = columns.add([0, 1, 2]);
  const curve = (label: string, y: number) => ({ label, x, y: columns.add([y, y, y * (1 + 1e-7)]), points: false });
  const labels = Array.from({ length: 20 }, (_, i) => (i === 0 ? "front_left" : `run ${i}`));
  const ground = { cones: [{ label: "cones", x, y: x }], lines: [[0, 0, 2, 2]] as const, equal_axes: true };
  const chart = { kind: "chart", x: axis("x [m]"), marks: [] } as const;
  const page = await show("curves", columns, [
    { ...chart, title: "Many", y: axis("y [m/s^2]"), curves: labels.map((label, i) => curve(label, i)) },
    { ...chart, title: "Level", y: axis("coherence [1]"), curves: [curve("", 0.999999)] },
    { ...chart, title: "Cones", y: axis("y [m]"), curves: [], ...ground },
  ]);
  const many = page.locator("figure", { hasText: "Many" });
  const looks = await many.locator(".legend line").evaluateAll((lines) =>
    lines.map((line) => `${line.getAttribute("stroke")} ${line.getAttribute("stroke-dasharray")}`),
  );
  assert.equal(new Set(looks).size, 20);
  assert.equal((await textsOf(page, ".legend .name"))[0], "front left");
  const said = async (title: string): Promise<string> =>
    (await page.locator("figure", { hasText: title }).locator("[role=img]").getAttribute("aria-label")) ?? "";
  assert.match(await said("Many"), /m\/s²/);
  assert.match(await said("Level"), /coherence from 0\.895 to 1\.100\./);
  assert.match(await said("Cones"), /3 cones and 1 barrier/);
  const cones = page.getByRole("img", { name: /^Cones/ });
  await cones.focus();
  await page.keyboard.press("ArrowRight");
  assert.match((await page.locator("[aria-live=polite]").textContent()) ?? "", /^cones: /);
  await page.close();
});

const scene: Scene = {
  vehicle: "a car", units: 1, frames: [{ name: "chassis", unit: 0 }], links: [], wheels: [], tires: [],
  bodies: [{ unit: 0, low: [-2, -0.8, 0.2], high: [2, 0.8, 1.4] }],
  road: { name: "level", grade: 0, bank: 0, friction: 1, uneven: false, patches: [], cones: [] },
};

test("a replay says what is below it, and on a narrow page shows names when asked", async () => {
  const columns = new Columns();
  const channel = (name: string, values: readonly number[], role?: ChannelRole, of = "") =>
    ({ name, unit: "m/s^2", description: "", ...(role ? { role, of } : {}), column: columns.add(values) });
  const pose = (["x", "y", "z", "qw", "qx", "qy", "qz"] as const).map((end) => `pose_${end}` as const);
  const shown = ["longitudinal_velocity", "lateral_acceleration", "yaw_rate"] as const;
  const runOf = (i: number): Run => ({
    name: `a run with a long name, number ${i}`, file: "", scene, tiles: [],
    channels: [
      channel("time", [0, 1, 2]),
      ...pose.map((role) => channel(`chassis.${role}`, role === "pose_qw" ? [1, 1, 1] : [0, 0, 0], role, "chassis")),
      ...shown.map((role) => channel(`chassis.${role}`, [-4.9e-17, 3, i], role)),
    ],
  });
  const page = await show("replay", columns, [{ kind: "replay" }], [0, 1, 2, 3, 4].map(runOf));
  await page.setViewportSize({ width: 1280, height: 620 });
  const side = page.locator(".replay-side");
  await page.waitForFunction(() => document.querySelector(".replay-side")?.classList.contains("more"));
  assert.match((await textsOf(page, ".time-plot .value"))[0] ?? "", /^0\.0+$/);
  await side.evaluate((panel) => panel.scrollTo(0, panel.scrollHeight));
  await page.waitForFunction(() => !document.querySelector(".replay-side")?.classList.contains("more"));

  const names = page.getByRole("list", { name: "Runs" });
  assert.ok(await names.isVisible());
  await page.setViewportSize({ width: 400, height: 800 });
  assert.equal(await names.isVisible(), false);
  await page.getByRole("button", { name: "5 runs" }).click();
  assert.ok(await names.isVisible());
  await page.close();
});
