import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("jolt", "Jolt: MeshShape, CollideShape and CastShape", {
  async load() {
    const J = await (await import("jolt-physics")).default(), settings = new J.JoltSettings();
    const layers = new J.BroadPhaseLayerInterfaceTable(1, 1), pairs = new J.ObjectLayerPairFilterTable(1);
    layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
    const filter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
    Object.assign(settings, { mBroadPhaseLayerInterface: layers, mObjectLayerPairFilter: pairs, mObjectVsBroadPhaseLayerFilter: filter });
    new J.JoltInterface(settings); // without it shapes do not know each other
    return J;
  },
  make(J, vertices, triangles, fair) {
    const list = new J.TriangleList(), corner = (v) => new J.Vec3(...vertices.subarray(3 * v, 3 * v + 3));
    for (let k = 0; k < triangles.length; k += 3) list.push_back(new J.Triangle(...Array.from(triangles.subarray(k, k + 3), corner)));
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
    const near = new J.CollideShapeClosestHitCollisionCollector(), first = new J.CastShapeClosestHitCollisionCollector();
    const at = (p) => J.RMat44.prototype.sTranslation(new J.RVec3(...p)), one = new J.Vec3(1, 1, 1), zero = new J.RVec3(0, 0, 0);
    return { mesh, collide, cast, near, first, at, one, zero, filter: new J.ShapeFilter() };
  },
  nearest(J, { mesh, collide, near, at, one, zero, filter }, center, reach) {
    collide.mMaxSeparationDistance = reach;
    near.Reset();
    mesh.CollideShape(new J.SphereShape(1e-3), one, at(center), collide, zero, near, filter);
    const point = near.mHit.mContactPointOn2;
    return near.HadHit() ? { point: [point.GetX(), point.GetY(), point.GetZ()] } : null;
  },
  touches(J, { mesh, collide, near, at, one, zero, filter }, center, radius) {
    collide.mMaxSeparationDistance = 0;
    near.Reset();
    mesh.CollideShape(new J.SphereShape(radius), one, at(center), collide, zero, near, filter);
    return near.HadHit();
  },
  first_hit(J, { mesh, cast, first, at, one, zero, filter }, from, to, radius) {
    const way = new J.Vec3(...to.map((x, k) => x - from[k]));
    first.Reset();
    mesh.CastShape(new J.RShapeCast(new J.SphereShape(radius), one, at(from), way), cast, zero, first, filter);
    const { mFraction: fraction, mContactPointOn2: point } = first.mHit;
    return first.HadHit() ? { fraction, point: [point.GetX(), point.GetY(), point.GetZ()] } : null;
  },
});
