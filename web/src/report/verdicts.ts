// What was to be passed and whether it was: in words first, with a sign beside them, and never by color alone.
import type { Verdict } from "../contract";
import { drawing, element } from "../dom";
import { raisePowers } from "./numbers";
import "./verdicts.css";

const check = "M3 8.5L6.5 12L13 4.5";
const cross = "M4 4L12 12M12 4L4 12";

const dash = "M4 8H12";

// Null: not judged.
type Judged = Omit<Verdict, "passed"> & { readonly passed: boolean | null };
type Passed = Judged["passed"];

const chosen = (passed: Passed, yes: string, no: string, open: string): string =>
  passed === null ? open : passed ? yes : no;

export const verdictWord = (passed: Passed): string => chosen(passed, "passed", "not passed", "not judged");

export const verdictSign = (passed: Passed): SVGElement =>
  drawing(
    "svg",
    { class: "sign", viewBox: "0 0 16 16", width: 16, height: 16, "aria-hidden": "true" },
    drawing("path", { d: chosen(passed, check, cross, dash) }),
  );

const classOf = (passed: Passed): string => chosen(passed, "passed", "failed", "open");

const itemOf = ({ criterion, passed, found }: Judged): HTMLElement =>
  element(
    "li",
    { class: classOf(passed) },
    verdictSign(passed),
    element("span", { class: "word" }, verdictWord(passed)),
    element(
      "span",
      { class: "criterion" },
      raisePowers(criterion),
      found === "" ? null : ": ",
      element("b", {}, raisePowers(found)),
    ),
  );

export const createVerdictList = (list: readonly Judged[]): HTMLElement =>
  element("ul", { class: "verdict-list" }, ...list.map(itemOf));

// "Not passed: 1 of 5 criteria not met".
function overallText(list: readonly Verdict[]): string {
  const missed = list.filter(({ passed }) => !passed).length;
  const criteria = list.length === 1 ? "1 criterion" : `${list.length} criteria`;
  if (missed > 0) return `Not passed: ${missed} of ${criteria} not met`;
  return `Passed: ${list.length === 1 ? criteria : `all ${criteria}`} met`;
}

export function createVerdicts(list: readonly Verdict[]): HTMLElement {
  if (list.length === 0) return element("p", {}, "There is nothing to pass.");
  const passed = list.every((one) => one.passed);
  return element(
    "section",
    { class: "verdicts", "aria-label": "Result" },
    element("p", { class: `overall ${classOf(passed)}` }, verdictSign(passed), overallText(list)),
    createVerdictList(list),
  );
}
