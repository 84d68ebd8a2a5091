"""A detector in numpy: every triangle, every time."""
import numpy as np

name = "mine-py"
summary = "every triangle, by numpy"
guarantee = "approximate"  # or "exact", "conservative": what is claimed is held against it


class Detector:
    """Built once of (n, 3) vertices and (m, 3) rows of them, which are its to keep."""

    error = 1e-12  # by how much a distance may be off, in mesh units; leave it out where you do not know

    def __init__(self, vertices, faces):
        self.a, b, c = (vertices[faces[:, k]] for k in range(3))
        self.ab, self.ac = b - self.a, c - self.a
        self.nbytes = self.a.nbytes + self.ab.nbytes + self.ac.nbytes

    def closest(self, center):
        """The nearest point of each triangle, (m, 3): of the plane where it is inside, else of the edges."""
        ap = center - self.a
        aa, ab_ac, cc = (np.einsum("ij,ij->i", x, y) for x, y in ((self.ab, self.ab), (self.ab, self.ac), (self.ac, self.ac)))
        pb, pc = np.einsum("ij,ij->i", ap, self.ab), np.einsum("ij,ij->i", ap, self.ac)
        area = aa * cc - ab_ac * ab_ac
        with np.errstate(divide="ignore", invalid="ignore"):
            u, v = (cc * pb - ab_ac * pc) / area, (aa * pc - ab_ac * pb) / area
            on_ab, on_ac = np.clip(pb / aa, 0, 1), np.clip(pc / cc, 0, 1)
            on_bc = np.clip((pc - pb - ab_ac + aa) / (aa - 2 * ab_ac + cc), 0, 1)
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        ways = [np.where(inside, (u, v), np.nan), (on_ab, 0 * on_ab), (0 * on_ac, on_ac), (1 - on_bc, on_bc)]
        points = np.stack([self.a + u[:, None] * self.ab + v[:, None] * self.ac for u, v in ways])
        squares = ((points - center) ** 2).sum(axis=-1)
        best = np.nanargmin(np.where(np.isnan(squares), np.inf, squares), axis=0)
        return points[best, np.arange(len(self.a))]

    def nearest(self, center, reach):
        """None where nothing is within the reach, else point, normal, distance and triangle (or None)."""
        points = self.closest(center)
        distances = np.linalg.norm(points - center, axis=1)
        triangle = int(distances.argmin())
        distance = distances[triangle]
        if not distance <= reach:
            return None
        normal = (center - points[triangle]) / distance if distance > 0 else np.cross(self.ab[triangle], self.ac[triangle])
        return points[triangle], normal / np.linalg.norm(normal), distance, triangle

    def touches(self, center, radius):
        return self.nearest(center, radius) is not None
