// Writes src/contract.ts from schemas/page.schema.json, which the program's side is held against as well.
// Usage: node tools/contract.mjs [--check]      --check: fails where the file is not what would be written
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const web = join(dirname(fileURLToPath(import.meta.url)), "..");
const definitions = JSON.parse(readFileSync(join(web, "../schemas/page.schema.json"), "utf8")).$defs;
const target = join(web, "src/contract.ts");

const typeName = (name) => name.replace(/(^|_)([a-z0-9])/g, (_all, _before, letter) => letter.toUpperCase());
const constantName = (name) => name.replace(/_([a-z])/g, (_all, letter) => letter.toUpperCase());
const basic = { string: "string", number: "number", integer: "number", boolean: "boolean", null: "null" };

function typeOf(schema) {
  if (schema.$ref) return typeName(schema.$ref.split("/").at(-1));
  if (schema.oneOf) return schema.oneOf.map(typeOf).join(" | ");
  if ("const" in schema) return JSON.stringify(schema.const);
  if (schema.enum) return schema.enum.map((value) => JSON.stringify(value)).join(" | ");
  if (schema.type === "array") {
    const item = typeOf(schema.items);
    const tuple = schema.maxItems !== undefined && schema.minItems === schema.maxItems;
    if (tuple) return `readonly [${Array(schema.maxItems).fill(item).join(", ")}]`;
    return /[ |]/.test(item) ? `readonly (${item})[]` : `readonly ${item}[]`;
  }
  const types = [schema.type].flat().map((type) => basic[type]);
  if (types.includes(undefined)) throw new Error(`the generator knows no ${JSON.stringify(schema)}`);
  return types.join(" | ");
}

// Lines of a comment at most 110 wide.
function comment(text, indent) {
  const lines = [""];
  for (const word of (text ?? "").split(" ")) {
    if (lines.at(-1).length + word.length > 110) lines.push("");
    lines[lines.length - 1] += (lines.at(-1) === "" ? "" : " ") + word;
  }
  return text ? lines.map((line) => `${indent}// ${line}\n`).join("") : "";
}

function alias(name, schema) {
  const type = typeOf(schema);
  const line = `export type ${typeName(name)} = ${type};\n`;
  return line.length <= 120 ? line : `export type ${typeName(name)} =\n  | ${type.replaceAll(" | ", "\n  | ")};\n`;
}

function declaration([name, schema]) {
  const head = comment(schema.description, "");
  if (schema.type !== "object") return head + alias(name, schema);
  const member = ([key, of]) => {
    const optional = schema.required.includes(key) ? "" : "?";
    return `${comment(of.description, "  ")}  readonly ${key}${optional}: ${typeOf(of)};\n`;
  };
  return `${head}export interface ${typeName(name)} {\n${Object.entries(schema.properties).map(member).join("")}}\n`;
}

const { constants, ...types } = definitions;
const constant = ([name, schema]) =>
  `${comment(schema.description, "")}export const ${constantName(name)} = ${schema.const};\n`;
const text = [
  "// Made by tools/contract.mjs from schemas/page.schema.json: change that and run `npm run contract`.\n",
  ...Object.entries(constants.properties).map(constant),
  ...Object.entries(types).map(declaration),
].join("\n");

if (!process.argv.includes("--check")) writeFileSync(target, text);
else if (readFileSync(target, "utf8") !== text) {
  console.error("web/src/contract.ts is not what schemas/page.schema.json says: run `npm run contract` in web/");
  process.exit(1);
}
