import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("jolt", "Jolt: MeshShape, CollideShape and CastShape", {
  async load() {
    const J = await (await import("jolt-physics")).default(), settings = new J.JoltSettings();
    const layers = new J.BroadPhaseLayerInterfaceTable(1, 1), pairs = new J.ObjectLayerPairFilterTable(1);
    layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectLayerPairFilter = pairs;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
    new J.JoltInterface(settings); // without it shapes do not know each other
    return J;
  },
  make(J, vertices, triangles, fair) {
    const list = new J.TriangleList(), corner = new J.Triangle();
    triangles.forEach((v, k) => {
      const place = corner.get_mV(k % 3);
      [place.x, place.y, place.z] = vertices.subarray(3 * v, 3 * v + 3);
      if (k % 3 === 2) list.push_back(corner);
    });
    const made = new J.MeshShapeSettings(list).Create();
    if (made.HasError()) throw new Error(made.GetError().c_str());
    const mesh = new J.TransformedShape(), collide = new J.CollideShapeSettings(), cast = new J.ShapeCastSettings();
    mesh.mShape = made.Get();
    mesh.mShapeRotation = J.Quat.prototype.sIdentity();
    if (fair) {
      collide.mBackFaceMode = cast.mBackFaceModeTriangles = J.EBackFaceMode_CollideWithBackFaces;
      collide.mActiveEdgeMode = cast.mActiveEdgeMode = J.EActiveEdgeMode_CollideWithAll;
      cast.mReturnDeepestPoint = true;
    }
    return { mesh, collide, cast, one: new J.Vec3(1, 1, 1), zero: new J.RVec3(0, 0, 0), filter: new J.ShapeFilter() };
  },
  nearest(J, { mesh, collide, one, zero, filter }, center, reach) {
    const radius = 1e-3, ball = new J.SphereShape(radius), hits = new J.CollideShapeClosestHitCollisionCollector();
    const place = J.RMat44.prototype.sTranslation(new J.RVec3(...center));
    collide.mMaxSeparationDistance = reach;
    mesh.CollideShape(ball, one, place, collide, zero, hits, filter);
    const point = hits.mHit.mContactPointOn2;
    const found = hits.HadHit() ? { point: [point.GetX(), point.GetY(), point.GetZ()] } : null;
    J.destroy(hits);
    return found;
  },
  touches(J, { mesh, collide, one, zero, filter }, center, radius) {
    const ball = new J.SphereShape(radius), hits = new J.CollideShapeAnyHitCollisionCollector();
    const place = J.RMat44.prototype.sTranslation(new J.RVec3(...center));
    collide.mMaxSeparationDistance = 0;
    mesh.CollideShape(ball, one, place, collide, zero, hits, filter);
    const hit = hits.HadHit();
    J.destroy(hits);
    return hit;
  },
  first_hit(J, { mesh, cast, one, zero, filter }, from, to, radius) {
    const hits = new J.CastShapeClosestHitCollisionCollector(), way = new J.Vec3(...to.map((x, k) => x - from[k]));
    const place = J.RMat44.prototype.sTranslation(new J.RVec3(...from));
    mesh.CastShape(new J.RShapeCast(new J.SphereShape(radius), one, place, way), cast, zero, hits, filter);
    const { mFraction, mContactPointOn2: point } = hits.mHit;
    const found = hits.HadHit() ? { fraction: mFraction, point: [point.GetX(), point.GetY(), point.GetZ()] } : null;
    J.destroy(hits);
    return found;
  },
});
