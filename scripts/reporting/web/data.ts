// What the page was given: JSON, and arrays in one compressed stream.
import type { PackedVisits } from "./visits";

/** [offset, items, type, how often differences were taken] */
export type Packed = [number, number, string, number];

export interface Look { name: string; color: string; dash: number[] }
export interface Row {
  name: string; trajectory: string; fields: Record<string, string>; ns: number | null; ratio: number | null;
  words: string; failed: boolean; wrong: number;
}
export interface PackedContestant {
  name: string; repeat: string; ranges: [number, number][]; levels: number; ns: Packed; lowNs: number; highNs: number;
  work: Packed; lowWork: number; highWork: number; differs: Packed; charged: Packed; wrong: number; asked: Packed;
  notedNs: Packed; answers: Packed;
}
export interface PackedTrace {
  trajectory: string; query: string; steps: number; radius: number; reach: number | string; low: number[]; high: number[];
  position: Packed[]; point: Packed[]; state: Packed; triangle: Packed; largestDistance: number; distance: Packed;
  noted: { steps: Packed; probes: Packed; truthDistance: Packed; counts: Packed; around: Packed; answers: Packed };
  contestants: PackedContestant[];
}
export interface PackedMesh {
  name: string; triangles: number; diagonal: number; low: number[]; high: number[]; drawnTriangles: number;
  drawnLow: number[]; drawnHigh: number[]; vertices: Packed[]; corners: Packed; nearIds: Packed; nearCorners: Packed;
  nearVertices: Packed;
}
export interface Recording {
  name: string; trajectories: string[]; contestants: Look[]; rows: Row[];
  replay: { mesh: PackedMesh; traces: PackedTrace[] } | null; visits: PackedVisits | null; resolution: number;
}
export interface PageData { recordings: Recording[]; charges: string[] }

type Numbers = Uint8Array | Uint16Array | Uint32Array | Float32Array | Float64Array;

/** What loader.js has unpacked. */
export interface Unpacked { data: PageData; arrays: Uint8Array; tell: (error: unknown) => void }
declare global { interface Window { touchmark: Unpacked } }

const WIDTHS: Record<string, number> = { u8: 1, u16: 2, u32: 4, f32: 4, f64: 8, b64: 8 };

export function unpacked(stream: Uint8Array, packed: Packed): Numbers {
  const [offset, items, type, order] = packed, width = WIDTHS[type];
  const bytes = new Uint8Array(items * width);
  for (let plane = 0; plane < width; ++plane) {
    const from = offset + plane * items;
    for (let i = 0; i < items; ++i) bytes[i * width + plane] = stream[from + i];
  }
  const buffer = bytes.buffer;
  const numbers: Numbers = type === "u8" ? bytes : type === "u16" ? new Uint16Array(buffer) : type === "u32" ? new Uint32Array(buffer)
    : type === "f32" ? new Float32Array(buffer) : new Float64Array(buffer);
  // Differences carry their sign in the lowest bit.
  if (order) for (let i = 0; i < items; ++i) numbers[i] = (numbers[i] >>> 1) ^ -(numbers[i] & 1);
  for (let k = 0; k < order; ++k) for (let i = 1; i < items; ++i) numbers[i] += numbers[i - 1];
  return numbers;
}

/** Sixteen bits an axis. */
function levelsOf(stream: Uint8Array, axes: Packed[]): Uint16Array[] { return axes.map((axis) => unpacked(stream, axis) as Uint16Array); }

/** (n, 3) places from 16 bits an axis; NaN where there is none. */
function places(axes: Uint16Array[], low: number[], high: number[]): Float32Array {
  const count = axes[0].length, result = new Float32Array(3 * count);
  axes.forEach((levels, k) => {
    const step = (high[k] - low[k]) / 65534;
    for (let i = 0; i < count; ++i) result[3 * i + k] = levels[i] === 65535 ? NaN : low[k] + levels[i] * step;
  });
  return result;
}

/** One contestant on one trajectory. */
export class Series {
  readonly ns: Float32Array;  // by step; NaN where it was not asked
  readonly workLevel: Uint8Array;
  readonly charged: Uint8Array;
  readonly found: Uint8Array;  // 2: not asked
  readonly wrong: number[] = [];  // steps
  readonly asked: Int32Array;  // steps that it was asked
  private readonly answers: Float64Array;
  private readonly notedNs: Float32Array;
  private readonly placeOfNoted: Int32Array;

  constructor(stream: Uint8Array, readonly about: PackedContestant, readonly trace: Trace) {
    const steps = trace.steps, levels = unpacked(stream, about.ns), work = unpacked(stream, about.work);
    const differs = unpacked(stream, about.differs), charged = unpacked(stream, about.charged);
    this.ns = new Float32Array(steps).fill(NaN);
    this.workLevel = new Uint8Array(steps);
    this.charged = new Uint8Array(steps);
    this.found = new Uint8Array(steps).fill(2);
    this.asked = new Int32Array(levels.length);
    const slope = Math.log(about.highNs / about.lowNs) / (about.levels - 1);
    let place = 0;
    for (const [begin, end] of about.ranges) {
      for (let step = begin; step < end; ++step, ++place) {
        this.asked[place] = step;
        this.ns[step] = levels[place] === about.levels - 1 ? about.highNs : about.lowNs * Math.exp(slope * levels[place]);
        this.workLevel[step] = work[place];
        this.charged[step] = charged[place];
        if (charged[place]) this.wrong.push(step);
        this.found[step] = differs[place] ^ (trace.state[step] >> 1);
      }
    }
    const asked = unpacked(stream, about.asked);
    this.notedNs = unpacked(stream, about.notedNs) as Float32Array;
    this.placeOfNoted = new Int32Array(asked.length);
    let noted = 0;
    for (let i = 0; i < asked.length; ++i) this.placeOfNoted[i] = asked[i] ? noted++ : -1;
    this.answers = unpacked(stream, about.answers) as Float64Array;
    const bits = new Uint32Array(this.answers.buffer);  // in which they differ from the usual ones
    this.placeOfNoted.forEach((at, i) => { for (let k = 0; at >= 0 && k < 16; ++k) bits[16 * at + k] ^= trace.usualAnswers[16 * i + k]; });
  }

  get name(): string { return this.about.name; }

  work(step: number): number {
    const { lowWork, highWork, levels } = this.about;
    return Math.round(lowWork * Math.exp(Math.log(highWork / lowWork) * this.workLevel[step] / (levels - 1)));
  }

  /** Its time at a noted step, to seven digits. */
  notedTime(noted: number): number | null {
    const place = this.placeOfNoted[noted] ?? -1;
    return place < 0 ? null : this.notedNs[place];
  }

  /** What it answered at a noted step. */
  answer(noted: number): { distance: number; point: number[]; normal: number[]; fraction: number } | null {
    const place = this.placeOfNoted[noted] ?? -1;
    if (place < 0) return null;
    const one = this.answers.subarray(8 * place, 8 * place + 8);
    return { distance: one[0], point: [one[1], one[2], one[3]], normal: [one[4], one[5], one[6]], fraction: one[7] };
  }

  /** The slowest steps of those in [begin, end), slowest first, with exact times where they are noted. */
  slowest(count: number, begin: number, end: number): number[] {
    const time = (step: number) => this.exactTime(step);
    const steps = Array.from(this.asked).filter((step) => step >= begin && step < end);
    const cut = steps.map((step) => this.ns[step]).sort((a, b) => b - a)[Math.min(steps.length, 4 * count) - 1] ?? 0;
    return steps.filter((step) => this.ns[step] >= cut).sort((a, b) => time(b) - time(a) || a - b).slice(0, count);
  }

  /** Exact where the step is noted, else as exact as curves are. */
  exactTime(step: number): number {
    const noted = this.trace.notedAt.get(step);
    return (noted === undefined ? null : this.notedTime(noted)) ?? this.ns[step];
  }
}

/** One trajectory with all contestants on it. */
export class Trace {
  readonly state: Uint8Array;
  readonly position: Float32Array;
  readonly point: Float32Array;
  readonly triangle: Uint32Array;
  readonly notedSteps: Uint32Array;
  readonly notedAt = new Map<number, number>();
  readonly series: Series[];
  readonly usualAnswers: Uint32Array;  // bits, 16 words a noted step
  private readonly distances: Uint16Array;
  private readonly truthDistance: Float64Array;
  private readonly probes: Float64Array;
  private readonly around: Uint32Array;
  private readonly aroundBegin: number[] = [0];

  constructor(stream: Uint8Array, readonly about: PackedTrace) {
    const { low, high, noted } = about;
    this.state = unpacked(stream, about.state) as Uint8Array;
    const centers = levelsOf(stream, about.position), points = levelsOf(stream, about.point);
    points.forEach((axis, k) => { for (let i = 0; i < axis.length; ++i) axis[i] += centers[k][i]; });
    this.position = places(centers, low, high);
    this.point = places(points, low, high);
    this.triangle = unpacked(stream, about.triangle) as Uint32Array;
    this.distances = unpacked(stream, about.distance) as Uint16Array;
    this.notedSteps = unpacked(stream, noted.steps) as Uint32Array;
    this.notedSteps.forEach((step, i) => this.notedAt.set(step, i));
    this.truthDistance = unpacked(stream, noted.truthDistance) as Float64Array;
    this.probes = unpacked(stream, noted.probes) as Float64Array;
    this.around = unpacked(stream, noted.around) as Uint32Array;
    unpacked(stream, noted.counts).forEach((count: number) => this.aroundBegin.push(this.aroundBegin[this.aroundBegin.length - 1] + count));
    this.usualAnswers = new Uint32Array(unpacked(stream, noted.answers).buffer);
    this.series = about.contestants.map((one) => new Series(stream, one, this));
  }

  get steps(): number { return this.about.steps; }
  get name(): string { return this.about.trajectory; }
  known(step: number): boolean { return (this.state[step] & 1) > 0; }
  found(step: number): boolean { return (this.state[step] & 2) > 0; }

  /** The true distance: exact where the step is noted, else to 1/65535 of the largest. */
  distance(step: number): number {
    const noted = this.notedAt.get(step);
    return noted === undefined ? this.distances[step] / 65534 * this.about.largestDistance : this.truthDistance[noted];
  }

  /** Centre, radius and reach of a noted step, as they are stored. */
  probe(noted: number): { center: number[]; radius: number; reach: number } {
    const one = this.probes.subarray(5 * noted, 5 * noted + 5);
    return { center: [one[0], one[1], one[2]], radius: one[3], reach: one[4] };
  }

  /** The triangles around a noted step's probe, by their places in the mesh's near triangles. */
  near(noted: number): Uint32Array {
    return this.around.subarray(this.aroundBegin[noted], this.aroundBegin[noted + 1]);
  }
  named(name: string): Series | undefined { return this.series.find((one) => one.name === name); }
}

export class Mesh {
  readonly vertices: Float32Array;
  readonly corners: Uint32Array;
  readonly nearIds: Uint32Array;
  readonly nearCorners: Uint32Array;
  readonly nearVertices: Float64Array;
  constructor(stream: Uint8Array, readonly about: PackedMesh) {
    this.vertices = places(levelsOf(stream, about.vertices), about.drawnLow, about.drawnHigh);
    this.corners = unpacked(stream, about.corners) as Uint32Array;
    this.nearIds = unpacked(stream, about.nearIds) as Uint32Array;
    this.nearCorners = unpacked(stream, about.nearCorners) as Uint32Array;
    this.nearVertices = unpacked(stream, about.nearVertices) as Float64Array;
  }
}
