import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("rapier", "Rapier: triangle mesh, queries of a collider", {
  async load() {
    const R = (await import("@dimforge/rapier3d-compat")).default;
    await R.init();
    return R;
  },
  make(R, vertices, triangles) {
    const world = new R.World({ x: 0, y: 0, z: 0 });
    return { world, mesh: world.createCollider(R.ColliderDesc.trimesh(new Float32Array(vertices), triangles)) };
  },
  nearest(R, { mesh }, [x, y, z]) {
    const { point } = mesh.projectPoint({ x, y, z }, false);
    return { point: [point.x, point.y, point.z] };
  },
  touches(R, { mesh }, [x, y, z], radius) {
    return mesh.intersectsShape(new R.Ball(radius), { x, y, z }, { x: 0, y: 0, z: 0, w: 1 });
  },
  first_hit(R, { mesh }, [x, y, z], to, radius) {
    const way = { x: to[0] - x, y: to[1] - y, z: to[2] - z }, stands = { x: 0, y: 0, z: 0 };
    const hit = mesh.castShape(stands, new R.Ball(radius), { x, y, z }, { ...stands, w: 1 }, way, 0, 1, true);
    return hit && { fraction: hit.time_of_impact, point: [hit.witness1.x, hit.witness1.y, hit.witness1.z] };
  },
  free: (R, { world }) => world.free(),
});
