// One step in words: the truth, everyone's answer, what the chosen contestant looked at, and how to ask again.
import { Mesh, Series, Trace } from "./data";
import { colorsOf } from "./outlines";
import { download, testOf } from "./savetest";
import { Visits, wordsOf } from "./visits";
import { command, digits, duration, isDark, kinds, make } from "./words";

/** What is told about: a step, the chosen contestant, and what is called where another is chosen. */
export interface Asked {
  trace: Trace; step: number; series: Series | undefined; mesh: Mesh | null; visits: Visits | null; charges: string[];
  pick: (name: string) => void;
}

export function describe(asked: Asked): Node[] {
  const { trace, step, series, mesh, visits } = asked;
  const noted = trace.notedAt.get(step), unit = (value: number) => noted === undefined ? digits(value) : String(value);
  const truth = !trace.known(step) ? "No contestant was asked here."
    : trace.about.query === "sweep" ? `The truth: ${trace.found(step) ? "a hit on the way" : "no hit"}.`
    : `The truth: ${trace.found(step) ? "contact" : trace.about.query === "touches" ? "no contact" : "nothing in reach"}, distance ${unit(trace.distance(step))}, triangle ${trace.triangle[step]}.`;
  const rows = trace.series.filter((one) => one.found[step] !== 2).sort((a, b) => b.exactTime(step) - a.exactTime(step)).map((one) => answerRow(asked, one, noted));
  const heads = ["contestant", "time", "work", "found", "distance", "verdict"].map((text) => make("th", { scope: "col" }, text));
  const nodes: Node[] = [
    make("h3", {}, `Step ${step.toLocaleString("en-US")} of ${trace.name}`),
    make("p", {}, truth + (noted === undefined ? " (To the precision of curves: this step is none of the listed.)" : "")),
    make("div", { class: "scroll", role: "region", tabindex: 0, "aria-label": "Answers at this step" }, make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...rows)))];
  const visited = series && visits && sentenceOfVisits(visits, trace, step, series.name);
  if (visited) nodes.push(visited);
  if (series?.about.repeat) {
    nodes.push(make("p", {}, "Ask again: ", command(series.about.repeat + step)));
    const test = mesh && testOf(mesh, trace, step, series);
    if (test) nodes.push(make("button", { type: "button", class: "save", onclick: () => download(`step-${step}.sh`, test) }, "Save as test"), make("span", { class: "small" }, " a script with the mesh around the probe, the command and the truth"));
  }
  return nodes;
}

/** What the chosen contestant looked at, where that is known. */
function sentenceOfVisits(visits: Visits, trace: Trace, step: number, name: string): HTMLElement | null {
  if (!visits.of(name)) return null;
  const seen = visits.at(name, trace.name, step);
  if (!seen) return make("p", { class: "visited" }, `What ${name} looked at is known of its ten slowest and its first wrong steps.`);
  const { boxes, groups, cells } = colorsOf(isDark()), key = (color: string, label: string, shown: number) => {
    if (!shown) return null;
    const mark = make("span", { class: "mark", "aria-hidden": "true" });
    mark.style.borderColor = color;
    return make("span", { class: "key" }, mark, label);
  };
  return make("p", { class: "visited" }, `${name}: ${wordsOf(seen)} Strong lines were entered, faint ones turned away from. `,
    key(cells, "cells", seen.cells.length), key(groups, "groups", seen.groups.length), key(boxes, "boxes", seen.boxes.length), key(boxes, "cylinders", seen.rods.length));
}

function answerRow({ trace, step, series, charges, pick }: Asked, one: Series, noted: number | undefined): HTMLElement {
  const answer = noted === undefined ? null : one.answer(noted), found = one.found[step] === 1;
  const distance = !found ? "–" : answer ? String(answer.distance) : "as the truth";
  const wrong = one.charged[step] ? kinds(one.charged[step], charges) : "right";
  const told = trace.about.query === "touches" || (!answer && one.charged[step]) ? "–" : distance;
  const current = one.name === series?.name;
  return make("tr", { class: (one.charged[step] ? "wrong" : "") + (current ? " current" : "") },
    make("th", { scope: "row" }, make("button", { type: "button", onclick: () => pick(one.name), "aria-pressed": String(current) }, one.name)),
    ...[duration(one.exactTime(step)), one.work(step).toLocaleString("en-US"), found ? "yes" : "no", told, wrong].map((text) => make("td", {}, text)));
}
