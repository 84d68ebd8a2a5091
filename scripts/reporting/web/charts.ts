// The curves: time along the trajectory, share of slower steps, work; and time against error.
import Dygraph from "dygraphs";
import type { Options, Point } from "dygraphs";
import { Look, Recording, Series, Trace } from "./data";
import { duration, make, shade, variable } from "./words";

const NOTHING: [number | null][] = [[0], [1]];

/** Ticks at powers of ten, and at 2 and 5 times those where a label and its gap take no more than `room` pixels; for axes that
    hold logarithms. */
function decades(label: (value: number) => string, room: number) {
  return (low: number, high: number, pixels: number): { v: number; label: string }[] => {
    const wide = (high - low) * room < pixels * 0.3, ticks: { v: number; label: string }[] = [];
    const every = Math.max(1, Math.ceil((high - low) * room / pixels));
    for (let power = Math.floor(low); power <= Math.ceil(high); ++power) {
      for (const factor of wide ? [1, 2, 5] : [1]) {
        const v = power + Math.log10(factor);
        if (v >= low && v <= high && (power % every === 0 || wide)) ticks.push({ v, label: label(factor * 10 ** power) });
      }
    }
    return ticks;
  };
}

const share = (value: number): string => value >= 1 ? "100 %" : `${Number((100 * value).toPrecision(2))} %`;
const count = (value: number): string => value.toLocaleString("en-US");
const whole = (low: number, high: number, pixels: number): { v: number; label: string }[] => {
  const raw = (high - low) / Math.max(2, pixels / 90), power = 10 ** Math.floor(Math.log10(Math.max(raw, 1)));
  const step = Math.max(1, [1, 2, 5, 10].map((one) => one * power).find((one) => one >= raw) ?? 10 * power);
  const ticks = [];
  for (let v = Math.ceil(low / step) * step; v <= high; v += step) ticks.push({ v, label: count(v) });
  return ticks;
};

/** A figure with a curve in it, its heading, and a line that says what the pointer is on. */
export class Chart {
  readonly element: HTMLElement;
  private readonly place: HTMLElement;
  private readonly readout: HTMLElement;
  private graph: Dygraph | null = null;

  constructor(title: string, note: string, height = "18rem") {
    this.place = make("div", { class: "chart", role: "img", "aria-label": title });
    this.place.style.height = height;
    this.readout = make("p", { class: "readout" }, note);
    this.note = note;
    new ResizeObserver(() => this.graph?.resize()).observe(this.place);
    this.element = make("figure", {}, make("figcaption", {}, title), this.place, this.readout);
  }
  private note: string;

  draw(data: (number | null)[][], looks: Look[], options: Options, say: (points: Point[], row: number) => string): void {
    this.graph?.destroy();
    this.graph = null;
    const series: Record<string, object> = {};
    for (const look of looks) series[look.name] = { color: shade(look.color), strokePattern: look.dash.length ? look.dash : null };
    // Dygraphs wants a series; where none is chosen, an empty one.
    const labels = ["x", ...(looks.length ? looks.map((look) => look.name) : ["nothing chosen"])];
    const rows = looks.length && data.length ? data : NOTHING.map((row) => [...row, ...labels.slice(1).map(() => null)]);
    this.graph = new Dygraph(this.place, rows, {
      labels, series, legend: "never", strokeWidth: 1.6, highlightCircleSize: 4, gridLineColor: variable("--grid"),
      axisLineColor: variable("--grid"), axisLabelFontSize: 13, rightGap: 12, connectSeparatedPoints: true, animatedZooms: false,
      highlightCallback: (_: Event, __: number, points: Point[], row: number) => { this.readout.textContent = say(points, row); },
      unhighlightCallback: () => { this.readout.textContent = this.note; },
      ...options,
    });
  }

}

function each(points: Point[], text: (value: number) => string): string {
  return points.filter((point) => Number.isFinite(point.yval)).sort((a, b) => b.yval - a.yval)
    .map((point) => `${point.name} ${text(point.yval)}`).join(" · ");
}

/** Time along the trajectory; a point is the slowest of as many steps as share it. */
export function drawTimes(chart: Chart, trace: Trace, looks: Look[], begin: number, end: number, brush: (begin: number, end: number) => void,
  pick: (step: number, name: string) => void): void {
  const points = Math.min(end - begin, 1200), data: (number | null)[][] = [];
  const series = looks.map((look) => trace.named(look.name));
  for (let i = 0; i < points; ++i) {
    const from = begin + Math.floor((end - begin) * i / points), to = begin + Math.floor((end - begin) * (i + 1) / points);
    const row: (number | null)[] = [from];
    for (const one of series) {
      let most = NaN;
      for (let step = from; one && step < to; ++step) if (!(one.ns[step] <= most) && one.ns[step] === one.ns[step]) most = one.ns[step];
      row.push(most > 0 ? Math.log10(most) : null);
    }
    data.push(row);
  }
  const each_point = (end - begin) / points;
  let last: Point[] = [];
  chart.draw(data, looks, {
    axes: { x: { ticker: whole, axisLabelWidth: 60 }, y: { ticker: decades(duration, 22), axisLabelWidth: 62 } },
    xlabel: "step", ylabel: "", xRangePad: 0,
    zoomCallback: (low: number, high: number) => brush(Math.max(begin, Math.floor(low)), Math.min(end, Math.ceil(high))),
    clickCallback: (_: Event, x: number, points: Point[]) => {
      const top = points.filter((point) => Number.isFinite(point.yval)).sort((a, b) => b.yval - a.yval)[0];
      if (!top) return;
      const one = trace.named(top.name), to = Math.min(end, Math.ceil(x + each_point));
      let slowest = Math.round(x);
      for (let step = Math.round(x); one && step < to; ++step) if (one.ns[step] > (one.ns[slowest] || 0)) slowest = step;
      pick(slowest, top.name);
    },
  }, (now) => { last = now; return `step ${count(last[0]?.xval ?? 0)}: ${each(now, (v) => duration(10 ** v))}`; });
}

/** How many steps took longer than x, of those in the stretch. */
export function drawTails(chart: Chart, trace: Trace, looks: Look[], begin: number, end: number): void {
  const sorted = looks.map((look) => timesOf(trace.named(look.name), begin, end));
  const all = sorted.filter((times) => times.length);
  const low = Math.log10(Math.min(...all.map((times) => times[0]), Infinity)), high = Math.log10(Math.max(...all.map((times) => times[times.length - 1]), -Infinity));
  const data: (number | null)[][] = [], points = 300;
  for (let i = 0; i <= points && Number.isFinite(low); ++i) {
    const x = low + (high - low) * i / points;
    data.push([x, ...sorted.map((times) => {
      const slower = times.length - upper(times, 10 ** x);
      return times.length && slower > 0 ? Math.log10(slower / times.length) : null;
    })]);
  }
  chart.draw(data, looks, {
    axes: { x: { ticker: decades(duration, 70), axisLabelWidth: 70 }, y: { ticker: decades(share, 22), axisLabelWidth: 62 } },
    xlabel: "time of a step", stepPlot: true, interactionModel: {},
  }, (now) => `slower than ${duration(10 ** (now[0]?.xval ?? 0))}: ${each(now, (v) => share(10 ** v))}`);
}

/** How many steps looked at so much. */
export function drawWork(chart: Chart, trace: Trace, looks: Look[], begin: number, end: number): void {
  const bins = 48, series = looks.map((look) => trace.named(look.name));
  const limits = series.filter((one): one is Series => Boolean(one)).map((one) => [one.about.lowWork, one.about.highWork]);
  const low = Math.log10(Math.max(1, Math.min(...limits.map((one) => one[0])))), high = Math.log10(Math.max(2, ...limits.map((one) => one[1])));
  const counts = series.map((one) => {
    const heights = new Array<number>(bins).fill(0);
    for (const step of one?.asked ?? []) {
      if (step < begin || step >= end) continue;
      const at = Math.floor((Math.log10(Math.max(1, one!.work(step))) - low) / (high - low) * bins);
      heights[Math.min(bins - 1, Math.max(0, at))] += 1;
    }
    const total = heights.reduce((sum, height) => sum + height, 0);
    return heights.map((height) => total ? 100 * height / total : 0);
  });
  const data: (number | null)[][] = [];
  for (let i = 0; i < bins; ++i) data.push([low + (high - low) * i / bins, ...counts.map((heights) => heights[i])]);
  chart.draw(data, looks, {
    axes: { x: { ticker: decades(count, 70), axisLabelWidth: 60 }, y: { axisLabelWidth: 46, axisLabelFormatter: (v: number) => `${v} %` } },
    xlabel: "groups, spheres, boxes and triangles looked at in a step", stepPlot: true, fillGraph: looks.length <= 2, interactionModel: {},
  }, (now) => `about ${count(Math.round(10 ** (now[0]?.xval ?? 0)))} looked at: ${each(now, (v) => `${v.toFixed(1)} %`)}`);
}

/** The times of the steps in the stretch, ascending. */
export function timesOf(one: Series | undefined, begin: number, end: number): Float32Array {
  if (!one) return new Float32Array();
  const times: number[] = [];
  for (const step of one.asked) if (step >= begin && step < end) times.push(one.ns[step]);
  return Float32Array.from(times).sort();
}

/** How many of the ascending numbers are at most x. */
function upper(sorted: Float32Array, x: number): number {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= x) low = middle + 1; else high = middle;
  }
  return low;
}

const EXACT = -17;  // where what has no error is drawn, as a power of ten of the diagonal

/** Time against the largest error of a distance: a mark a contestant, of its worst over the trajectories. */
export function drawTimeError(chart: Chart, recording: Recording, pick: (name: string) => void): void {
  const marks: { look: Look; x: number; y: number; wrong: boolean }[] = [];
  for (const look of recording.contestants) {
    const rows = recording.rows.filter((row) => row.name === look.name && row.ns !== null);
    if (!rows.length || rows.length < recording.trajectories.length) continue;
    const mean = rows.reduce((sum, row) => sum + Math.log10(row.ns!), 0) / rows.length;
    const errors = rows.map((row) => Number(row.fields["max_distance_error_of_diagonal"] ?? "NaN")).filter((one) => !Number.isNaN(one));
    if (!errors.length) continue;
    const worst = Math.max(...errors);
    marks.push({ look, x: mean, y: worst > 0 ? Math.max(EXACT, Math.log10(worst)) : EXACT, wrong: rows.some((row) => row.wrong > 0) });
  }
  marks.sort((a, b) => a.x - b.x);
  const looks = marks.map((mark) => mark.look);
  const data = marks.map((mark, i) => [mark.x, ...marks.map((_, k) => k === i ? mark.y : null)]);
  const low = Math.min(...marks.map((mark) => mark.x)) - 0.2, high = Math.max(...marks.map((mark) => mark.x)) + 0.3;
  const drawMark = (_: unknown, name: string, canvas: CanvasRenderingContext2D, x: number, y: number, color: string) => {
    const mark = marks.find((one) => one.look.name === name)!;
    canvas.fillStyle = canvas.strokeStyle = color;
    canvas.lineWidth = 2;
    canvas.beginPath();
    if (mark.wrong) {  // a cross: errs, also in grey
      canvas.moveTo(x - 5, y - 5); canvas.lineTo(x + 5, y + 5); canvas.moveTo(x + 5, y - 5); canvas.lineTo(x - 5, y + 5);
      canvas.stroke();
    } else {
      canvas.arc(x, y, 5, 0, 2 * Math.PI);
      canvas.fill();
    }
  };
  chart.draw(data, looks, {
    strokeWidth: 0, drawPoints: true, pointSize: 5, highlightCircleSize: 8, drawPointCallback: drawMark, underlayCallback: (canvas: CanvasRenderingContext2D, area: Area, graph: Dygraph) => labelMarks(canvas, area, marks.map((mark) => ({ name: mark.look.name, at: graph.toDomCoords(mark.x, mark.y) }))),
    
    dateWindow: [low, high], valueRange: [EXACT - 4, 0.5], xlabel: "mean time of a query",
    axes: { x: { ticker: decades(duration, 70), axisLabelWidth: 70 }, y: { ticker: errorTicks, axisLabelWidth: 74 } },
    pointClickCallback: (_: Event, point: Point) => pick(point.name),
  }, (now) => now.map((point) => `${point.name}: ${duration(10 ** point.xval)}, ${point.yval <= EXACT ? "no error" : `off by ${(10 ** point.yval).toExponential(1)} of the diagonal`}`).join(" · "));
}

interface Area { x: number; y: number; w: number; h: number }
interface Box { left: number; right: number; top: number; bottom: number }

/** Names beside marks, moved up or down where they would hide a mark or another name, with a line to their mark then. */
function labelMarks(canvas: CanvasRenderingContext2D, area: Area, marks: { name: string; at: [number, number] }[]): void {
  const taken: Box[] = marks.map(({ at }) => ({ left: at[0] - 6, right: at[0] + 6, top: at[1] - 6, bottom: at[1] + 6 }));
  canvas.font = "12px system-ui, sans-serif";
  for (const { name, at: [x, y] } of marks) {
    const most = Math.min(40, Math.max(10, Math.floor(area.w / 14)));
    const text = name.length > most ? name.slice(0, most - 1) + "…" : name, width = canvas.measureText(text).width;
    const left = x + 9 + width < area.x + area.w ? x + 9 : Math.max(area.x, x - 9 - width);
    const place = freePlace(taken, area, left, y, width);
    if (place !== y) {
      canvas.strokeStyle = variable("--line");
      canvas.lineWidth = 1;
      canvas.beginPath();
      canvas.moveTo(x, y);
      canvas.lineTo(left > x ? left - 2 : left + width + 2, place);
      canvas.stroke();
    }
    canvas.fillStyle = variable("--ink");
    canvas.textAlign = "left";
    canvas.fillText(text, left, place + 4);
  }
}

/** The height nearest to y at which a label of that width hides nothing; it is taken from then on. */
function freePlace(taken: Box[], area: Area, left: number, y: number, width: number): number {
  const half = 7;
  for (let k = 0; k < 60; ++k) {
    const at = y + half * (k % 2 ? (k + 1) / 2 : -k / 2);
    const box = { left: left - 2, right: left + width + 2, top: at - half, bottom: at + half };
    if (box.top < area.y || box.bottom > area.y + area.h) continue;
    if (taken.some((one) => one.left < box.right && box.left < one.right && one.top < box.bottom && box.top < one.bottom)) continue;
    taken.push(box);
    return at;
  }
  return y;
}

function errorTicks(): { v: number; label: string }[] {
  const powers = [-15, -12, -9, -6, -3, 0].map((power) => ({ v: power, label: power === 0 ? "1" : `1e${power}` }));
  return [{ v: EXACT, label: "none" }, ...powers];
}

