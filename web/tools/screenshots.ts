// The pictures of README and docs, made anew from the program as it is.
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { openBrowser } from "../tests/browser";
import { hamilcar, repository, startDrive, temporaryFolder } from "../tests/program";

interface Hooks {
  seek(time: number): void;
  speed(): number;
  row(name: string): number;
}
declare const window: { hamilcar: Hooks };

const folder = temporaryFolder();
const pictures = join(repository, "docs/pictures");

async function open(browser: Browser, url: string, colorScheme: "light" | "dark", height = 800): Promise<Page> {
  const page = await (await browser.newContext({ viewport: { width: 1280, height }, colorScheme })).newPage();
  await page.goto(url);
  await page.waitForSelector("html[data-ready=true]", { state: "attached", timeout: 60000 });
  return page;
}

async function keep(page: Page, name: string): Promise<void> {
  await page.waitForTimeout(1500);
  await page.screenshot({ path: join(pictures, name) });
  await page.context().close();
  console.log(join("docs/pictures", name));
}

// Stops the page's drawing but for a last picture, which has all of its pixels however slow the machine is.
async function still(page: Page): Promise<void> {
  await page.evaluate(() => {
    const draw = globalThis.requestAnimationFrame.bind(globalThis);
    let last: FrameRequestCallback = () => undefined;
    globalThis.requestAnimationFrame = (next) => ((last = next), 0);
    setTimeout(() => {
      draw(last);
    }, 900);
  });
}

const file = (path: string): string => `file://${join(folder.path, path)}`;

const browser = await openBrowser();
try {
  hamilcar(folder.path, "run", join(repository, "scenarios/slalom.toml"), "-o", "slalom");
  const replay = await open(browser, file("slalom/report.html"), "light");
  await replay.evaluate(() => window.hamilcar.seek(5.4));
  await replay.keyboard.press("2");
  for (let i = 0; i < 3; ++i) await replay.keyboard.press("]");
  await keep(replay, "replay.png");

  const wheel = await open(browser, file("slalom/report.html"), "dark");
  await wheel.evaluate(() => window.hamilcar.seek(5.4));
  for (const key of ["b", "5"]) await wheel.keyboard.press(key);
  await keep(wheel, "suspension.png");

  hamilcar(folder.path, "kinematics", join(repository, "vehicles/formula.toml"), "-o", "formula");
  await keep(await open(browser, file("formula/kinematics.html"), "light", 900), "kinematics.png");

  hamilcar(folder.path, "paper", "-o", "paper");
  const paper = await open(browser, file("paper/paper.html"), "light", 620);
  await paper.getByText("Fig. 11", { exact: false }).first().scrollIntoViewIfNeeded();
  await paper.evaluate(() => document.querySelector("figure")?.scrollIntoView());
  await keep(paper, "paper.png");

  const drive = await startDrive(folder.path, "--road", join(repository, "scenarios/slalom.toml"));
  const page = await open(browser, drive.url.href, "light");
  await page.keyboard.down("ArrowUp");
  await page.waitForFunction(() => window.hamilcar.speed() > 10, undefined, { timeout: 60000 });
  await page.keyboard.down("ArrowLeft");
  await page.waitForFunction(() => window.hamilcar.row("chassis.angle.yaw") > 2, undefined, { timeout: 60000 });
  await still(page);
  await keep(page, "drive.png");
  await drive.stop();
} finally {
  await browser.close();
  folder.remove();
}
