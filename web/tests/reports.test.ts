// The pages of the other commands: their charts and tables are there, by keyboard and on paper too.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser } from "playwright-core";
import { openBrowser, openPage } from "./browser";
import { hamilcar, repository, temporaryFolder } from "./program";

const folder = temporaryFolder();
let browser: Browser;
const vehicle = join(repository, "vehicles/formula.toml");

before(async () => {
  browser = await openBrowser();
});
after(async () => {
  await browser.close();
  folder.remove();
});

const pages: readonly (readonly [string, readonly string[], string, number])[] = [
  ["kinematics", ["kinematics", vehicle, "-o", "k"], "k/kinematics.html", 20],
  ["modes", ["modes", vehicle, "--speed", "25", "-o", "m"], "m/modes.html", 2],
  ["tire", ["tire", join(repository, "vehicles/tires/pacejka_205_60_r15.tir"), "-o", "t"], "t/tire.html", 6],
  ["paper", ["paper", "-o", "p"], "p/paper.html", 6],
];

for (const [name, words, path, charts] of pages) {
  test(`${name}: ${charts} charts or more, tables, no complaints`, async () => {
    hamilcar(folder.path, ...words);
    const { page, complaints } = await openPage(browser, `file://${join(folder.path, path)}`);
    assert.ok((await page.locator("figure canvas").count()) >= charts);
    assert.ok((await page.locator("table caption").count()) >= 1);
    const unnamed = await page.$$eval("figure [role=img]", (found) => found.filter((one) => !one.ariaLabel).length);
    assert.equal(unnamed, 0, "every chart says what it shows");
    for (const colorScheme of ["dark", "light"] as const) await page.emulateMedia({ colorScheme });
    assert.ok((await page.pdf({ format: "A4" })).length > 20000);
    assert.deepEqual(complaints(), []);
    await page.close();
  });
}

test("nothing is asked of any network", async () => {
  const context = await browser.newContext();
  const asked: string[] = [];
  context.on("request", (request) => asked.push(request.url()));
  await openPage(context as never, `file://${join(folder.path, "k/kinematics.html")}`);
  assert.deepEqual(asked.filter((url) => !/^(file|data|blob):/.test(url)), []);
  await context.close();
});
