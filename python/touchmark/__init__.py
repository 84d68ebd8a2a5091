"""Exact collision detectors for haptic loops: closest points, contacts and sweeps against a triangle mesh.

    >>> import numpy as np, touchmark
    >>> mesh = touchmark.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> detector = touchmark.GridGroup(mesh)
    >>> detector.nearest([[0.25, 0.25, 2.0]]).distance
    array([2.])

Lengths are in the mesh's own units. Points are arrays of the shape (n, 3); float64 in C order is used where it lies, other
real numbers are converted, and what is no real number, or masked, is refused. Whatever is wrong raises ValueError, which
names it.

A batch runs without the interpreter's lock, so other Python threads go on; `threads=` divides it among several. Points are
asked in their order: where each is near to the one before it, a query is cheaper. The answers do not depend on the order,
nor on the threads.

Meshes, detectors and scenes can be pickled and copied, for the same version of touchmark. A process may fork at any time,
whatever its threads do: the child can use all of them.
"""
from __future__ import annotations

import copy
import dataclasses
import enum
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _native

__all__ = ["AabbTree", "BodyHit", "BodyNearest", "Box", "BruteForce", "Capsule", "Contacts", "Detector", "FirstHit",
           "GridGroup", "Mesh", "Nearest", "Plane", "Proxy", "ProxyState", "ProxyStatus", "Scene", "Side", "Sphere",
           "SphereCluster"]
__version__: str = _native.version

Length = Union[float, str]
"""A number in mesh units, or a text such as "0.5%", in percent of the mesh's box diagonal."""


class Side(enum.IntEnum):
    """Where a point is. Inside is behind the faces, whose corners run counter-clockwise seen from outside."""

    OUTSIDE = 1
    INSIDE = 2
    ON_SURFACE = 3
    UNDECIDED = 4  # the mesh does not say: it has openings there, or neighbours that are turned against each other


class Nearest(NamedTuple):
    """The nearest points of the mesh, an entry a point asked for."""

    found: npt.NDArray[np.bool_]
    """Is the mesh within the reach?"""
    distance: npt.NDArray[np.float64]
    """From the point asked for to `point`; infinity where nothing is found."""
    point: npt.NDArray[np.float64]
    """On the mesh, (n, 3); not-a-number where nothing is found."""
    normal: npt.NDArray[np.float64]
    """Unit, from `point` to the point asked for, (n, 3); the face's normal where both coincide."""
    triangle: npt.NDArray[np.int64]
    """Row of `faces`; the lowest of those equally near; -1 where nothing is found."""


class FirstHit(NamedTuple):
    """The first touches of balls on straight ways, an entry a way."""

    found: npt.NDArray[np.bool_]
    """Does the ball touch the mesh on its way?"""
    fraction: npt.NDArray[np.float64]
    """Of the way, 0 to 1, rounded down; 0 where and only where it touches at the start; infinity where it never does."""
    distance: npt.NDArray[np.float64]
    """From the centre there to `point`."""
    point: npt.NDArray[np.float64]
    """On the mesh, nearest to the centre there, (n, 3)."""
    normal: npt.NDArray[np.float64]
    """Unit, from `point` to the centre there, (n, 3)."""
    triangle: npt.NDArray[np.int64]
    """Row of `faces`; -1 where nothing is hit."""


class Contacts(NamedTuple):
    """A contact for each triangle within reach of each point: those of point i are the rows `of(i)`, nearest first."""

    ends: npt.NDArray[np.int64]
    """Where the rows of each point end, (n,): as many as the points."""
    distance: npt.NDArray[np.float64]
    """From the point asked for to `point`, a row a contact."""
    point: npt.NDArray[np.float64]
    """On the triangle, nearest to the point asked for, (rows, 3)."""
    normal: npt.NDArray[np.float64]
    """Unit, from `point` to the point asked for, (rows, 3)."""
    triangle: npt.NDArray[np.int64]
    """Row of `faces`, (rows,)."""

    def of(self, i: int) -> slice:
        """The rows of point i."""
        end = range(len(self.ends))[i]
        return slice(int(self.ends[end - 1]) if end else 0, int(self.ends[end]))


class BodyNearest(NamedTuple):
    """The nearest points of a scene, as `Nearest`, and on which body each is."""

    found: npt.NDArray[np.bool_]
    distance: npt.NDArray[np.float64]
    point: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    triangle: npt.NDArray[np.int64]
    """Row of the `faces` of the body's mesh; 0 of a sphere and a capsule."""
    body: npt.NDArray[np.int64]
    """As `Scene.add` returned it; -1 where nothing is found."""


class BodyHit(NamedTuple):
    """The first touches in a scene, as `FirstHit`, and on which body each is."""

    found: npt.NDArray[np.bool_]
    fraction: npt.NDArray[np.float64]
    distance: npt.NDArray[np.float64]
    point: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    triangle: npt.NDArray[np.int64]
    body: npt.NDArray[np.int64]
    """As `Scene.add` returned it; -1 where nothing is hit."""


class ProxyStatus(enum.IntEnum):
    """How a proxy is."""

    FREE = 0  # nothing holds it: it is at its goal
    IN_CONTACT = 1  # the surface holds it
    STUCK = 2  # it was put too near to the surface, or the surface was moved onto it, and it is not off yet
    UNANSWERED = 3  # the goal is no number; the proxy stays


class ProxyState(NamedTuple):
    """What one tick of a proxy came to."""

    position: npt.NDArray[np.float64]
    """The proxy's, (3,)."""
    force: npt.NDArray[np.float64]
    """N, on the device, (3,)."""
    contacts: npt.NDArray[np.float64]
    """The normals of the planes that hold it, 3 at most, unit, out of the surface, (k, 3)."""
    status: ProxyStatus
    unfinished: bool
    """True if it ended at max_work, at a place that is as sure as any. The next step goes on."""


def _is_masked(value: Any) -> bool:
    """True if it is a masked array, or a list with one in it."""
    if isinstance(value, (list, tuple)):
        return not {float, int}.issuperset(map(type, value)) and any(map(_is_masked, value))
    return isinstance(value, np.ma.MaskedArray)


def _real(name: str, value: Any) -> npt.NDArray[Any]:
    if _is_masked(value):
        raise ValueError(f"{name} is a masked array, and what is masked would be taken for numbers; leave those entries out, "
                         "or fill them, and give the plain array that masked.data or masked.filled(...) is")
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise ValueError(f"{name} is no rectangular array of numbers") from None
    if array.size == 0 and not isinstance(value, np.ndarray):
        return array.astype(np.float64)
    if array.dtype.kind not in "iuf" or array.dtype.itemsize > 8:
        raise ValueError(f"{name} holds {array.dtype}; it must hold real numbers of at most 64 bits")
    return array


def _rows_of_three(name: str, value: Any) -> npt.NDArray[Any]:
    array = _real(name, value)
    if array.size == 0 and array.ndim == 1:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has the shape {array.shape}; it must be (n, 3)")
    return array


def _doubles(array: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    return np.require(array, np.float64, ["C", "A"])


def _points(name: str, value: Any) -> npt.NDArray[np.float64]:
    return _doubles(_rows_of_three(name, value))


def _point(name: str, value: Any) -> npt.NDArray[np.float64]:
    array = _real(name, value)
    if array.shape != (3,):
        raise ValueError(f"{name} has the shape {array.shape}; it must be (3,)")
    return _doubles(array)


def _pose(position: Any, orientation: Any) -> npt.NDArray[np.float64]:
    turned = _real("orientation", orientation)
    if turned.shape != (4,):
        raise ValueError(f"orientation has the shape {turned.shape}; it must be (4,), a quaternion w, x, y, z")
    return _doubles(np.concatenate([_point("position", position), turned]))


def _sizes(name: str, value: Any, count: int) -> npt.NDArray[np.float64]:
    array = _real(name, value)
    if array.ndim > 1 or (array.ndim == 1 and len(array) != count):
        raise ValueError(f"{name} has the shape {array.shape}; it must be one number, or ({count},): one for each point")
    return _doubles(np.atleast_1d(array)) if array.size else np.zeros(1)


def _faces(value: Any) -> npt.NDArray[np.uint32]:
    array = _rows_of_three("faces", value)
    if array.size == 0:
        return array.astype(np.uint32)
    if array.dtype.kind == "f":
        raise ValueError(f"faces holds {array.dtype}; it must hold whole numbers")
    if array.dtype.kind == "i" or array.dtype.itemsize == 8:
        bad = (array < 0) | (array > 2**32 - 1)
        if bad.any():
            row, column = np.argwhere(bad)[0]
            raise ValueError(f"faces[{row}, {column}] is {array[row, column]}; it must name a row of vertices")
    return np.require(array, np.uint32, ["C", "A"])


def _whole(name: str, value: int, zero: str) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 0:
        raise ValueError(f"{name} is {value!r}; it must be a whole number, and 0 means {zero}")
    return int(value)


def _threads(value: int) -> int:
    return _whole("threads", value, "one a processor")


class Mesh:
    """Triangles in double precision, checked and copied. Degenerate ones are kept: they are segments or points.

    vertices: (n, 3) real and finite. faces: (m, 3) whole numbers, rows of vertices, counter-clockwise seen from outside.
    """

    __slots__ = ("_native",)

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike) -> None:
        self._native = _native.Mesh(_points("vertices", vertices), _faces(faces))

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """The mesh's own vertices, (n, 3), without a copy; they cannot be written to."""
        return self._native.vertices()

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """The mesh's own triangles, (m, 3), without a copy; they cannot be written to."""
        return self._native.faces()

    @property
    def bounds(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """The least and the greatest corner of the box of all vertices that triangles use."""
        return self._native.bounds()

    def __len__(self) -> int:
        """The number of triangles."""
        return len(self.faces)

    def __repr__(self) -> str:
        return f"<touchmark.Mesh: {len(self.vertices)} vertices, {len(self)} triangles>"


def _mesh(native: _native.Mesh) -> Mesh:
    mesh = Mesh.__new__(Mesh)
    mesh._native = native
    return mesh


class Detector:
    """What all detectors can be asked, by several Python threads at once. Constant but for `update`."""

    __slots__ = ("_native",)
    _name = ""

    def __init__(self, mesh: Mesh, **options: object) -> None:
        if not self._name:
            raise TypeError("touchmark.Detector is what detectors have in common: build a GridGroup or a SphereCluster")
        if not isinstance(mesh, Mesh):
            raise TypeError(f"{type(self).__name__} is built of a touchmark.Mesh, not of {type(mesh).__name__}")
        texts = (f"{key}={_text(value)}" for key, value in options.items())
        self._native = _native.Detector(mesh._native, f"{self._name}:{','.join(texts)}")

    @property
    def mesh(self) -> Mesh:
        """The mesh that it was built of, as the last update left it."""
        return _mesh(self._native.mesh())

    @property
    def nbytes(self) -> int:
        """The memory that the search structure takes, in bytes."""
        return self._native.bytes()

    def nearest(self, points: npt.ArrayLike, reach: npt.ArrayLike = np.inf, *, threads: int = 1) -> Nearest:
        """The nearest point of the mesh for each of the points, if it is within `reach`: one number, or one a point.

        A point with a coordinate that is not a number finds nothing. threads: 0 means one a processor.
        """
        asked = _points("points", points)
        return Nearest(*self._native.nearest(asked, _sizes("reach", reach, len(asked)), _threads(threads)))

    def touches(self, points: npt.ArrayLike, radius: npt.ArrayLike = 0.0, *, threads: int = 1) -> npt.NDArray[np.bool_]:
        """Is the mesh within `radius` of each point? Contact is closed: a distance of exactly the radius touches."""
        asked = _points("points", points)
        return self._native.touches(asked, _sizes("radius", radius, len(asked)), _threads(threads))

    def first_hit(self, starts: npt.ArrayLike, ends: npt.ArrayLike, radius: npt.ArrayLike = 0.0, *,
                  threads: int = 1) -> FirstHit:
        """The first touch of a ball of that radius, 0 for a bare point, that moves straight from start to end, for each."""
        asked = _points("starts", starts)
        found = self._native.first_hit(asked, _points("ends", ends), _sizes("radius", radius, len(asked)), _threads(threads))
        return FirstHit(*found)

    def side(self, points: npt.ArrayLike, *, threads: int = 1) -> npt.NDArray[np.int8]:
        """Inside or outside, a `Side` for each point. What this needs of the mesh is found when it is first asked for."""
        return self._native.side(_points("points", points), _threads(threads))

    def contacts(self, points: npt.ArrayLike, reach: npt.ArrayLike, *, threads: int = 1) -> Contacts:
        """A contact for each triangle within `reach` of each point: one number, or one a point. All are kept in memory."""
        asked = _points("points", points)
        return Contacts(*self._native.contacts(asked, _sizes("reach", reach, len(asked)), _threads(threads)))

    def update(self, vertices: npt.ArrayLike) -> None:
        """Takes other places for the mesh's vertices, (n, 3), as many as it has; its triangles stay.

        It waits for the batches that other threads have begun. `mesh` is another one afterwards, and the one that it was
        built of stays as it is. What is refused changes nothing.
        """
        self._native.update(_points("vertices", vertices))

    def __copy__(self) -> Detector:
        return copy.deepcopy(self)  # an update of one leaves the other

    def __repr__(self) -> str:
        return f"<touchmark.{type(self).__name__}: {len(self.mesh)} triangles, {self.nbytes} bytes>"


def _text(value: object) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return str(value)


class GridGroup(Detector):
    """Triangles in groups about uniform cells, after Park & Jang 2018. The fast exact form, unless told otherwise.

    lookup: "direct", or "scan", the form as published. shape: of the groups of a scan: "cube", "sphere",
    "centered-sphere". cell: edge of a cell; 0: chosen. groups: a scan with cell=0 aims at so many. bytes_per_triangle: what a
    direct one may take. certified: False decides as doubles have it. build: "whole", or "lazy": by the first queries.
    """

    __slots__ = ()
    _name = "grid-group"

    def __init__(self, mesh: Mesh, *, lookup: str = "direct", shape: str = "cube", cell: Length = 0.0, groups: int = 0,
                 bytes_per_triangle: float = 400.0, certified: bool = True, build: str = "whole") -> None:
        super().__init__(mesh, lookup=lookup, shape=shape, cell=cell, groups=groups,
                         bytes_per_triangle=bytes_per_triangle, certified=certified, build=build)


class SphereCluster(Detector):
    """Triangles in clustered bounding spheres, after Choi & Sung 2017. The fast exact form, unless told otherwise.

    clustering: distance between centroids that share a sphere; 0: a sphere each. lookup: "tree", or "scan", the form as
    published. precise: False, the published fast level alone: spheres answer, contacts come early. certified: False decides
    as doubles have it. build: "whole", or "lazy": by the first queries. simd: "avx2" or "portable": none wider.
    """

    __slots__ = ()
    _name = "sphere-cluster"

    def __init__(self, mesh: Mesh, *, clustering: Length = 0.0, lookup: str = "tree", precise: bool = True,
                 certified: bool = True, build: str = "whole", simd: str = "avx2") -> None:
        super().__init__(mesh, clustering=clustering, lookup=lookup, precise=precise, certified=certified, build=build,
                         simd=simd)


class AabbTree(Detector):
    """A plain binary tree of boxes: the reference. leaf_size: triangles a leaf holds at most, 1 to 255."""

    __slots__ = ()
    _name = "aabb-tree"

    def __init__(self, mesh: Mesh, *, leaf_size: int = 4, certified: bool = True) -> None:
        super().__init__(mesh, leaf_size=leaf_size, certified=certified)


class BruteForce(Detector):
    """Every triangle, every time: slow, and what the exact forms of the others equal bit for bit."""

    __slots__ = ()
    _name = "brute-force"

    def __init__(self, mesh: Mesh) -> None:
        super().__init__(mesh)


@dataclasses.dataclass(frozen=True)
class Plane:
    """A rectangle about the origin in the plane z = 0, which faces +z: two triangles. size: along x and y."""

    size: tuple[float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", _lengths("size", self.size, 2))


@dataclasses.dataclass(frozen=True)
class Box:
    """A box about the origin, of 12 triangles. size: along x, y and z."""

    size: tuple[float, float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", _lengths("size", self.size, 3))


@dataclasses.dataclass(frozen=True)
class Sphere:
    """All points that far from the origin. There are no triangles: the one that answers name is 0."""

    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", _lengths("radius", self.radius, 0)[0])


@dataclasses.dataclass(frozen=True)
class Capsule:
    """All points that far from the segment of that length along z about the origin: length + 2 radius long in all."""

    radius: float
    length: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", _lengths("radius", self.radius, 0)[0])
        object.__setattr__(self, "length", _lengths("length", self.length, 0)[0])


def _lengths(name: str, value: Any, count: int) -> tuple[float, ...]:
    """Of `count` numbers, or of one alone where that is 0."""
    array = _real(name, value)
    shape = (count,) if count else ()
    if array.shape != shape:
        raise ValueError(f"{name} has the shape {array.shape}; it must be {shape if count else 'one number'}")
    return tuple(float(number) for number in np.atleast_1d(array))


class _Shapes(dict[Union[Mesh, Plane, Box, Sphere, Capsule], int]):
    """Numbers of shapes in the native scene. It keeps their meshes alive. Other threads may add some while it is pickled."""

    def __reduce_ex__(self, protocol: object) -> tuple[Any, ...]:
        return _Shapes, (dict(self),)


class Scene:
    """Bodies that move, asked as one: each a shape in a pose. Meshes are searched by sphere clusters.

    Any number of bodies may have one mesh, which is searched in once, or primitives of the same sizes. Python threads may ask
    and change a scene at the same time: a change waits for the batches that run, and a batch sees no change that is made
    meanwhile.
    """

    __slots__ = ("_shapes", "_native")  # pickled in this order: the native scene has all shapes that the other names

    def __init__(self) -> None:
        self._native = _native.Scene()
        self._shapes = _Shapes()

    def add(self, shape: Union[Mesh, Plane, Box, Sphere, Capsule], position: npt.ArrayLike = (0.0, 0.0, 0.0),
            orientation: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0)) -> int:
        """Adds a body and returns its number: 0 for the first, and never one that a removed body had.

        shape: a Mesh, or a Plane, Box, Sphere or Capsule, whose sizes must be from 1e-30 to 1e30. position: where the
        shape's origin is. orientation: a quaternion w, x, y, z of any length but zero.
        """
        if not isinstance(shape, (Mesh, Plane, Box, Sphere, Capsule)):
            raise TypeError(f"a body is a touchmark.Mesh, Plane, Box, Sphere or Capsule, not a {type(shape).__name__}")
        pose = _pose(position, orientation)
        number = self._shapes.get(shape)
        if number is None:
            number = self._shapes[shape] = self._add_shape(shape)
        return self._native.add(number, pose)

    def _add_shape(self, shape: Union[Mesh, Plane, Box, Sphere, Capsule]) -> int:
        if isinstance(shape, Mesh):
            return self._native.add_mesh(shape._native)
        if isinstance(shape, Plane):
            return self._native.add_plane(*shape.size)
        if isinstance(shape, Box):
            return self._native.add_box(*shape.size)
        if isinstance(shape, Sphere):
            return self._native.add_sphere(shape.radius)
        return self._native.add_capsule(shape.radius, shape.length)

    def move(self, body: int, position: npt.ArrayLike, orientation: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0)) -> None:
        """Puts a body elsewhere: both parts of its pose are given anew."""
        self._native.move(body, _pose(position, orientation))

    def remove(self, body: int) -> None:
        """Removes a body. Its shape stays, for bodies that are added later."""
        self._native.remove(body)

    def pose(self, body: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Where a body is: its position (3,), and its rotation as a matrix (3, 3)."""
        return self._native.pose(body)

    @property
    def nbytes(self) -> int:
        """The memory that bodies and search structures take, in bytes."""
        return self._native.bytes()

    def __len__(self) -> int:
        """The number of bodies."""
        return self._native.size()

    def nearest(self, points: npt.ArrayLike, reach: npt.ArrayLike = np.inf, *, threads: int = 1) -> BodyNearest:
        """The nearest point of all bodies for each of the points, if it is within `reach`: one number, or one a point."""
        asked = _points("points", points)
        return BodyNearest(*self._native.nearest(asked, _sizes("reach", reach, len(asked)), _threads(threads)))

    def touches(self, points: npt.ArrayLike, radius: npt.ArrayLike = 0.0, *, threads: int = 1) -> npt.NDArray[np.bool_]:
        """Is a body within `radius` of each point? `nearest` with that reach says which."""
        asked = _points("points", points)
        return self._native.touches(asked, _sizes("radius", radius, len(asked)), _threads(threads))

    def first_hit(self, starts: npt.ArrayLike, ends: npt.ArrayLike, radius: npt.ArrayLike = 0.0, *,
                  threads: int = 1) -> BodyHit:
        """The first touch of a ball that moves straight from start to end, for each, while the bodies stand still."""
        asked = _points("starts", starts)
        found = self._native.first_hit(asked, _points("ends", ends), _sizes("radius", radius, len(asked)), _threads(threads))
        return BodyHit(*found)

    def __copy__(self) -> Scene:
        return copy.deepcopy(self)  # moves in one leave the other

    def __repr__(self) -> str:
        return f"<touchmark.Scene: {len(self)} bodies, {self.nbytes} bytes>"


class Proxy:
    """One haptic point: a ball, or a bare point, that follows a device's tip and never crosses the surface.

    radius: of the ball, mesh units; 0: the bare point. stiffness: N a mesh unit, of the spring between proxy and tip.
    static_friction, dynamic_friction: coefficients, the latter at most the former. damping: N s a mesh unit, in contact.
    tick_s: seconds between two steps. max_work: bounds what a step looks at, in boxes and triangles; 0: nothing does.
    The detector must decide exactly: not with certified=False or precise=False.

    A step takes microseconds in Python: this is for trying things out, not for a loop at 1 kHz with other threads beside it.
    """

    __slots__ = ("_detector", "_native")

    def __init__(self, detector: Detector, position: npt.ArrayLike, *, radius: float = 0.0, stiffness: float = 1000.0,
                 static_friction: float = 0.0, dynamic_friction: float = 0.0, damping: float = 0.0,
                 tick_s: float = 0.001, max_work: int = 0) -> None:
        if not isinstance(detector, Detector):
            raise TypeError(f"a Proxy is over a detector such as touchmark.GridGroup, not over a {type(detector).__name__}")
        self._detector = detector
        self._native = _native.Proxy(detector._native, radius, stiffness, static_friction, dynamic_friction, damping, tick_s,
                                     _whole("max_work", max_work, "no bound"))
        self.place(position)

    @property
    def detector(self) -> Detector:
        """What it asks. After an update of it the proxy goes on with the surface as it is then."""
        return self._detector

    def __reduce_ex__(self, protocol: object) -> tuple[Any, ...]:
        raise TypeError("a touchmark.Proxy can be neither pickled nor copied: make one anew over the detector, where it is")

    def place(self, position: npt.ArrayLike) -> None:
        """Puts the proxy anywhere, (3,), and forgets all contacts."""
        self._native.place(_point("position", position))

    def surface_moving(self, vertices: npt.ArrayLike) -> bool:
        """Puts the proxy ahead of a surface that the detector's next `update` moves over it; to be called before that.

        Takes the same vertices, (n, 3). False where no way out is found: then it stays, and the surface may pass it. Not over
        a GridGroup or a published form.
        """
        return self._native.surface_moving(_points("vertices", vertices))

    def step(self, goal: npt.ArrayLike) -> ProxyState:
        """One tick: follows the goal, (3,), which is the device's tip, as far as the surface lets it."""
        position, force, contacts, status, unfinished = self._native.step(_point("goal", goal))
        return ProxyState(position, force, contacts, ProxyStatus(status), unfinished)

    def force_now(self, goal: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The force, N, (3,), on a tip that has gone on to `goal` since the last step, by the planes that held the proxy then."""
        return self._native.force_now(_point("goal", goal))
