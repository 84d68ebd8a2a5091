// Puts life into the page: sorting, details, curves and replay.
import { Recording } from "./data";
import { letCellsSpeak } from "./cells";
import { showDetails } from "./details";
import { Explore } from "./explore";
import { State, View } from "./state";

const FIRST_SHOWN = 6;  // contestants in the curves at first

/** Tables sort by the number that a cell carries, or by its text; a second time the other way round. */
function letTablesSort(): void {
  document.addEventListener("click", (event) => {
    const button = (event.target as HTMLElement).closest<HTMLElement>("button.sort");
    if (!button) return;
    const head = button.closest("th")!, table = head.closest("table")!, body = table.tBodies[0];
    const at = Array.from(head.parentElement!.children).indexOf(head), up = head.getAttribute("aria-sort") !== "ascending";
    for (const other of head.parentElement!.children) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const key = (row: HTMLTableRowElement) => {
      const cell = row.cells[at], value = Number(cell?.dataset.v ?? "NaN");
      return { value, text: cell?.textContent ?? "" };
    };
    const rows = Array.from(body.rows).map((row) => ({ row, ...key(row) }));
    const known = (one: { value: number }) => !Number.isNaN(one.value);
    rows.sort((a, b) => known(a) !== known(b) && (known(a) || known(b)) ? (known(a) ? -1 : 1)  // what is not known stays last
      : (up ? 1 : -1) * (known(a) ? a.value - b.value : a.text.localeCompare(b.text)));
    body.append(...rows.map((one) => one.row));
  });
}

/** What is shown at first where the address does not say. */
function firstView(recordings: Recording[]): View {
  const asked = State.asked(), number = Math.min(asked.recording ?? 0, recordings.length - 1), recording = recordings[number];
  const means = recording.contestants.map((look) => {
    const ratios = recording.rows.filter((row) => row.name === look.name).map((row) => row.ratio);
    const all = ratios.length === recording.trajectories.length && ratios.every((ratio) => ratio !== null);
    return { name: look.name, mean: all ? ratios.reduce<number>((product, ratio) => product * ratio!, 1) : Infinity };
  }).sort((a, b) => a.mean - b.mean).map((one) => one.name);
  const trajectories = recording.replay?.traces.map((trace) => trace.trajectory) ?? recording.trajectories;
  const trajectory = trajectories.includes(asked.trajectory ?? "") ? asked.trajectory! : trajectories[0] ?? "";
  const shown = (asked.shown ?? []).filter((name) => means.includes(name));
  return {
    recording: number, trajectory, shown: shown.length ? shown : means.slice(0, FIRST_SHOWN),
    begin: asked.begin ?? 0, end: asked.end ?? 0, step: asked.step ?? 0,
    contestant: means.includes(asked.contestant ?? "") ? asked.contestant! : means[0] ?? "", color: asked.color ?? "time",
  };
}

function start(): void {
  const { data: page, arrays: stream } = window.touchmark, recordings = page.recordings;
  letTablesSort();
  letCellsSpeak();
  document.documentElement.classList.add("scripted");
  const state = new State(firstView(recordings));
  const built = new Set<number>();
  const show = () => {
    const number = state.view.recording;
    document.querySelectorAll<HTMLElement>("article.recording").forEach((article) => { article.classList.toggle("hidden", Number(article.dataset.recording) !== number); });
    const place = document.querySelector<HTMLElement>(`.interactive[data-recording="${number}"]`);
    if (!place || built.has(number)) return;
    built.add(number);
    new Explore(place, recordings[number], stream, state, page.charges, (name, trajectory) => showDetails(recordings[number], name, trajectory));
  };
  document.addEventListener("click", (event) => {
    const button = (event.target as HTMLElement).closest<HTMLElement>("button.pick");
    if (button) showDetails(recordings[state.view.recording], button.dataset.name!, undefined);
  });
  document.getElementById("recording")?.addEventListener("change", (event) => {
    location.hash = "";
    location.hash = "recording=" + (event.target as HTMLSelectElement).value;
  });
  window.addEventListener("hashchange", () => location.reload());
  const chooser = document.getElementById("recording") as HTMLSelectElement | null;
  if (chooser) chooser.value = String(state.view.recording);
  show();
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

try {
  start();
} catch (error) {
  window.touchmark.tell(error);
  throw error;
}
