"""Bodies in poses and distances to their triangles, in whole numbers: Python's own, which share nothing with the library.

Vectors are triples of integers or fractions. A body's pose is the documented formula on doubles, and all that follows
from it is exact.
"""
import itertools
import math
from fractions import Fraction

UNIT = Fraction(1, 2**53)  # u of docs/exactness.md


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def plus(a, b, times=1):
    return (a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def squared(a):
    return dot(a, a)


def exactly(vector):
    return tuple(Fraction(x) for x in vector)


def segment_squared(point, a, b):
    """The squared distance of a point to the segment from a to b."""
    edge, way = minus(b, a), minus(point, a)
    along, length = dot(way, edge), squared(edge)
    if along <= 0 or length == 0:
        return squared(way)
    if along >= length:
        return squared(minus(point, b))
    return squared(way) - Fraction(along * along) / length


def is_over(point, triangle, normal):
    """Is the point within the prism over the triangle, whose normal is not 0?"""
    return all(dot(cross(minus(b, a), minus(point, a)), normal) >= 0
               for a, b in zip(triangle, triangle[1:] + triangle[:1]))


def triangle_squared(point, triangle):
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    if any(normal) and is_over(point, triangle, normal):
        height = dot(minus(point, a), normal)
        return Fraction(height * height) / squared(normal)
    return min(segment_squared(point, a, b), segment_squared(point, b, c), segment_squared(point, c, a))


def segments_squared(p, q, a, b):
    """The squared distance between two segments: at an end of one of them, or where both are met inside."""
    least = min(segment_squared(p, a, b), segment_squared(q, a, b), segment_squared(a, p, q), segment_squared(b, p, q))
    d, e, w = minus(q, p), minus(b, a), minus(p, a)
    dd, ee, de, dw, ew = squared(d), squared(e), dot(d, e), dot(d, w), dot(e, w)
    det = dd * ee - de * de
    if det != 0 and 0 < de * ew - ee * dw < det and 0 < dd * ew - de * dw < det:
        normal = cross(d, e)
        height = dot(w, normal)
        least = min(least, Fraction(height * height) / squared(normal))
    return least


def path_squared(p, q, triangle):
    """The squared distance between the segment from p to q and a triangle."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    at_p, at_q = dot(minus(p, a), normal), dot(minus(q, a), normal)
    if any(normal) and at_p != at_q and at_p * at_q <= 0:
        if is_over(plus(p, minus(q, p), Fraction(at_p) / (at_p - at_q)), triangle, normal):
            return 0
    return min(triangle_squared(p, triangle), triangle_squared(q, triangle),
               *(segments_squared(p, q, *edge) for edge in ((a, b), (b, c), (c, a))))


# --- bodies


def rotation_of(quaternion):
    """The formula of core/scene/pose.h, in doubles and in its order."""
    w, x, y, z = quaternion
    s = 2 / (w * w + x * x + y * y + z * z)
    return ((1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)),
            (s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)),
            (s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)))


def rigid_bound(rotation):
    """At least how far the rotation stretches anything: Frobenius' norm of R^T R - I (E27), and some roundings."""
    columns = list(zip(*(exactly(row) for row in rotation)))
    off = sum((dot(a, b) - (a is b))**2 for a, b in itertools.product(columns, columns))
    return Fraction(math.sqrt(off)) * Fraction(101, 100) + 16 * UNIT


class Body:
    def __init__(self, place, shape, position, quaternion):
        self.place, self.shape = place, shape
        self.put(position, quaternion)

    def put(self, position, quaternion):
        self.position, self.quaternion = position, quaternion
        rotation = rotation_of(quaternion)
        self.rigid = rigid_bound(rotation)
        rows, offset = [exactly(row) for row in rotation], exactly(position)
        corners = [tuple(dot(row, exactly(v)) + t for row, t in zip(rows, offset)) for v in self.shape.vertices]
        self.images = [tuple(corners[i] for i in triangle) for triangle in self.shape.triangles]


class Shape:
    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles


def box(x, y, z):
    vertices = [(a * x / 2, b * y / 2, c * z / 2) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Shape(vertices, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])


def octahedron(size, where=(0, 0, 0)):
    vertices = [tuple(w + size * s * (k == axis) for k, w in enumerate(where)) for axis in range(3) for s in (1, -1)]
    return Shape(vertices, [(a, b, c) for a in (0, 1) for b in (2, 3) for c in (4, 5)])


def soup(chance, count):
    vertices = [tuple(chance.uniform(-0.5, 0.5) for _ in range(3)) for _ in range(3 * count)]
    return Shape(vertices, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(count)])
