import numpy as np
import numpy.typing as npt

version: str

class Mesh:
    def __init__(self, vertices: npt.NDArray[np.float64], faces: npt.NDArray[np.uint32]) -> None: ...
    def vertices(self) -> npt.NDArray[np.float64]: ...
    def faces(self) -> npt.NDArray[np.uint32]: ...
    def bounds(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...

class Detector:
    def __init__(self, mesh: Mesh, text: str) -> None: ...
    def touches(
        self, points: npt.NDArray[np.float64], radius: npt.NDArray[np.float64], threads: int
    ) -> npt.NDArray[np.bool_]: ...
    def nearest(
        self, points: npt.NDArray[np.float64], reach: npt.NDArray[np.float64], threads: int
    ) -> tuple[
        npt.NDArray[np.bool_],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.int64],
    ]: ...
    def first_hit(
        self,
        starts: npt.NDArray[np.float64],
        ends: npt.NDArray[np.float64],
        radius: npt.NDArray[np.float64],
        threads: int,
    ) -> tuple[
        npt.NDArray[np.bool_],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.int64],
    ]: ...
    def side(self, points: npt.NDArray[np.float64], threads: int) -> npt.NDArray[np.int8]: ...
    def contacts(
        self, points: npt.NDArray[np.float64], reach: npt.NDArray[np.float64], threads: int
    ) -> tuple[
        npt.NDArray[np.int64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.int64],
    ]: ...
    def update(self, vertices: npt.NDArray[np.float64]) -> None: ...
    def mesh(self) -> Mesh: ...
    def bytes(self) -> int: ...

class Scene:
    def __init__(self) -> None: ...
    def add_mesh(self, mesh: Mesh) -> int: ...
    def add_plane(self, size_x: float, size_y: float) -> int: ...
    def add_box(self, size_x: float, size_y: float, size_z: float) -> int: ...
    def add_sphere(self, radius: float) -> int: ...
    def add_capsule(self, radius: float, length: float) -> int: ...
    def add(self, shape: int, pose: npt.NDArray[np.float64]) -> int: ...
    def move(self, body: int, pose: npt.NDArray[np.float64]) -> None: ...
    def remove(self, body: int) -> None: ...
    def pose(self, body: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    def size(self) -> int: ...
    def bytes(self) -> int: ...
    def touches(
        self, points: npt.NDArray[np.float64], radius: npt.NDArray[np.float64], threads: int
    ) -> npt.NDArray[np.bool_]: ...
    def nearest(
        self, points: npt.NDArray[np.float64], reach: npt.NDArray[np.float64], threads: int
    ) -> tuple[
        npt.NDArray[np.bool_],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.int64],
        npt.NDArray[np.int64],
    ]: ...
    def first_hit(
        self,
        starts: npt.NDArray[np.float64],
        ends: npt.NDArray[np.float64],
        radius: npt.NDArray[np.float64],
        threads: int,
    ) -> tuple[
        npt.NDArray[np.bool_],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.float64],
        npt.NDArray[np.int64],
        npt.NDArray[np.int64],
    ]: ...

class Proxy:
    def __init__(
        self,
        detector: Detector,
        radius: float,
        stiffness: float,
        static_friction: float,
        dynamic_friction: float,
        damping: float,
        tick_s: float,
    ) -> None: ...
    def place(self, position: npt.NDArray[np.float64]) -> None: ...
    def step(
        self, goal: npt.NDArray[np.float64]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64], int]: ...
