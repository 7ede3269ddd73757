// Runs TypeScript in Node: bundles it into a folder that goes away.
// Usage: node tools/run.mjs test [NAME...]      tests/*.test.ts, or those that begin so, by Node's own test runner
//        node tools/run.mjs TOOL [WORD...]      tools/TOOL.ts
// HAMILCAR_PROGRAM names the program, ../build/release/hamilcar if it is not set.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const web = join(dirname(fileURLToPath(import.meta.url)), "..");
const [what = "test", ...words] = process.argv.slice(2);
const wanted = (name) => name.endsWith(".test.ts") && (words.length === 0 || words.some((word) => name.startsWith(word)));
const sources =
  what === "test"
    ? readdirSync(join(web, "tests")).filter(wanted).map((name) => join(web, "tests", name))
    : [join(web, "tools", `${what}.ts`)];

const out = mkdtempSync(join(tmpdir(), "hamilcar-web-"));
symlinkSync(join(web, "node_modules"), join(out, "node_modules"));
await build({
  entryPoints: sources,
  outdir: out,
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
  packages: "external",
  outExtension: { ".js": ".mjs" },
  sourcemap: "inline",
  logLevel: "warning",
});
const bundled = sources.map((source) => join(out, basename(source).replace(/\.ts$/, ".mjs")));
const how = what === "test" ? ["--test", "--test-reporter=spec", ...bundled] : [...bundled, ...words];
const result = spawnSync(process.execPath, ["--enable-source-maps", ...how], { stdio: "inherit", cwd: web });
rmSync(out, { recursive: true });
process.exit(result.status ?? 1);
