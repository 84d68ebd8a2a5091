// What our detectors looked at in steps worth a look: groups and cells, boxes, cylinders, triangles.
import { Packed, unpacked } from "./data";

interface PackedRow {
  name: string; trajectory: string; steps: Packed; leftOut: number[]; counts: Record<string, Packed>; places: Record<string, Packed[]>;
  entered: Record<string, Packed>; members: Packed; cylinders: Packed[]; triangleCounts: Packed; triangles: Packed;
}
export interface PackedVisits { low: number[]; high: number[]; longest: number; rows: PackedRow[] }

export interface Volume { min: number[]; max: number[]; entered: boolean; members: number }
export interface Rod { center: number[]; normal: number[]; radius: number; half: number; entered: boolean }
/** What one query looked at, in the mesh's units. */
export interface Visited { cells: Volume[]; groups: Volume[]; boxes: Volume[]; rods: Rod[]; triangles: number[]; leftOut: number }

const TOP = 65535;

/** All that is known, by contestant, trajectory and step. */
export class Visits {
  private readonly known = new Map<string, Visited>();

  constructor(stream: Uint8Array, private readonly about: PackedVisits) {
    for (const row of about.rows) this.read(stream, row);
  }

  at(name: string, trajectory: string, step: number): Visited | undefined { return this.known.get(this.key(name, trajectory, step)); }
  /** Is anything known of this contestant? */
  of(name: string): boolean { return this.about.rows.some((row) => row.name === name); }

  private key(name: string, trajectory: string, step: number): string { return JSON.stringify([name, trajectory, step]); }

  private read(stream: Uint8Array, row: PackedRow): void {
    const steps = unpacked(stream, row.steps), { low, high, longest } = this.about;
    const place = (level: number, axis: number) => low[axis] + level / TOP * (high[axis] - low[axis]);
    const volumes = (kind: string) => {
      const axes = row.places[kind].map((one) => unpacked(stream, one)), entered = row.entered[kind] && unpacked(stream, row.entered[kind]);
      const members = kind === "groups" ? unpacked(stream, row.members) : null;
      return Array.from(axes[0], (_, i): Volume => ({
        min: [0, 1, 2].map((k) => place(axes[k][i], k)), max: [0, 1, 2].map((k) => place(axes[k + 3][i], k)),
        entered: !entered || entered[i] === 1, members: members ? members[i] : 0,
      }));
    };
    const numbers = row.cylinders.map((one) => unpacked(stream, one)), within = unpacked(stream, row.entered.cylinders);
    const rods = Array.from(numbers[0], (_, i): Rod => ({
      center: [0, 1, 2].map((k) => place(numbers[k][i], k)), normal: [3, 4, 5].map((k) => numbers[k][i] / TOP * 2 - 1),
      radius: numbers[6][i] / TOP * longest, half: numbers[7][i] / TOP * longest, entered: within[i] === 1,
    }));
    const cells = volumes("cells"), groups = volumes("groups"), boxes = volumes("boxes");
    const triangles = Array.from(unpacked(stream, row.triangles)), counts = Object.fromEntries(Object.entries(row.counts).map(([kind, one]) => [kind, unpacked(stream, one)]));
    const triangleCounts = unpacked(stream, row.triangleCounts), taken = { cells: 0, groups: 0, boxes: 0, cylinders: 0, triangles: 0 };
    const take = <T>(all: T[], kind: keyof typeof taken, count: number): T[] => { taken[kind] += count; return all.slice(taken[kind] - count, taken[kind]); };
    steps.forEach((step: number, i: number) => this.known.set(this.key(row.name, row.trajectory, step), {
      cells: take(cells, "cells", counts.cells[i]), groups: take(groups, "groups", counts.groups[i]), boxes: take(boxes, "boxes", counts.boxes[i]),
      rods: take(rods, "cylinders", counts.cylinders[i]), triangles: take(triangles, "triangles", triangleCounts[i]), leftOut: row.leftOut[i],
    }));
  }
}

const many = (count: number, one: string, more = one + "s"): string => `${count.toLocaleString("en-US")} ${count === 1 ? one : more}`;

/** In words. */
export function wordsOf(seen: Visited): string {
  const entered = (all: { entered: boolean }[]) => all.filter((one) => one.entered).length, parts: string[] = [];
  if (seen.cells.length) parts.push(many(seen.cells.length, "cell"));
  if (seen.groups.length) {
    const covering = seen.groups.filter((one) => one.entered);
    parts.push(`${many(seen.groups.length, "group")} (${covering.length ? `of ${many(covering[covering.length - 1].members, "triangle")}, covers the probe` : "none covers the probe"})`);
  }
  if (seen.boxes.length) parts.push(`${many(seen.boxes.length, "box", "boxes")} (${entered(seen.boxes)} near enough)`);
  if (seen.rods.length) parts.push(`${many(seen.rods.length, "cylinder")} around spheres’ clusters (${entered(seen.rods)} near enough)`);
  parts.push(`${many(seen.triangles.length, "triangle")} in double precision`);
  const left = seen.leftOut ? ` ${seen.leftOut.toLocaleString("en-US")} more are not kept.` : "";
  return parts.length > 1 || seen.triangles.length ? `Looked at ${parts.join(", ")}.${left}` : "Looked at no volume: what it remembered of the steps before was enough, or few samples of the distance.";
}
