// The ratio tables by keyboard: arrow keys go from cell to cell, and what a cell has to say is shown on hover and on focus.
import { make } from "./words";

const MOVES: Record<string, [number, number]> = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };

export function letCellsSpeak(): void {
  const tip = make("div", { class: "tip", role: "tooltip", id: "tip" });
  tip.hidden = true;
  document.body.append(tip);
  document.querySelectorAll<HTMLTableElement>("table.ratios").forEach((table) => prepare(table, tip));
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") tip.hidden = true; });
}

function prepare(table: HTMLTableElement, tip: HTMLElement): void {
  for (const cell of table.querySelectorAll<HTMLElement>("[title]")) {
    cell.dataset.tip = cell.title;
    cell.removeAttribute("title");
  }
  table.setAttribute("role", "grid");
  for (const cell of table.tBodies[0].querySelectorAll<HTMLElement>("td")) cell.tabIndex = -1;
  const first = table.tBodies[0].querySelector<HTMLElement>("td");
  if (first) first.tabIndex = 0;  // one stop for tab; arrows do the rest
  const told = (event: Event) => (event.target as HTMLElement).closest<HTMLElement>("[data-tip]");
  table.addEventListener("mouseover", (event) => show(tip, told(event)));
  table.addEventListener("mouseout", () => show(tip, null));
  table.addEventListener("focusin", (event) => {
    const cell = (event.target as HTMLElement).closest<HTMLElement>("td, th");
    if (cell?.tagName === "TD") {
      table.querySelectorAll<HTMLElement>("td[tabindex='0']").forEach((one) => { one.tabIndex = -1; });
      cell.tabIndex = 0;
    }
    show(tip, told(event));
  });
  table.addEventListener("focusout", () => show(tip, null));
  table.addEventListener("keydown", (event) => {
    const cell = (event.target as HTMLElement).closest<HTMLTableCellElement>("td"), move = MOVES[event.key];
    if (!cell || !move) return;
    const row = cell.parentElement as HTMLTableRowElement, rows = Array.from(table.tBodies[0].rows);
    const next = rows[rows.indexOf(row) + move[0]]?.cells[cell.cellIndex + move[1]];
    if (!next) return;
    (next.tagName === "TD" ? next : next.querySelector("button"))?.focus();
    event.preventDefault();
  });
}

/** Below the cell, within the window; null hides it. */
function show(tip: HTMLElement, cell: HTMLElement | null): void {
  document.querySelector("[aria-describedby='tip']")?.removeAttribute("aria-describedby");
  tip.hidden = !cell;
  if (!cell) return;
  tip.textContent = cell.dataset.tip!;
  cell.setAttribute("aria-describedby", "tip");
  const box = cell.getBoundingClientRect();
  tip.style.top = `${box.bottom + window.scrollY + 4}px`;
  tip.style.left = `${Math.max(4, Math.min(box.left, document.documentElement.clientWidth - tip.offsetWidth - 4)) + window.scrollX}px`;
}
