import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("ammo", "Bullet by ammo.js: btBvhTriangleMeshShape, contactPairTest", {
  async load() {
    const { createRequire } = await import("node:module");
    return createRequire(import.meta.url)("ammojs-typed")();
  },
  make(A, vertices, triangles, fair) {
    const mesh = new A.btTriangleMesh(true, false), corner = [0, 1, 2].map(() => new A.btVector3());
    for (let k = 0; k < triangles.length; k += 3) {
      corner.forEach((place, j) => place.setValue(...vertices.subarray(3 * triangles[k + j], 3 * triangles[k + j] + 3)));
      mesh.addTriangle(...corner, false);
    }
    const bodies = ["mesh", "ball"].map(() => new A.btPairCachingGhostObject());
    bodies[0].setCollisionShape(new A.btBvhTriangleMeshShape(mesh, true, true));
    if (fair) bodies[0].getCollisionShape().setMargin(0); // 0.04 units of its own
    const settings = new A.btDefaultCollisionConfiguration(), parts = [new A.btCollisionDispatcher(settings), new A.btDbvtBroadphase()];
    const world = new A.btDiscreteDynamicsWorld(...parts, new A.btSequentialImpulseConstraintSolver(), settings);
    world.addCollisionObject(bodies[0]);
    return { world, bodies, place: new A.btTransform() };
  },
  touches(A, { world, bodies, place }, center, radius) {
    const ball = new A.btSphereShape(radius), callback = new A.ConcreteContactResultCallback();
    let touching = false;
    callback.addSingleResult = (point) => {
      touching ||= A.wrapPointer(point, A.btManifoldPoint).getDistance() <= 0;
      return 0;
    };
    place.setIdentity();
    place.getOrigin().setValue(...center);
    bodies[1].setCollisionShape(ball);
    bodies[1].setWorldTransform(place);
    world.contactPairTest(bodies[0], bodies[1], callback);
    [ball, callback].forEach(A.destroy);
    return touching;
  },
  first_hit(A, { world }, from, to, radius) {
    const ball = new A.btSphereShape(radius), ends = [from, to].map((p) => new A.btVector3(...p));
    const places = ends.map((origin) => {
      const place = new A.btTransform();
      place.setIdentity();
      place.setOrigin(origin);
      return place;
    });
    const callback = new A.ClosestConvexResultCallback(...ends);
    world.convexSweepTest(ball, ...places, callback, 0);
    const point = callback.m_hitPointWorld, fraction = callback.m_closestHitFraction;
    const found = callback.hasHit() ? { fraction, point: [point.x(), point.y(), point.z()] } : null;
    [callback, ...places, ...ends, ball].forEach(A.destroy);
    return found;
  },
});
