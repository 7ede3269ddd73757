// A page of a run: opened from the disk, without any server, it shows the numbers of the result file.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser } from "playwright-core";
import { openBrowser, openPage } from "./browser";
import { hamilcar, repository, temporaryFolder } from "./program";

interface Hooks {
  time(): number;
  seek(time: number): void;
  playing(): boolean;
  framesDrawn(): number;
}
declare const window: { hamilcar: Hooks };

const folder = temporaryFolder();
let browser: Browser;

before(async () => {
  hamilcar(folder.path, "run", join(repository, "scenarios/step_steer.toml"), "-o", "step");
  hamilcar(folder.path, "run", join(repository, "scenarios/rough_road.toml"), "-o", "rough");
  browser = await openBrowser();
});
after(async () => {
  await browser.close();
  folder.remove();
});

const address = (path: string): string => `file://${join(folder.path, path)}`;

// The value of a channel at a time between two rows of the table that the run wrote beside the page's own source.
function fromTable(path: string, channel: string, time: number): number {
  const [head, ...rows] = readFileSync(join(folder.path, path), "utf8").trim().split("\n");
  const column = (head ?? "").split(",").findIndex((name) => name.startsWith(`${channel} [`));
  assert.ok(column > 0, channel);
  const numbers = rows.map((row) => row.split(",").map(Number));
  const next = numbers.findIndex((row) => (row[0] ?? 0) >= time);
  const [a, b] = [numbers[Math.max(next - 1, 0)] ?? [], numbers[next] ?? []];
  const share = b[0] === a[0] ? 0 : (time - (a[0] ?? 0)) / ((b[0] ?? 0) - (a[0] ?? 0));
  return (a[column] ?? 0) + share * ((b[column] ?? 0) - (a[column] ?? 0));
}

test("the report of a run shows its values at a time", async () => {
  const { page, complaints } = await openPage(browser, address("step/report.html"));
  for (const time of [0, 1.234, 3.3333, 6]) {
    await page.evaluate((at) => window.hamilcar.seek(at), time);
    assert.ok(Math.abs((await page.evaluate(() => window.hamilcar.time())) - time) < 1e-9);
    const cells = await page.$$eval("[data-channel][data-run='0']", (found) =>
      found.map((cell) => [cell.getAttribute("data-channel") ?? "", Number(cell.getAttribute("data-value"))] as const),
    );
    assert.ok(cells.length >= 3, "a few channels are shown from the start");
    for (const [channel, value] of cells) {
      const expected = fromTable("step/results.csv", channel, time);
      assert.ok(Math.abs(value - expected) <= 1e-9 * Math.max(1, Math.abs(expected)), `${channel} at ${time}: ${value}, ${expected}`);
    }
  }
  assert.deepEqual(complaints(), []);
});

test("where a controller has intervened its activity and the brakes' pressures are shown first", async () => {
  const stop = [
    'name = "stop"', `vehicle = "${join(repository, "vehicles/bmw_e90_330i.toml")}"`, "duration_s = 1.0",
    "[initial]", "velocity_m_per_s = 10.0", "[road]", "friction = 0.3",
    "[inputs.brake]", "time_s = [0.0, 0.1]", "command = [0.0, 1.0]",
  ];
  writeFileSync(join(folder.path, "stop.toml"), stop.join("\n"));
  hamilcar(folder.path, "run", "stop.toml", "-o", "stop");
  const shown = async (path: string): Promise<string[]> => {
    const { page, complaints } = await openPage(browser, address(path));
    const names = await page.$$eval("[data-channel]", (cells) => cells.map((cell) => cell.getAttribute("data-channel") ?? ""));
    await page.close();
    assert.deepEqual(complaints(), []);
    return names.filter((name) => /activity$|brake\.pressure$/.test(name));
  };
  const wheels = ["front_left", "front_right", "rear_left", "rear_right"];
  assert.deepEqual(await shown("stop/report.html"), ["abs.activity", ...wheels.map((wheel) => `${wheel}.brake.pressure`)]);
  assert.deepEqual(await shown("step/report.html"), []); // a car without controllers
});

test("a replay plays, stops at its end and goes by keys", async () => {
  const { page, complaints } = await openPage(browser, address("step/report.html"));
  await page.evaluate(() => window.hamilcar.seek(1));
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => window.hamilcar.playing()), true);
  await page.waitForFunction(() => window.hamilcar.time() > 1.3);
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => window.hamilcar.playing()), false);
  const stopped = await page.evaluate(() => window.hamilcar.time());
  await page.keyboard.press("ArrowRight");
  assert.ok((await page.evaluate(() => window.hamilcar.time())) > stopped);
  await page.keyboard.press("End");
  assert.ok(Math.abs((await page.evaluate(() => window.hamilcar.time())) - 6) < 1e-6);
  for (const camera of ["1", "2", "3", "4", "5"]) await page.keyboard.press(camera);
  assert.ok((await page.evaluate(() => window.hamilcar.framesDrawn())) > 0);
  assert.deepEqual(complaints(), []);
});

test("two runs stand beside each other", async () => {
  const said = hamilcar(folder.path, "view", "step/results.nc", "rough/results.nc", "-o", "both.html");
  assert.equal(said.trim(), "both.html");
  const { page, complaints } = await openPage(browser, address("both.html"));
  await page.evaluate(() => window.hamilcar.seek(2));
  for (const [run, table] of [["0", "step/results.csv"], ["1", "rough/results.csv"]] as const) {
    const cell = page.locator(`[data-channel='chassis.lateral_acceleration'][data-run='${run}']`).first();
    const expected = fromTable(table, "chassis.lateral_acceleration", 2);
    assert.ok(Math.abs(Number(await cell.getAttribute("data-value")) - expected) < 1e-9);
  }
  await page.keyboard.press("g");
  assert.match(await page.locator("table caption").allInnerTexts().then((texts) => texts.join()), /smallest and largest/i);
  assert.deepEqual(complaints(), []);
});
