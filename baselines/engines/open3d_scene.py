"""Open3D: closest points of a RaycastingScene."""
import os

import numpy as np
import open3d as o3d

form = os.environ.get("TOUCHMARK_ENGINE_FORM", "best")
name = "open3d" if form == "best" else f"open3d-{form}"
summary = "Open3D: RaycastingScene.compute_closest_points"
guarantee = "approximate"
SCRIPT = """import numpy as np
import open3d as o3d

scene = o3d.t.geometry.RaycastingScene()
scene.add_triangles(o3d.core.Tensor(np.array({vertices}, dtype=np.float32)), o3d.core.Tensor(np.array({triangles}, dtype=np.uint32)))
center = np.array({center})
point = scene.compute_closest_points(o3d.core.Tensor([center.tolist()], o3d.core.float32))["points"].numpy()[0]
print("distance:", np.linalg.norm(center - point), "{wanted}:", {limit})
"""


def frame(vertices):
    """(origin, scale, error): best is the mesh centred and scaled to 1,000 units, as lib/engine.mjs has it."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    diagonal = np.linalg.norm(high - low)
    return (*(((low + high) / 2, 1000 / diagonal) if form == "best" and diagonal > 0 else (np.zeros(3), 1.0)), 1e-4 * diagonal)


class Detector:
    def __init__(self, vertices, faces):
        self.origin, self.scale, self.error = frame(vertices)
        self.scene = o3d.t.geometry.RaycastingScene()
        placed = np.ascontiguousarray((self.scale * (vertices - self.origin)).astype(np.float32))
        self.scene.add_triangles(o3d.core.Tensor(placed), o3d.core.Tensor(np.array(faces)))

    def nearest(self, center, reach):
        at = self.scale * (center - self.origin)
        found = self.scene.compute_closest_points(o3d.core.Tensor([at.tolist()], o3d.core.float32))
        away = at - found["points"].numpy()[0]
        distance = float(np.linalg.norm(away))
        if not distance <= self.scale * reach:
            return None
        normal = away / distance if distance > 0 else np.array([0.0, 0, 1])
        return center - away / self.scale, normal, distance / self.scale, int(found["primitive_ids"].numpy()[0])

    def touches(self, center, radius):
        return self.nearest(center, radius) is not None


def reproduce(vertices, triangles, query):
    vertices = np.array(vertices, dtype=float).reshape(-1, 3)
    origin, scale, _ = frame(vertices)
    limit = "reach" if "reach" in query else "radius"
    return SCRIPT.format(vertices=(scale * (vertices - origin)).tolist(), triangles=np.reshape(triangles, (-1, 3)).tolist(),
                         center=(scale * (np.array(query["center"]) - origin)).tolist(), wanted=limit, limit=scale * query[limit])
