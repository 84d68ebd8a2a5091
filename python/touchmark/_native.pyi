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
    def bytes(self) -> int: ...
