// Debian's Chromium without a screen; every page that is opened must not complain.
import { existsSync } from "node:fs";
import { chromium, type Browser, type BrowserContext, type Page } from "playwright-core";

const paths = [process.env["HAMILCAR_CHROMIUM"], "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const quiet = ["--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"];
const drawing = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];

export async function openBrowser(): Promise<Browser> {
  const executablePath = paths.find((path) => path !== undefined && existsSync(path));
  if (executablePath === undefined) throw new Error(`no Chromium at ${paths.join(", ")} (Debian: apt-get install chromium)`);
  return chromium.launch({ executablePath, args: ["--no-sandbox", ...quiet, ...drawing] });
}

// No test waits for the clock but to give up: an event that has not come by then will not come on any machine.
export const patience = 180_000; // [ms]

export interface WatchedPage {
  readonly page: Page;
  complaints(): readonly string[]; // errors and warnings of the page's own so far
}

// What Chromium says of drawing without a graphics card is no fault of the page.
const ofTheMachine = /GPU stall|swiftshader|software WebGL|GroupMarkerNotSet/i;

export async function openPage(context: BrowserContext | Browser, url: string): Promise<WatchedPage> {
  const page = await context.newPage();
  page.setDefaultTimeout(patience);
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    const bad = message.type() === "error" || message.type() === "warning";
    if (bad && !ofTheMachine.test(message.text())) complaints.push(message.text());
  });
  await page.goto(url);
  await page.waitForSelector("html[data-ready=true]", { state: "attached" });
  return { page, complaints: () => complaints };
}
