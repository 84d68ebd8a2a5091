// Volumes as lines in space: boxes by their edges, cylinders by two rings and four sides.
import { Rod, Visited, Volume } from "./visits";

export interface Outlines { corners: number[]; color: string; opacity: number }

const EDGES = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
const SIDES = 24;

/** Of each kind of volume; cylinders are told from boxes by their shape. */
export function colorsOf(dark: boolean): { boxes: string; groups: string; cells: string } {
  return dark ? { boxes: "#9ecbff", groups: "#ffd479", cells: "#b9f5c4" } : { boxes: "#0b4f9e", groups: "#8a4b00", cells: "#1c6b2f" };
}

/** Pairs of points, as three numbers each, with a colour that differs in brightness from the others', too. */
export function linesOf(seen: Visited, dark: boolean): Outlines[] {
  const strong = 0.95, faint = 0.3, { boxes, groups, cells } = colorsOf(dark);
  const both = (all: Volume[], color: string): Outlines[] => [
    { corners: all.filter((one) => one.entered).flatMap(edgesOf), color, opacity: strong },
    { corners: all.filter((one) => !one.entered).flatMap(edgesOf), color, opacity: faint }];
  return [...both(seen.boxes, boxes), ...both(seen.groups, groups), { corners: seen.cells.flatMap(edgesOf), color: cells, opacity: strong },
    { corners: seen.rods.filter((one) => one.entered).flatMap(ringsOf), color: boxes, opacity: strong },
    { corners: seen.rods.filter((one) => !one.entered).flatMap(ringsOf), color: boxes, opacity: faint }].filter((one) => one.corners.length > 0);
}

function edgesOf(box: Volume): number[] {
  const corner = (i: number) => [i & 1 ? box.max[0] : box.min[0], i & 2 ? box.max[1] : box.min[1], i & 4 ? box.max[2] : box.min[2]];
  return EDGES.flatMap(([a, b]) => [...corner(a), ...corner(b)]);
}

function ringsOf({ center, normal, radius, half }: Rod): number[] {
  const length = Math.hypot(...normal) || 1, n = normal.map((x) => x / length);
  const least = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs))), helper = [0, 1, 2].map((k) => (k === least ? 1 : 0));
  const cross = (a: number[], b: number[]) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const side = cross(n, helper), size = Math.hypot(...side), u = side.map((x) => x / size), v = cross(n, u);
  const at = (i: number, up: number) => {
    const angle = 2 * Math.PI * i / SIDES;
    return [0, 1, 2].map((k) => center[k] + up * half * n[k] + radius * (Math.cos(angle) * u[k] + Math.sin(angle) * v[k]));
  };
  const corners: number[] = [];
  for (let i = 0; i < SIDES; ++i) {
    for (const up of [-1, 1]) corners.push(...at(i, up), ...at(i + 1, up));
    if (i % (SIDES / 4) === 0) corners.push(...at(i, -1), ...at(i, 1));
  }
  return corners;
}
