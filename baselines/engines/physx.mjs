import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("physx", "PhysX: triangle mesh, PxGeometryQuery", {
  async load() {
    const { readFileSync } = await import("node:fs"), { createRequire } = await import("node:module");
    const { default: PhysX } = await import("physx-js-webidl"), { process } = globalThis;
    const wasmBinary = readFileSync(createRequire(import.meta.url).resolve("physx-js-webidl/physx-js-webidl.wasm"));
    Object.assign(globalThis, { window: globalThis, process: undefined }); // it starts in a browser alone
    const loading = PhysX({ wasmBinary });
    globalThis.process = process;
    const P = await loading;
    P.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
    return P;
  },
  make(P, vertices, triangles, fair) {
    const desc = new P.PxTriangleMeshDesc(), cooking = new P.PxCookingParams(new P.PxTolerancesScale());
    const points = P._malloc(4 * vertices.length), corners = P._malloc(4 * triangles.length);
    new Float32Array(P.HEAPU8.buffer, points, vertices.length).set(vertices);
    new Uint32Array(P.HEAPU8.buffer, corners, triangles.length).set(triangles);
    Object.assign(desc.points, { count: vertices.length / 3, stride: 12, data: points });
    Object.assign(desc.triangles, { count: triangles.length / 3, stride: 12, data: corners });
    const mesh = P.CreateTriangleMesh(cooking, desc);
    if (!mesh) throw new Error("the mesh cannot be cooked");
    const sides = new P.PxMeshGeometryFlags(fair ? P.PxMeshGeometryFlagEnum.eDOUBLE_SIDED : 0);
    const geometry = new P.PxTriangleMeshGeometry(mesh, new P.PxMeshScale(1), sides);
    const [here, place] = [0, 1].map(() => new P.PxTransform(P.PxIDENTITYEnum.PxIdentity)), F = P.PxHitFlagEnum;
    const flags = new P.PxHitFlags(F.eDEFAULT | (fair ? F.eMESH_BOTH_SIDES | F.ePRECISE_SWEEP : 0));
    return { mesh, geometry, here, place, flags, hit: new P.PxSweepHit(), point: new P.PxVec3(), way: new P.PxVec3() };
  },
  nearest(P, { geometry, here, point, way: closest }, center) {
    [point.x, point.y, point.z] = center;
    const square = P.PxGeometryQuery.prototype.pointDistance(point, geometry, here, closest);
    return square < 0 ? null : { point: square > 0 ? [closest.x, closest.y, closest.z] : center };
  },
  touches(P, { geometry, here, place }, [x, y, z], radius) {
    Object.assign(place.p, { x, y, z });
    const ball = new P.PxSphereGeometry(radius);
    const touching = P.PxGeometryQuery.prototype.overlap(ball, place, geometry, here);
    P.destroy(ball);
    return touching;
  },
  first_hit(P, { geometry, here, place, flags, hit, way }, [x, y, z], to, radius) {
    const step = [to[0] - x, to[1] - y, to[2] - z], length = Math.hypot(...step), ball = new P.PxSphereGeometry(radius);
    Object.assign(place.p, { x, y, z });
    [way.x, way.y, way.z] = length > 0 ? step.map((s) => s / length) : [1, 0, 0];
    const hits = P.PxGeometryQuery.prototype.sweep(way, length, ball, place, geometry, here, hit, flags), at = hit.position;
    P.destroy(ball);
    return hits ? { fraction: length > 0 ? hit.distance / length : 0, point: [at.x, at.y, at.z] } : null;
  },
  free: (P, { mesh }) => mesh.release(),
});
