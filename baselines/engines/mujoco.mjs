import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("mujoco", "MuJoCo: mj_geomDistance to a mesh geom, its convex hull", {
  load: async () => (await import("mujoco-js")).default(),
  make(M, vertices, triangles) {
    M.FS.writeFile("/model.xml", `<mujoco><asset><mesh name="m" inertia="shell" vertex="${vertices.join(" ")}"
      face="${triangles.join(" ")}"/></asset><worldbody><geom type="mesh" mesh="m"/>
      <body mocap="true"><geom type="sphere" size="1"/></body></worldbody></mujoco>`);
    const model = M.MjModel.loadFromXML("/model.xml");
    return { model, data: new M.MjData(model), ends: new M.DoubleBuffer(6) };
  },
  nearest(M, { model, data, ends }, center, reach) {
    const radius = 1e-3; // of the sphere that is asked in place of a point
    data.mocap_pos.set(center);
    model.geom_size[3] = radius;
    M.mj_kinematics(model, data);
    const distance = M.mj_geomDistance(model, data, 0, 1, reach, ends) + radius;
    return distance < reach ? { point: Array.from(ends.GetView().subarray(0, 3)), distance: Math.max(distance, 0) } : null;
  },
  touches(M, { model, data, ends }, center, radius) {
    data.mocap_pos.set(center);
    model.geom_size[3] = radius;
    M.mj_kinematics(model, data);
    return M.mj_geomDistance(model, data, 0, 1, radius, ends) <= 0;
  },
  free: (M, { model, data, ends }) => [data, model, ends].forEach((object) => object.delete()),
});
