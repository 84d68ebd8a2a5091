import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("three-mesh-bvh", "three-mesh-bvh: closestPointToPoint", {
  async load() {
    return { ...(await import("three")), ...(await import("three-mesh-bvh")) };
  },
  make(T, vertices, triangles, fair) {
    const geometry = new T.BufferGeometry(); // its arrays may be of doubles, which are then rounded nowhere
    geometry.setAttribute("position", new T.BufferAttribute(fair ? vertices : new Float32Array(vertices), 3));
    geometry.setIndex(new T.BufferAttribute(triangles, 1));
    return new T.MeshBVH(geometry, { indirect: true }); // the order of the triangles stays
  },
  nearest(T, bvh, center, reach) {
    const found = bvh.closestPointToPoint(new T.Vector3(...center), {}, 0, reach);
    return found && { point: found.point.toArray(), distance: found.distance, triangle: found.faceIndex };
  },
  touches: (T, bvh, center, radius) => bvh.intersectsSphere(new T.Sphere(new T.Vector3(...center), radius)),
});
