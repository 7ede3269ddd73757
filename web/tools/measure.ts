// How fast a page is: opening a long run, drawing it, and from a key to its picture in a drive.
// Drawing without a graphics card, as Chromium does on a server, is some fifty times slower than a laptop's own.
import { mkdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { openBrowser, openPage } from "../tests/browser";
import { hamilcar, repository, startDrive, temporaryFolder } from "../tests/program";

interface Hooks {
  seek(time: number): void;
  framesDrawn(): number;
  latencies(): number[];
}
declare const window: { hamilcar: Hooks };

const say = (what: string, figure: string): void => console.log(`${what.padEnd(58)} ${figure}`);
const sorted = (values: readonly number[]): number[] => [...values].sort((a, b) => a - b);
const median = (values: readonly number[]): number => sorted(values)[values.length >> 1] ?? NaN;

// 15 s at 1 ms: the usual channels and enough of the others to make sixty.
function longRun(folder: string): string {
  const channels = ["chassis.position.*", "chassis.velocity.*", "chassis.angle.*", "chassis.rate.*", "chassis.l*", "input.*"];
  for (const wheel of ["front_left", "front_right", "rear_left", "rear_right"])
    channels.push(`${wheel}.wheel.*`, `${wheel}.spring.*`, `${wheel}.damper.*`, `${wheel}.tire.longitudinal_force`, `${wheel}.tire.vertical_force`);
  mkdirSync(folder, { recursive: true });
  writeFileSync(
    join(folder, "long.toml"),
    `name = "long"\nvehicle = "${join(repository, "vehicles/bmw_323i.toml")}"\nduration_s = 15\n[initial]\nvelocity_m_per_s = 15\n` +
      `[inputs.steering_wheel]\ntime_s = [1, 2, 3, 4]\nangle_deg = [0, 30, -30, 0]\n[output]\ninterval_s = 0.001\nchannels = ${JSON.stringify(channels)}\n`,
  );
  hamilcar(folder, "run", "long.toml", "-o", "long");
  return join(folder, "long/report.html");
}

async function fps(page: Page, seconds: number): Promise<number> {
  const before = await page.evaluate(() => window.hamilcar.framesDrawn());
  await page.waitForTimeout(1000 * seconds);
  return ((await page.evaluate(() => window.hamilcar.framesDrawn())) - before) / seconds;
}

const folder = temporaryFolder();
const browser = await openBrowser();
try {
  const report = longRun(folder.path);
  const opened: number[] = [];
  for (let i = 0; i < 5; ++i) {
    const { page } = await openPage(browser, `file://${report}`);
    opened.push(await page.evaluate(() => performance.getEntriesByName("hamilcar-ready", "mark")[0]?.startTime ?? NaN));
    if (i === 4) {
      const channels = await page.evaluate(
        () => (JSON.parse(document.getElementById("hamilcar-document")?.textContent ?? "") as { runs: { channels: unknown[] }[] }).runs[0]?.channels.length,
      );
      say("page of 15 s at 1 ms", `${(statSync(report).size / 1e6).toFixed(1)} MB, ${channels} channels with motion`);
      await page.keyboard.press("Space");
      say("playing, 1280 by 720", `${(await fps(page, 4)).toFixed(1)} pictures a second`);
    }
    await page.close();
  }
  say("from opening to the first complete picture", `median ${median(opened).toFixed(0)} ms, worst ${Math.max(...opened).toFixed(0)} ms`);

  const drive = await startDrive(folder.path);
  for (const [width, height] of [[1280, 720], [320, 240]] as const) {
    const page = await (await browser.newContext({ viewport: { width, height } })).newPage();
    await page.goto(drive.url.href);
    await page.waitForSelector("html[data-ready=true]", { state: "attached", timeout: 60000 });
    for (let i = 0; i < 40; ++i) {
      await page.keyboard.down("ArrowLeft");
      await page.waitForTimeout(120);
      await page.keyboard.up("ArrowLeft");
      await page.waitForTimeout(120);
    }
    const found = await page.evaluate(() => window.hamilcar.latencies());
    const rate = await fps(page, 2);
    say(
      `input to picture, ${width} by ${height}, ${rate.toFixed(0)} pictures a second`,
      `median ${median(found).toFixed(1)} ms, least ${Math.min(...found).toFixed(1)}, most ${Math.max(...found).toFixed(1)} (${found.length})`,
    );
    await page.context().close();
  }
  await drive.stop();
  console.log(drive.said().trim().split("\n").slice(1).join("\n"));
} finally {
  await browser.close();
  folder.remove();
}
