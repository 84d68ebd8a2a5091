// Numbers as people read them, and small helpers for elements.

export function digits(value: number): string {
  if (!Number.isFinite(value)) return "–";
  return value >= 1000 ? Number(value.toPrecision(3)).toLocaleString("en-US") : String(Number(value.toPrecision(3)));
}

export function duration(ns: number): string {
  if (!Number.isFinite(ns)) return "–";
  if (ns >= 1e9) return `${digits(ns / 1e9)} s`;
  if (ns >= 1e6) return `${digits(ns / 1e6)} ms`;
  if (ns >= 1e3) return `${digits(ns / 1e3)} µs`;
  return `${digits(ns)} ns`;
}

export function kinds(bits: number, names: string[]): string {
  return names.filter((_, i) => bits & (1 << i)).join(", ");
}

type Child = Node | string | null | false | undefined;
type Attributes = Record<string, string | number | boolean | EventListener | ((event: Event) => void)>;

/** An element; attributes that begin with "on" are listeners. */
export function make<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => Boolean(child) || child === ""));
  return element;
}

export function say(text: string): void {
  const place = document.getElementById("copied");
  if (place) place.textContent = text;
}

/** A command with a button that copies it. */
export function command(text: string, label = "Copy"): HTMLElement {
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text);
    } catch {  // no clipboard for files in some browsers
      const area = make("textarea", { "aria-hidden": "true" });
      area.value = text;
      document.body.append(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
    say("Copied: " + text);
  };
  return make("span", { class: "command" }, make("code", {}, text), make("button", { type: "button", onclick: copy, "aria-label": `${label}: ${text}` }, label));
}

/** Paper is light; the style sheet has its colours. */
export const onPaper = (): boolean => document.documentElement.classList.contains("paper");
export const isDark = (): boolean => !onPaper() && window.matchMedia("(prefers-color-scheme: dark)").matches;
export const movesLittle = (): boolean => window.matchMedia("(prefers-reduced-motion: reduce)").matches;

/** A colour of a line on the page's ground: lighter on dark. */
export function shade(color: string): string { return isDark() ? lighter(color) : color; }

/** Half way to white. */
export function lighter(color: string): string {
  const parts = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
  return "#" + parts.map((part) => Math.round(part + (255 - part) * 0.5).toString(16).padStart(2, "0")).join("");
}

export function variable(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
