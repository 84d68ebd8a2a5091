// A detector in JavaScript: every triangle, every time.
export const name = "mine-js";
export const summary = "every triangle, in JavaScript";
export const guarantee = "approximate"; // or "exact", "conservative": what is claimed is held against it

const minus = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
const along = (p, d, t) => [p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]];

// The nearest point of the segment from `start` by `d`.
function on_edge(center, start, d) {
  const square = dot(d, d);
  const t = square > 0 ? dot(minus(center, start), d) / square : 0;
  return along(start, d, Math.min(Math.max(t, 0), 1));
}

// Points of a triangle that may be the nearest one: that of the plane where it is inside, or those of the edges.
function candidates(center, { a, b, ab, ac, bc }) {
  const ap = minus(center, a), [aa, mixed, cc] = [dot(ab, ab), dot(ab, ac), dot(ac, ac)];
  const [pb, pc] = [dot(ap, ab), dot(ap, ac)], area = aa * cc - mixed * mixed;
  const [u, v] = [(cc * pb - mixed * pc) / area, (aa * pc - mixed * pb) / area];
  if (u >= 0 && v >= 0 && u + v <= 1) return [along(along(a, ab, u), ac, v)];
  return [on_edge(center, a, ab), on_edge(center, a, ac), on_edge(center, b, bc)];
}

// Called with a Float64Array, three numbers a vertex, and a Uint32Array, three vertices a triangle, which are its to
// keep. It may be async, for an engine that is still being loaded; the queries may not.
export function build(vertices, triangles) {
  const vertex = (corner) => Array.from(vertices.subarray(3 * triangles[corner], 3 * triangles[corner] + 3));
  const faces = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [vertex(i), vertex(i + 1), vertex(i + 2)];
    faces.push({ a, b, ab: minus(b, a), ac: minus(c, a), bc: minus(c, b) });
  }

  // Null where nothing is within the reach; the triangle may be null as well. `center` is a Float64Array(3).
  function nearest(center, reach) {
    let best = { square: Infinity };
    faces.forEach((face, triangle) => {
      for (const point of candidates(center, face)) {
        const away = minus(center, point), square = dot(away, away);
        if (square < best.square) best = { square, point, away, triangle };
      }
    });
    const distance = Math.sqrt(best.square);
    if (!(distance <= reach)) return null;
    const face = faces[best.triangle], normal = distance > 0 ? best.away : cross(face.ab, face.ac);
    const length = Math.hypot(...normal);
    return { point: best.point, normal: normal.map((x) => x / length), distance, triangle: best.triangle };
  }

  return {
    error: 1e-12, // by how much a distance may be off, in mesh units; leave it out where you do not know
    nbytes: 15 * 8 * faces.length,
    nearest,
    touches: (center, radius) => nearest(center, radius) !== null,
  };
}
