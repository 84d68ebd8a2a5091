import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("havok", "Havok: mesh shape, proximity and shape casts of a world", {
  async load() {
    const { readFileSync } = await import("node:fs"), { createRequire } = await import("node:module");
    const place = createRequire(import.meta.url).resolve("@babylonjs/havok").replace(/[^/]*$/, "HavokPhysics.wasm");
    return (await import("@babylonjs/havok")).default({ wasmBinary: readFileSync(place) });
  },
  make(H, vertices, triangles) {
    const points = H._malloc(4 * vertices.length), corners = H._malloc(4 * triangles.length);
    new Float32Array(H.HEAPU8.buffer, points, vertices.length).set(vertices);
    new Uint32Array(H.HEAPU8.buffer, corners, triangles.length).set(triangles);
    const [result, shape] = H.HP_Shape_CreateMesh(points, vertices.length / 3, corners, triangles.length / 3);
    [points, corners].forEach((data) => H._free(data));
    if (result !== H.Result.RESULT_OK) throw new Error("the shape cannot be made");
    const world = H.HP_World_Create()[1], body = H.HP_Body_Create()[1];
    H.HP_Body_SetShape(body, shape);
    H.HP_Body_SetMotionType(body, H.MotionType.STATIC);
    H.HP_World_AddBody(world, body, false);
    return { world, body, shape, hits: H.HP_QueryCollector_Create(1)[1], turn: [0, 0, 0, 1], nobody: [BigInt(0)] };
  },
  nearest(H, { world, hits, nobody }, center, reach) {
    H.HP_World_PointProximityWithCollector(world, hits, [center, reach, [~0, ~0], false, nobody]);
    if (H.HP_QueryCollector_GetNumHits(hits)[1] === 0) return null;
    const [distance, contact] = H.HP_QueryCollector_GetPointProximityResult(hits, 0)[1];
    return { point: contact[3], distance };
  },
  touches(H, { world, hits, turn, nobody }, center, radius) {
    const ball = H.HP_Shape_CreateSphere([0, 0, 0], radius)[1];
    H.HP_World_ShapeProximityWithCollector(world, hits, [ball, center, turn, 0, false, nobody]);
    H.HP_Shape_Release(ball);
    return H.HP_QueryCollector_GetNumHits(hits)[1] > 0;
  },
  first_hit(H, { world, hits, turn, nobody }, from, to, radius) {
    const ball = H.HP_Shape_CreateSphere([0, 0, 0], radius)[1];
    H.HP_World_ShapeCastWithCollector(world, hits, [ball, turn, from, to, false, nobody]);
    H.HP_Shape_Release(ball);
    if (H.HP_QueryCollector_GetNumHits(hits)[1] === 0) return null;
    const [fraction, , contact] = H.HP_QueryCollector_GetShapeCastResult(hits, 0)[1];
    return { fraction, point: contact[3] };
  },
  free(H, { world, body, shape, hits }) {
    H.HP_QueryCollector_Release(hits);
    H.HP_Body_Release(body);
    H.HP_Shape_Release(shape);
    H.HP_World_Release(world);
  },
});
