// Lets a built page run the scripts and use the styles that stand in it, and no others: writes their hashes into its head.
// Usage: node tools/policy.mjs FILE
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const file = process.argv[2];
const page = readFileSync(file, "utf8");

// Documents and numbers, which have types of their own, are no scripts.
const inlined = (element) => [...page.matchAll(new RegExp(`<${element}(?![^>]*type="(?:application/json|text/plain)")[^>]*>([^]*?)</${element}>`, "g"))];
const hashes = (element) => inlined(element).map(([, text]) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`);
const policy = ["script", "style"].map((element) => `${element}-src ${hashes(element).join(" ")}`).join("; ");

const charset = '<meta charset="utf-8" />';
if (!page.includes(charset) || page.indexOf(charset) > page.indexOf("<script")) throw new Error(`${file}: no ${charset} before the scripts`);
writeFileSync(file, page.replace(charset, () => `${charset}\n    <meta http-equiv="Content-Security-Policy" content="${policy}" />`));
