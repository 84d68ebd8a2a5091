import { contestant } from "./lib/engine.mjs";

export const { name, summary, guarantee, build, reproduce } = contestant("mujoco-sdf", "MuJoCo: contacts of a sphere with an SDF geom", {
  size: 1, // where the search finds most: it steps by lengths of its own
  load: async () => (await import("mujoco-js")).default(),
  make(M, vertices, triangles, fair) {
    const search = fair ? 'sdf_iterations="50"' : ""; // 10 otherwise
    M.FS.writeFile("/model.xml", `<mujoco><option ${search}/><asset><mesh name="m" inertia="shell" vertex="${vertices.join(" ")}"
      face="${triangles.join(" ")}"/></asset><worldbody><geom type="sdf" mesh="m"/>
      <body><freejoint/><geom type="sphere" size="1"/></body></worldbody></mujoco>`);
    const model = M.MjModel.loadFromXML("/model.xml");
    return { model, data: new M.MjData(model) };
  },
  touches(M, { model, data }, center, radius) {
    data.qpos.set(center);
    model.geom_size[3] = model.geom_rbound[1] = radius;
    M.mj_kinematics(model, data);
    M.mj_comPos(model, data);
    M.mj_collision(model, data);
    for (let k = 0; k < data.ncon; k++) if (data.contact.get(k).dist <= 0) return true;
    return false;
  },
  free: (M, { model, data }) => [data, model].forEach((object) => object.delete()),
});
