// What the engines share: the form in which one is asked, the frame that it sees, and scripts that repeat a question.
// TOUCHMARK_ENGINE_FORM is "best" (fair settings, the mesh centred and scaled to 1,000 units), "as-is" (the same
// settings in the mesh's own units) or "default" (the engine's own settings, in the mesh's own units).
const form = process.env.TOUCHMARK_ENGINE_FORM ?? "best";
if (!["best", "as-is", "default"].includes(form)) throw new Error(`TOUCHMARK_ENGINE_FORM is '${form}': best, as-is or default`);
const tolerance = 1e-4; // of the mesh's diagonal: a contact or a distance that is off by less is not held against an engine

// The similarity from the mesh's coordinates to the engine's, and the tolerance in the former.
function frame_of(vertices, size = 1000) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  vertices.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  const diagonal = Math.hypot(...high.map((x, axis) => x - low[axis])), error = tolerance * diagonal;
  if (form !== "best" || diagonal === 0) return { origin: [0, 0, 0], scale: 1, error };
  return { origin: low.map((x, axis) => (x + high[axis]) / 2), scale: size / diagonal, error };
}

const into = ({ origin, scale }, p) => Array.from(p, (x, axis) => scale * (x - origin[axis]));
const placed = (frame, vertices) => vertices.map((x, i) => frame.scale * (x - frame.origin[i % 3]));

// The engine's answer in the mesh's coordinates. An engine that gives no distance gets that to its point.
function contact(frame, center, found) {
  const point = Array.from(found.point, (x, axis) => x / frame.scale + frame.origin[axis]);
  const away = point.map((x, axis) => center[axis] - x), length = Math.hypot(...away);
  const distance = found.distance === undefined ? length : found.distance / frame.scale;
  return { ...found, point, distance, normal: length > 0 ? away.map((x) => x / length) : [0, 0, 1], triangle: found.triangle ?? null };
}

// `engine` has load(), make(E, vertices, triangles, fair) and some of nearest, touches and first_hit, each called with
// E, what make() returned, the arguments of docs/plugins.md as plain numbers, and `fair`; perhaps free(E, made), and
// `size`, to which the best form scales. None may use anything else, since their source is the reproducer.
export function contestant(name, summary, engine) {
  const fair = form !== "default", queries = ["nearest", "touches", "first_hit"].filter((query) => engine[query]);
  return {
    name: form === "best" ? name : `${name}-${form}`,
    summary,
    guarantee: "approximate",
    async build(vertices, triangles) {
      const frame = frame_of(vertices, engine.size), E = await engine.load();
      const made = engine.make(E, placed(frame, vertices), triangles, fair);
      const ask = {
        nearest(center, reach) {
          const found = engine.nearest(E, made, into(frame, center), Math.min(frame.scale * reach, 1e9), fair);
          const answer = found && contact(frame, center, found);
          return answer && answer.distance <= reach ? answer : null;
        },
        touches: (center, radius) => engine.touches(E, made, into(frame, center), frame.scale * radius, fair),
        first_hit(from, to, radius) {
          const hit = engine.first_hit(E, made, into(frame, from), into(frame, to), frame.scale * radius, fair);
          return hit && contact(frame, from.map((x, axis) => x + hit.fraction * (to[axis] - x)), hit);
        },
      };
      return { ...Object.fromEntries(queries.map((query) => [query, ask[query]])), error: frame.error, destroy: () => engine.free?.(E, made) };
    },
    reproduce(vertices, triangles, query) {
      const frame = frame_of(vertices, engine.size), at = (p) => JSON.stringify(into(frame, p));
      const { center, from, to } = query, length = (x) => Math.min(frame.scale * x, 1e9);
      const asked = { nearest: () => [at(center), length(query.reach)], touches: () => [at(center), length(query.radius)],
        first_hit: () => [at(from), at(to), length(query.radius)] }[query.query]().join(", ");
      return `// Run it below a folder where package.json of Touchmark's baselines/engines is installed.
const load = ${method(engine.load)};
const make = ${method(engine.make)};
const ask = ${method(engine[query.query])};
const E = await load(), fair = ${fair}, vertices = new Float64Array([${placed(frame, vertices).join(", ")}]);
const made = make(E, vertices, new Uint32Array([${triangles.join(", ")}]), fair);
console.log(ask(E, made, ${asked}, fair));
`;
    },
  };
}

// The source of a method, or of a function, as an expression.
const method = (f) => String(f).replace(/^(async )?(?=\w+\()/, "$1function ");
