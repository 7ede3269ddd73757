// How a course went: shown as the car has passed its end, until it is back at its start.
import { element } from "../dom";
import { significant, unitSymbol } from "../report/numbers";
import { announce } from "../report/sharing";
import { createVerdictList, verdictSign, verdictWord } from "../report/verdicts";
import { figure } from "./gauge";
import type { CourseResult, ResultValue } from "../contract";
import "./result.css";

const outcome = ({ finished, passed }: CourseResult): string => {
  if (!finished) return "not finished";
  return passed === null ? "finished" : verdictWord(passed);
};

function rowOf({ name, unit, value, meaning }: ResultValue): HTMLElement {
  const number = value === null ? "–" : significant(value);
  const suffix = value === null || unit === "" || unit === "1" ? "" : ` ${unitSymbol(unit)}`;
  const head = element("th", { scope: "row" }, name, meaning === "" ? null : element("small", {}, meaning));
  return element("tr", {}, head, element("td", {}, number + suffix));
}

export class ResultCard {
  readonly root = element("section", { class: "panel result", "aria-labelledby": "result-title", hidden: true });
  private time = -Infinity; // of the picture [s]

  constructor(private readonly again: () => void) {}

  show(title: string, result: CourseResult): void {
    const { finished, passed, values, verdicts, time } = result;
    const good = finished && passed !== false;
    const headline = `${title}: ${outcome(result)}`;
    const took = `${figure(time, 2)} s`;
    const head = element("h2", { id: "result-title", class: good ? "passed" : "failed" }, verdictSign(good), headline);
    const table = element("table", {}, element("tbody", {}, ...values.map(rowOf)));
    const body = element(
      "div",
      { class: "body", tabindex: 0, role: "group", "aria-label": "Verdicts and values" },
      verdicts.length > 0 ? createVerdictList(verdicts) : null,
      values.length > 0 ? table : null,
    );
    this.root.replaceChildren(
      head,
      element("p", { class: "hint" }, `Time ${took}`),
      body,
      element(
        "p",
        { class: "row" },
        element("button", { type: "button", class: "primary", onclick: () => this.again() }, "Again"),
        element("button", { type: "button", onclick: () => this.hide() }, "Close"),
        element("span", { class: "hint" }, "Enter: again"),
      ),
    );
    this.root.hidden = false;
    const said = verdicts.map((one) => `${one.criterion}: ${verdictWord(one.passed)}`);
    announce([headline, took, ...said].join(". "));
  }

  hide(): void {
    this.root.hidden = true;
  }

  // Time that runs backward: somebody has put the car back to its start.
  follow(time: number): void {
    if (time < this.time) this.hide();
    this.time = time;
  }
}
