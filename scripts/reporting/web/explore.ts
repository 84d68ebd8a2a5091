// The part of the page that moves: choices, curves, the table of the stretch, replay, lists of steps.
import { Chart, drawTails, drawTimeError, drawTimes, drawWork, timesOf } from "./charts";
import { Look, Mesh, Recording, Series, Trace } from "./data";
import { rampAsCss, Stage } from "./replay";
import { State, View } from "./state";
import { describe } from "./step";
import { Visits } from "./visits";
import { digits, duration, kinds, lighter, make, movesLittle } from "./words";

const SPEEDS = [0.01, 0.1, 1];
const WRONG_AT_ONCE = 50;

export class Explore {
  private readonly traces = new Map<string, Trace>();
  private readonly mesh: Mesh | null;
  private readonly visits: Visits | null;
  private readonly times = new Chart("Time of each step along the trajectory", "Drag over the curves to choose a stretch; click on a peak to see that step.");
  private readonly tails = new Chart("Share of steps that took longer", "Both scales are logarithmic: a curve that ends far right has rare slow steps.");
  private readonly work = new Chart("Work of a step", "What a step looked at is the same on every machine.");
  private readonly scatter = new Chart("Mean time over all trajectories, and the largest error of a distance", "A disc was never wrong, a cross was. Click on a mark for its numbers.", "24rem");
  private readonly swatches = make("fieldset", { class: "swatches" });
  private readonly choice = make("select", { id: "trajectory" });
  private readonly from = make("input", { type: "number", min: 0, "aria-label": "first step of the stretch" });
  private readonly to = make("input", { type: "number", min: 1, "aria-label": "end of the stretch" });
  private readonly stretch = make("div", { class: "scroll", role: "region", tabindex: 0, "aria-label": "The stretch in numbers" });
  private readonly about = make("div", { class: "about-step", "aria-live": "polite" });
  private readonly lists = make("div", { class: "lists" });
  private readonly slider = make("input", { type: "range", min: 0, step: 1, class: "scrub", "aria-label": "step" });
  private readonly play = make("button", { type: "button", class: "play" }, "Play");
  private readonly speed = make("select", { "aria-label": "speed" }, ...SPEEDS.map((one) => make("option", { value: one }, one === 1 ? "real time" : `${one} × real time`)));
  private readonly whose = make("select", { "aria-label": "contestant" });
  private readonly coloring = make("select", { "aria-label": "colour of the way" }, make("option", { value: "time" }, "time"), make("option", { value: "error" }, "wrong answers"));
  private readonly looked = make("input", { type: "checkbox", checked: true });
  private readonly keyOfColors = make("p", { class: "color-key" });
  private stage: Stage | null = null;
  private timer = 0;
  private shownWrong = WRONG_AT_ONCE;

  constructor(private readonly place: HTMLElement, private readonly recording: Recording, private readonly stream: Uint8Array,
    private readonly state: State, private readonly charges: string[], private readonly details: (name: string, trajectory?: string) => void) {
    this.mesh = recording.replay ? new Mesh(stream, recording.replay.mesh) : null;
    this.visits = recording.visits && new Visits(stream, recording.visits);
    this.build();
    this.state.listen((view, changed) => this.update(view, changed));
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.drawAll());
    for (const [event, paper] of [["beforeprint", true], ["afterprint", false]] as const) {
      window.addEventListener(event, () => { document.documentElement.classList.toggle("paper", paper); this.drawAll(); });
    }
    this.drawAll();
  }

  private get view(): View { return this.state.view; }

  private trace(): Trace | null {
    const about = this.recording.replay?.traces.find((one) => one.trajectory === this.view.trajectory);
    if (!about) return null;
    let trace = this.traces.get(about.trajectory);
    if (!trace) this.traces.set(about.trajectory, trace = new Trace(this.stream, about));
    return trace;
  }
  private looks(): Look[] { return this.recording.contestants.filter((look) => this.view.shown.includes(look.name)); }
  private range(trace: Trace): [number, number] {
    return this.view.end > this.view.begin ? [Math.max(0, this.view.begin), Math.min(trace.steps, this.view.end)] : [0, trace.steps];
  }

  // ----- building

  private build(): void {
    document.querySelector(`.scatter[data-recording="${this.place.dataset.recording}"]`)!.append(make("section", { "aria-label": "Time against error" }, make("h2", {}, "Time against error"), this.scatter.element));
    if (!this.mesh) return;
    for (const trace of this.recording.replay!.traces) this.choice.append(make("option", { value: trace.trajectory }, trace.trajectory));
    this.choice.addEventListener("change", () => this.state.set({ trajectory: this.choice.value, begin: 0, end: 0, step: 0 }));
    this.fillSwatches();
    const apply = () => this.state.set({ begin: Math.max(0, Number(this.from.value)), end: Math.max(0, Number(this.to.value)) });
    this.from.addEventListener("change", apply);
    this.to.addEventListener("change", apply);
    const all = make("button", { type: "button", onclick: () => this.state.set({ begin: 0, end: 0 }) }, "All steps");
    this.place.append(make("section", { "aria-label": "Explore" }, make("h2", {}, "Explore the steps"),
      make("div", { class: "bar" }, make("label", {}, "Trajectory ", this.choice), make("span", { class: "stretch" }, "Steps ", this.from, " to ", this.to, " ", all)),
      this.swatches,
      this.recording.resolution > 0.5 && make("p", { class: "small" }, `Curves are exact to ${digits(this.recording.resolution)} %; listed steps are exact.`),
      this.times.element, make("div", { class: "pair" }, this.tails.element, this.work.element), this.stretch));
    this.buildReplay();
    this.place.append(make("section", { "aria-label": "Steps worth a look" }, make("h2", {}, "Slowest and wrong steps"), this.lists));
  }

  private fillSwatches(): void {
    this.swatches.append(make("legend", {}, "Contestants"));
    for (const look of this.recording.contestants) {
      const box = make("input", { type: "checkbox", value: look.name });
      box.addEventListener("change", () => this.state.set({ shown: this.recording.contestants.map((one) => one.name).filter((name) => name === look.name ? box.checked : this.view.shown.includes(name)) }));
      const line = `<svg width="30" height="10" aria-hidden="true"><line x1="0" y1="5" x2="30" y2="5" stroke-width="3" stroke-dasharray="${look.dash.join(" ")}"/></svg>`;
      const sample = make("span", { class: "sample" });
      sample.innerHTML = line;
      sample.style.setProperty("--light", look.color);
      sample.style.setProperty("--dark", lighter(look.color));
      this.swatches.append(make("label", {}, box, sample, look.name));
    }
  }

  private buildReplay(): void {
    const box = make("div", { class: "stage", tabindex: 0, role: "application", "aria-label": "Replay. Left and right arrow: a step; page keys: a hundred; space: play or pause; N: next slow step of the list; H: the whole mesh." });
    const go = (change: number) => this.state.set({ step: Math.max(0, Math.min((this.trace()?.steps ?? 1) - 1, this.view.step + change)) });
    box.addEventListener("keydown", (event) => {
      const key = (event as KeyboardEvent).key;
      const moves: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1, PageUp: -100, PageDown: 100 };
      if (key in moves) go(moves[key]);
      else if (key === " ") this.toggle();
      else if (key.toLowerCase() === "h") this.stage?.home();
      else if (key.toLowerCase() === "n") this.nextSlow();
      else return;
      event.preventDefault();
    });
    this.slider.addEventListener("input", () => this.state.set({ step: Number(this.slider.value) }));
    this.play.addEventListener("click", () => this.toggle());
    this.whose.addEventListener("change", () => this.state.set({ contestant: this.whose.value }));
    this.coloring.addEventListener("change", () => this.state.set({ color: this.coloring.value as View["color"] }));
    const home = make("button", { type: "button", onclick: () => this.stage?.home() }, "Whole mesh");
    const fly = make("button", { type: "button", onclick: () => this.fly() }, "To the probe");
    const controls = make("div", { class: "bar" }, this.play, make("label", {}, "Speed ", this.speed), make("label", {}, "Contestant ", this.whose), make("label", {}, "Colour ", this.coloring), home, fly,
      this.visits && make("label", {}, this.looked, " What it looked at"));
    this.looked.addEventListener("change", () => this.showStep(this.view));
    const coarse = this.mesh!.about.drawnTriangles < this.mesh!.about.triangles ? `Drawn with ${this.mesh!.about.drawnTriangles.toLocaleString("en-US")} of ${this.mesh!.about.triangles.toLocaleString("en-US")} triangles; those around a listed step are as they are.` : "";
    this.place.append(make("section", { "aria-label": "Replay", class: "replay" }, make("h2", {}, "Replay"), controls, this.slider, this.keyOfColors,
      make("div", { class: "theatre" }, box, this.about), make("p", { class: "small" }, coarse)));
    this.speed.value = movesLittle() ? "0.01" : "0.1";
    // The slowest part to come up, and below the first screen.
    setTimeout(() => {
      try {
        this.stage = new Stage(this.mesh!, box);
      } catch {
        box.append(make("p", { class: "notice" }, "This browser has no WebGL, so there is no picture; the numbers of each step are beside it."));
      }
      this.drawWay();
      this.showStep(this.view);
    });
  }

  // ----- what changes

  private update(view: View, changed: Set<keyof View>): void {
    if (changed.has("trajectory") || changed.has("shown") || changed.has("begin") || changed.has("end")) {
      this.shownWrong = WRONG_AT_ONCE;
      this.drawCurves();
      this.drawLists();
    }
    if (changed.has("contestant")) this.drawLists();
    if (changed.has("trajectory") || changed.has("contestant") || changed.has("color")) this.drawWay();
    this.showStep(view);
  }

  private drawAll(): void {
    drawTimeError(this.scatter, this.recording, (name) => this.details(name));
    if (!this.mesh) return;
    this.drawCurves();
    this.drawWay();
    this.drawLists();
    this.showStep(this.view);
  }

  private drawCurves(): void {
    const trace = this.trace();
    if (!trace) return;
    const looks = this.looks(), [begin, end] = this.range(trace);
    this.choice.value = trace.name;
    this.from.value = String(begin);
    this.to.value = String(end);
    this.from.max = this.to.max = String(trace.steps);
    for (const box of this.swatches.querySelectorAll("input")) box.checked = this.view.shown.includes(box.value);
    drawTimes(this.times, trace, looks, begin, end, (low, high) => this.state.set({ begin: low, end: high }), (step, name) => this.goTo(step, name));
    drawTails(this.tails, trace, looks, begin, end);
    drawWork(this.work, trace, looks, begin, end);
    this.fillStretch(trace, looks, begin, end);
  }

  private fillStretch(trace: Trace, looks: Look[], begin: number, end: number): void {
    const body = make("tbody");
    for (const look of looks) {
      const one = trace.named(look.name), times = timesOf(one, begin, end);
      if (!one || !times.length) continue;
      const at = (share: number) => duration(times[Math.max(0, Math.ceil(share * times.length) - 1)]);
      const mean = times.reduce((sum, time) => sum + time, 0) / times.length;
      const wrong = one.wrong.filter((step) => step >= begin && step < end).length;
      const slowest = one.slowest(1, begin, end)[0];
      body.append(make("tr", {}, make("th", { scope: "row" }, make("button", { type: "button", onclick: () => this.details(look.name, trace.name) }, look.name)),
        ...[String(times.length), duration(mean), at(0.5), at(0.99), times.length >= 1000 ? at(0.999) : "–"].map((text) => make("td", {}, text)),
        make("td", {}, make("button", { type: "button", onclick: () => this.goTo(slowest, look.name), "aria-label": `slowest step of ${look.name}, step ${slowest}` }, duration(one.exactTime(slowest)))),
        make("td", {}, wrong ? `${wrong}` : "none")));
    }
    const heads = ["contestant", "steps", "mean", "p50", "p99", "p99.9", "slowest", "wrong"].map((text) => make("th", { scope: "col" }, text));
    const caption = begin === 0 && end === trace.steps ? `All ${end.toLocaleString("en-US")} steps of ${trace.name}` : `Steps ${begin.toLocaleString("en-US")} to ${(end - 1).toLocaleString("en-US")} of ${trace.name}`;
    this.stretch.replaceChildren(make("table", {}, make("caption", {}, caption + ", each with one reading of the clock"), make("thead", {}, make("tr", {}, ...heads)), body));
  }

  private series(): Series | undefined {
    const trace = this.trace();
    return trace?.named(this.view.contestant) ?? trace?.series[0];
  }

  private drawWay(): void {
    const trace = this.trace(), series = this.series();
    if (!trace || !series) return;
    this.whose.replaceChildren(...trace.series.map((one) => make("option", { value: one.name }, one.name)));
    this.whose.value = series.name;
    this.coloring.value = this.view.color;
    this.slider.max = String(trace.steps - 1);
    const bar = make("span", { class: "ramp", "aria-hidden": "true" });
    bar.style.background = rampAsCss;
    this.keyOfColors.replaceChildren(...(this.view.color === "time"
      ? [`Way coloured by the time of ${series.name}: ${duration(series.about.lowNs)} `, bar, ` ${duration(series.about.highNs)}`]
      : [`Way coloured by the answers of ${series.name}: red is wrong (${series.about.wrong.toLocaleString("en-US")} steps)`]));
    this.stage?.showWay(trace, series, this.view.color);
  }

  private goTo(step: number, name: string): void {
    this.state.set({ step, contestant: name });
    this.place.querySelector<HTMLElement>(".replay")!.scrollIntoView({ behavior: movesLittle() ? "auto" : "smooth", block: "start" });
    this.fly();
  }

  private fly(): void {
    const trace = this.trace();
    if (trace) this.stage?.flyTo(trace, Math.min(this.view.step, trace.steps - 1));
  }

  private nextSlow(): void {
    const trace = this.trace(), series = this.series();
    if (!trace || !series) return;
    const slow = series.slowest(10, ...this.range(trace)), at = slow.indexOf(this.view.step);
    if (slow.length) this.goTo(slow[(at + 1) % slow.length], series.name);
  }

  private toggle(): void {
    if (this.timer) {
      cancelAnimationFrame(this.timer);
      this.timer = 0;
      this.play.textContent = "Play";
      return;
    }
    this.play.textContent = "Pause";
    let before = performance.now(), passed = 0;
    const move = (now: number) => {
      passed += (now - before) * Number(this.speed.value);  // a step is a millisecond
      before = now;
      const whole = Math.floor(passed), last = (this.trace()?.steps ?? 1) - 1;
      passed -= whole;
      if (whole) this.state.set({ step: this.view.step >= last ? 0 : Math.min(last, this.view.step + whole) });
      if (this.timer) this.timer = requestAnimationFrame(move);
    };
    this.timer = requestAnimationFrame(move);
  }

  // ----- one step

  private showStep(view: View): void {
    const trace = this.trace();
    if (!trace) return;
    const step = Math.min(view.step, trace.steps - 1);
    this.slider.value = String(step);
    this.slider.setAttribute("aria-valuetext", `step ${step}`);
    const colors = new Map(this.recording.contestants.map((look) => [look.name, look.color]));
    this.stage?.showStep(trace, step, trace.series, colors);
    const series = this.series(), seen = series && this.visits?.at(series.name, trace.name, step);
    this.stage?.showVisited(seen && this.looked.checked ? seen : null);
    this.about.replaceChildren(...describe({ trace, step, series, mesh: this.mesh, visits: this.visits, charges: this.charges, pick: (name) => this.state.set({ contestant: name }) }));
  }

  // ----- lists

  private drawLists(): void {
    const trace = this.trace();
    if (!trace) return;
    const [begin, end] = this.range(trace), looks = this.looks();
    const link = (one: Series, step: number, text: string) => make("li", {}, make("button", { type: "button", class: "step", "data-step": step, "data-name": one.name, onclick: () => this.goTo(step, one.name) }, text));
    const blocks = looks.map((look) => {
      const one = trace.named(look.name);
      if (!one) return null;
      const slow = one.slowest(10, begin, end).map((step) => link(one, step, `step ${step}: ${duration(one.exactTime(step))}`));
      const bad = one.wrong.filter((step) => step >= begin && step < end);
      const wrong = bad.slice(0, this.shownWrong).map((step) => link(one, step, `step ${step}: ${kinds(one.charged[step], this.charges)}`));
      const more = bad.length > this.shownWrong && make("button", { type: "button", onclick: () => { this.shownWrong *= 10; this.drawLists(); } }, `Show more of ${bad.length.toLocaleString("en-US")}`);
      return make("details", look.name === this.series()?.name ? { open: true } : {}, make("summary", {}, `${look.name}: worst ${slow.length}${bad.length ? `, ${bad.length.toLocaleString("en-US")} wrong` : ", none wrong"}`),
        make("h3", {}, "Slowest"), make("ol", {}, ...slow), bad.length > 0 && make("h3", {}, "Wrong"), bad.length > 0 && make("ul", {}, ...wrong), more);
    });
    this.lists.replaceChildren(...blocks.filter((block): block is HTMLDetailsElement => block !== null));
  }
}
