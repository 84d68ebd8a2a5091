// All numbers of one row, with the commands that measure it again.
import { Recording, Row } from "./data";
import { command, duration, make } from "./words";

/** The command that measures this row again. */
export function benchCommand(recording: Recording, row: Row): string {
  const trace = recording.replay?.traces.find((one) => one.trajectory === row.trajectory);
  const repeat = trace?.contestants.find((one) => one.name === row.name)?.repeat;
  if (repeat) return repeat.replace("touchmark query", "touchmark bench").replace(/ --step $/, "");
  const { mesh, query, radius, reach } = row.fields;
  return `touchmark bench --mesh ${mesh} --trajectory ${word(row.trajectory)} --detector ${word(row.name)} --query ${query} --radius ${radius}${reach === radius ? "" : ` --reach ${reach}`}`;
}

const word = (text: string): string => /^[\w.,:=%/+-]+$/.test(text) ? text : `'${text}'`;

export function showDetails(recording: Recording, name: string, trajectory: string | undefined): void {
  const rows = recording.rows.filter((row) => row.name === name && (!trajectory || row.trajectory === trajectory));
  document.getElementById("details")?.remove();
  const close: HTMLElement = make("button", { type: "button", class: "close", onclick: () => dialog.close() }, "Close");
  const dialog: HTMLDialogElement = make("dialog", { id: "details", "aria-label": `All numbers of ${name}` }, close, make("h2", {}, name), ...rows.map((row) => section(recording, row)));
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

function section(recording: Recording, row: Row): HTMLElement {
  const list = make("dl", { class: "facts" });
  for (const [column, value] of Object.entries(row.fields)) list.append(make("dt", {}, column), make("dd", {}, value));
  const time = row.ns === null ? "not timed" : `mean ${duration(row.ns)}${row.ratio ? `, ${row.ratio.toFixed(3)} of the fastest right one's` : ""}`;
  return make("section", {}, make("h3", {}, `${row.trajectory}: ${time}`), make("p", {}, row.words ? `Wrong: ${row.words}.` : "Never wrong."),
    make("p", {}, "Measure again: ", command(benchCommand(recording, row))), make("details", {}, make("summary", {}, "its row of results.csv"), list));
}
