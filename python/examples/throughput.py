#!/usr/bin/python3
"""Nearest points a second on the same mesh and points: ours, and VTK's where python3-vtk9 is installed.

All are asked in turns within one run, and each one's best turn counts. VTK is asked in a loop of Python, since
vtkStaticCellLocator takes one point at a time, and by vtkImplicitPolyDataDistance, which takes an array.
"""
import argparse
import sys
import time

import numpy as np

import touchmark

try:
    import vtkmodules.vtkCommonCore as vtk_core
    import vtkmodules.vtkCommonDataModel as vtk_data
    import vtkmodules.vtkFiltersCore as vtk_filters
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
except ImportError:
    vtk_core = None


def bumpy_torus(around, across):
    """A closed mesh of 2 * around * across triangles."""
    u, v = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across, indexing="ij")
    tube = 0.35 * (1 + 0.08 * np.sin(9 * u) * np.cos(5 * v))
    vertices = np.stack([(1 + tube * np.cos(v)) * np.cos(u), (1 + tube * np.cos(v)) * np.sin(u), tube * np.sin(v)], -1)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = i * across + j, (i + 1) % around * across + j
    c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return vertices.reshape(-1, 3), faces


def vtk_askers(vertices, faces):
    surface = vtk_data.vtkPolyData()
    points = vtk_core.vtkPoints()
    points.SetData(numpy_to_vtk(vertices, deep=True))
    cells = vtk_data.vtkCellArray()
    rows = np.hstack([np.full((len(faces), 1), 3), faces]).astype(np.int64).ravel()
    cells.SetCells(len(faces), numpy_to_vtkIdTypeArray(rows, deep=True))
    surface.SetPoints(points)
    surface.SetPolys(cells)
    locator = vtk_data.vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    distance = vtk_filters.vtkImplicitPolyDataDistance()
    distance.SetInput(surface)

    def one_by_one(asked):
        found, cell, part, squared = [0.0] * 3, vtk_core.reference(0), vtk_core.reference(0), vtk_core.reference(0.0)
        distances = np.empty(len(asked))
        for i, point in enumerate(asked.tolist()):
            locator.FindClosestPoint(point, found, cell, part, squared)
            distances[i] = squared.get()
        return np.sqrt(distances)

    def array(asked):
        values = vtk_core.vtkDoubleArray()
        distance.FunctionValue(numpy_to_vtk(asked), values)
        return np.abs(vtk_to_numpy(values))
    return {"vtkStaticCellLocator, a call a point": one_by_one, "vtkImplicitPolyDataDistance, an array": array}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--triangles", type=int, default=100_000)
    parser.add_argument("--points", type=int, default=20_000)
    parser.add_argument("--turns", type=int, default=5)
    arguments = parser.parse_args()
    across = max(3, round((arguments.triangles / 6) ** 0.5))
    vertices, faces = bumpy_torus(3 * across, across)
    random = np.random.default_rng(1)
    scattered = random.uniform(vertices.min(0) - 0.1, vertices.max(0) + 0.1, (arguments.points, 3))
    time_of = np.linspace(0, 1, arguments.points)[:, None]
    angle = 2 * np.pi * time_of
    followed = np.hstack([np.cos(angle) * (1.3 + 0.1 * np.sin(7 * angle)), np.sin(angle) * 1.35, 0.1 * np.cos(5 * angle)])

    mesh = touchmark.Mesh(vertices, faces)
    askers = {kind.__name__: (lambda asked, detector=kind(mesh): detector.nearest(asked).distance)
              for kind in (touchmark.GridGroup, touchmark.SphereCluster)}
    if vtk_core:
        askers.update(vtk_askers(vertices, faces))
    else:
        print("VTK is not installed: python3-vtk9", file=sys.stderr)
    for title, asked in (("scattered points", scattered), ("points along a path", followed)):
        truth = touchmark.AabbTree(mesh).nearest(asked).distance
        best = {name: np.inf for name in askers}
        for _ in range(arguments.turns):
            for name in random.permutation(list(askers)):
                begin = time.perf_counter()
                answers = askers[name](asked)
                best[name] = min(best[name], time.perf_counter() - begin)
                if not np.allclose(answers, truth, rtol=0, atol=1e-6):
                    print(f"{name}: distances are off by up to {np.abs(answers - truth).max():.2g}", file=sys.stderr)
        print(f"{title}: {len(faces)} triangles, {len(asked)} points, one thread")
        slowest_of_ours = max(seconds for name, seconds in best.items() if not name.startswith("vtk"))
        for name, seconds in sorted(best.items(), key=lambda item: item[1]):
            ratio = f"  {seconds / slowest_of_ours:6.1f} times our slower one's" if name.startswith("vtk") else ""
            print(f"  {name:38} {len(asked) / seconds / 1e6:8.3f} million points/s{ratio}")


if __name__ == "__main__":
    main()
