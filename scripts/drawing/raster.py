"""A small rasteriser: triangles, spheres and boxes into a grey picture, nearest in front."""
import numpy

SUPERSAMPLING = 2
LIGHT = numpy.array([0.35, 0.55, 0.76])  # from over the viewer's right shoulder
EDGE = 0.15  # how dark the lines are


def turned(degrees_about_y, degrees_about_x=0):
    """The rotation that turns a model to the viewer, who looks along -z with y up."""
    a, b = numpy.radians([degrees_about_y, degrees_about_x])
    about_y = numpy.array([[numpy.cos(a), 0, numpy.sin(a)], [0, 1, 0], [-numpy.sin(a), 0, numpy.cos(a)]])
    about_x = numpy.array([[1, 0, 0], [0, numpy.cos(b), -numpy.sin(b)], [0, numpy.sin(b), numpy.cos(b)]])
    return about_x @ about_y


class Picture:
    """Orthographic, of the box around `points` with a margin; `pixels` is the side of the square."""

    def __init__(self, points, pixels, rotation, margin=0.06):
        self.rotation = rotation
        view = points @ rotation.T
        low, high = view.min(axis=0), view.max(axis=0)
        self.side = pixels * SUPERSAMPLING
        self.scale = self.side * (1 - 2 * margin) / max(high[0] - low[0], high[1] - low[1], 1e-300)
        self.middle = (low + high) / 2
        self.depth = numpy.full(self.side * self.side, -numpy.inf)
        self.shade = numpy.ones(self.side * self.side)

    def _to_pixels(self, points):
        view = (points @ self.rotation.T - self.middle) * self.scale
        view[..., 0] += self.side / 2
        view[..., 1] = self.side / 2 - view[..., 1]
        return view

    def pixels(self, points):
        """Where points are in the image: columns and rows."""
        return self._to_pixels(points)[..., :2] / SUPERSAMPLING

    def _paint(self, x, y, z, shade):
        """Fragments at whole pixels; of several on one pixel the nearest shows."""
        inside = (x >= 0) & (x < self.side) & (y >= 0) & (y < self.side)
        pixel = (y[inside] * self.side + x[inside]).astype(numpy.int64)
        z, shade = z[inside], shade[inside]
        front = z > self.depth[pixel]
        pixel, z, shade = pixel[front], z[front], shade[front]
        order = numpy.argsort(z, kind="stable")  # the last one assigned stays
        self.depth[pixel[order]] = z[order]
        self.shade[pixel[order]] = shade[order]

    def triangles(self, corners, brightness=0.95, lines=None, cull=True):
        """corners: (n, 3, 3). lines: draw edges; None: where triangles are large enough to be told apart."""
        p = self._to_pixels(corners)
        first, second = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        doubled = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]  # negative: faces the viewer, as y points down
        seen = doubled < -1e-9 if cull else numpy.abs(doubled) > 1e-9
        p, doubled, corners = p[seen], doubled[seen], corners[seen]
        if not len(p):
            return
        shades = brightness * self._lambert(corners)
        if lines is None:
            lines = numpy.sqrt(numpy.abs(doubled).mean()) > 6 * SUPERSAMPLING
        low = numpy.floor(p[:, :, :2].min(axis=1)).astype(int)
        size = (numpy.ceil(p[:, :, :2].max(axis=1)).astype(int) - low).max(axis=1) + 1
        for chosen in by_size(size):
            self._paint_triangles(p[chosen], doubled[chosen], shades[chosen], low[chosen], size[chosen].max(), lines)

    def _lambert(self, corners):
        view = corners @ self.rotation.T
        normal = numpy.cross(view[:, 1] - view[:, 0], view[:, 2] - view[:, 0])
        normal /= numpy.maximum(numpy.linalg.norm(normal, axis=1), 1e-300)[:, None]
        normal *= numpy.where(normal[:, 2] < 0, -1, 1)[:, None]
        return 0.35 + 0.65 * numpy.clip(normal @ LIGHT, 0, 1)

    def _paint_triangles(self, p, doubled, shades, low, size, lines):
        offsets = numpy.arange(size)
        x = low[:, 0, None, None] + offsets[None, None, :] + 0.0 * offsets[None, :, None]
        y = low[:, 1, None, None] + offsets[None, :, None] + 0.0 * offsets[None, None, :]
        weight, distance = [], []
        for k in range(3):
            a, b = p[:, (k + 1) % 3], p[:, (k + 2) % 3]
            side = b - a
            cross = side[:, 0, None, None] * (y + 0.5 - a[:, 1, None, None]) - side[:, 1, None, None] * (
                x + 0.5 - a[:, 0, None, None])
            weight.append(cross / doubled[:, None, None])
            distance.append(numpy.abs(cross) / numpy.maximum(numpy.hypot(side[:, 0], side[:, 1]), 1e-9)[:, None, None])
        hit = (weight[0] >= 0) & (weight[1] >= 0) & (weight[2] >= 0)
        z = sum(weight[k] * p[:, k, 2, None, None] for k in range(3))
        shade = numpy.broadcast_to(shades[:, None, None], hit.shape).copy()
        if lines:
            shade[numpy.minimum.reduce(distance) < 0.4 * SUPERSAMPLING] = EDGE
        self._paint(x[hit], y[hit], z[hit], shade[hit])

    def spheres(self, centers, radii, brightness=0.95):
        p, r = self._to_pixels(centers), radii * self.scale
        low = numpy.floor(p[:, :2] - r[:, None]).astype(int)
        size = (2 * numpy.ceil(r) + 2).astype(int)
        for chosen in by_size(size):
            self._paint_spheres(p[chosen], r[chosen], low[chosen], size[chosen].max(), brightness)

    def _paint_spheres(self, p, r, low, size, brightness):
        offsets = numpy.arange(size)
        x = low[:, 0, None, None] + offsets[None, None, :] + 0 * offsets[None, :, None]
        y = low[:, 1, None, None] + offsets[None, :, None] + 0 * offsets[None, None, :]
        nx = (x + 0.5 - p[:, 0, None, None]) / numpy.maximum(r, 0.7)[:, None, None]
        ny = -(y + 0.5 - p[:, 1, None, None]) / numpy.maximum(r, 0.7)[:, None, None]
        height = 1 - nx * nx - ny * ny
        hit = height >= 0
        nz = numpy.sqrt(numpy.where(hit, height, 0))
        z = p[:, 2, None, None] + r[:, None, None] * nz
        shade = brightness * (0.3 + 0.7 * numpy.clip(nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2], 0, 1))
        shade[nz < 0.25] *= 0.6  # the rim tells neighbours apart
        self._paint(x[hit], y[hit], z[hit], shade[hit])

    def boxes(self, low, high, brightness=0.95):
        self.triangles(box_triangles(low, high), brightness, lines=False, cull=True)
        self._box_edges(low, high)

    def _box_edges(self, low, high):
        """Lines along the boxes' twelve edges, as rows of dots a little in front."""
        for begin, end in box_edges(low, high):
            a, b = self._to_pixels(begin), self._to_pixels(end)
            steps = int(numpy.ceil(numpy.abs(b - a)[:, :2].max())) + 1
            for t in numpy.linspace(0, 1, steps + 1):
                dots = a + t * (b - a)
                for shift in range(SUPERSAMPLING):
                    x, y = numpy.floor(dots[:, 0]).astype(int) + shift, numpy.floor(dots[:, 1]).astype(int)
                    self._paint(x, y, dots[:, 2] + 1.5, numpy.full(len(dots), EDGE))

    def image(self):
        """Rows of grey values in 0..1, white behind everything."""
        n = self.side // SUPERSAMPLING
        return self.shade.reshape(n, SUPERSAMPLING, n, SUPERSAMPLING).mean(axis=(1, 3))


def by_size(size, max_cells=4_000_000):
    """Indices in groups of similar size, each small enough for memory."""
    order = numpy.argsort(size, kind="stable")
    begin = 0
    while begin < len(order):
        end = begin + 1
        limit = max(2 * size[order[begin]], 4)
        while end < len(order) and size[order[end]] <= limit and (end - begin + 1) * size[order[end]] ** 2 <= max_cells:
            end += 1
        yield order[begin:end]
        begin = end


def corners_in(path):
    """(n, 3, 3) of an .off file that touchmark wrote."""
    words = path.read_text(encoding="utf-8").split()
    vertices, triangles = int(words[1]), int(words[2])
    numbers = numpy.array(words[4:], dtype=float)
    faces = numbers[3 * vertices:].reshape(triangles, 4)[:, 1:].astype(int)
    return numbers[:3 * vertices].reshape(vertices, 3)[faces]


def box_corners(low, high):
    """(n, 8, 3); corner 4x + 2y + z."""
    bounds = numpy.stack([low, high], axis=1)
    return numpy.stack([numpy.stack([bounds[:, x, 0], bounds[:, y, 1], bounds[:, z, 2]], axis=1)
                        for x in (0, 1) for y in (0, 1) for z in (0, 1)], axis=1)


def box_triangles(low, high):
    corners = box_corners(low, high)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return numpy.concatenate([corners[:, list(t)] for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])


def box_edges(low, high):
    corners = box_corners(low, high)
    for a in range(8):
        for bit in (1, 2, 4):
            if not a & bit:
                yield corners[:, a], corners[:, a | bit]
