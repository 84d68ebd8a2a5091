"""The papers' rendered pictures: meshes, spheres and groups, from the CSV files under DIR/pictures."""
import pathlib

import numpy

from . import raster
from .results import NothingToDraw, Unusable

METHODS = [("butterfly", "(a) Butterfly"), ("catmull-clark-linear", "(b) Catmull-Clark"), ("mid-point", "(c) Mid-point"),
           ("loop", "(d) Loop"), ("ls3", "(e) LS3")]
PIXELS = 300  # the side of a picture on a sheet; those that stand alone are twice as large
FRONT = raster.turned(-20, 8)


def folder_of(directory):
    """Where touchmark paper leaves what is rendered."""
    folder = pathlib.Path(directory) / "pictures"
    if not folder.is_dir():
        raise NothingToDraw(f"no {folder}: touchmark paper writes it, recordings are kept without")
    return folder


def read(path):
    try:
        return numpy.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except OSError:  # numpy's own does not name the file
        raise Unusable(f"{path}: cannot be read") from None


def read_triangles(path):
    return read(path).reshape(-1, 3, 3)


def show(axes, picture):
    axes.imshow(picture.image(), cmap="gray", vmin=0, vmax=1, interpolation="antialiased")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)


def surface_picture(folder, method, level, what, frame, pixels):
    """`what`: mesh, spheres or clustered. Returns the picture and how many things it shows; None without a file. Edges
    are drawn up to level 1, so that all methods of a level compare; beyond it they would blacken the surface."""
    path = folder / f"{method if level else 'original'}-{level}-{what}.csv"
    if not path.exists():
        return None
    picture = raster.Picture(frame, pixels, FRONT)
    if what == "mesh":
        triangles = read_triangles(path)
        picture.triangles(triangles, lines=level < 2)
        return picture, len(triangles)
    spheres = read(path)
    picture.spheres(spheres[:, :3], spheres[:, 3])
    return picture, len(spheres)


def draw_surfaces(plt, directory, what, unit, title, pixels=PIXELS):
    """The paper's sheet: a column a method, a row a level; the original is drawn once and shown in every column."""
    folder = folder_of(directory)
    frame = read_triangles(folder / "original-0-mesh.csv").reshape(-1, 3)
    if what != "mesh":  # room for what stands out
        middle = (frame.min(axis=0) + frame.max(axis=0)) / 2
        frame = middle + 1.12 * (frame - middle)
    levels = 1 + max(int(path.name.split("-mesh")[0].rsplit("-", 1)[1]) for path in folder.glob("*-mesh.csv"))
    figure, axes = plt.subplots(levels, len(METHODS), squeeze=False, figsize=(2.5 * len(METHODS), 2.75 * levels + 0.5))
    original = surface_picture(folder, "original", 0, what, frame, pixels)
    for column, (method, label) in enumerate(METHODS):
        for level in range(levels):
            cell = axes[level][column]
            drawn = surface_picture(folder, method, level, what, frame, pixels) if level else original
            if drawn is None:
                cell.set_visible(False)
                continue
            picture, count = drawn
            show(cell, picture)
            cell.set_xlabel(f"{count:,} {unit}", fontsize=9)
            if level == 0:
                cell.set_title(label, fontsize=11)
            if column == 0:
                cell.set_ylabel("original" if level == 0 else f"level {level}", fontsize=11)
    figure.suptitle(title, fontsize=13, fontweight="bold", y=0.995, va="top")
    figure.tight_layout(rect=(0, 0, 1, 0.99), h_pad=0.6, w_pad=0.4)
    return figure


def facing(point, points):
    """Turned so that this point of the model faces the viewer."""
    away = point - (points.min(axis=0) + points.max(axis=0)) / 2
    return raster.turned(-numpy.degrees(numpy.arctan2(away[0], away[2])), 15)


def draw_original(plt, directory, pixels=PIXELS):
    triangles = read_triangles(folder_of(directory) / "original-mesh.csv")
    figure, axes = plt.subplots(figsize=(5, 5.3))
    picture = raster.Picture(triangles.reshape(-1, 3), 2 * pixels, FRONT)
    picture.triangles(triangles)
    show(axes, picture)
    axes.set_xlabel(f"{len(triangles):,} triangles", fontsize=10)
    axes.set_title("Park & Jang 2018, Fig. 4: the model", fontsize=12, fontweight="bold")
    figure.tight_layout()
    return figure


def draw_groups(plt, directory, shape, title, printed, pixels=PIXELS):
    """Left the groups, right the triangles of one group that holds the probe, dark on the pale model."""
    folder = folder_of(directory)
    triangles = read_triangles(folder / "original-mesh.csv")
    active = read_triangles(folder / f"{shape}-active.csv")
    groups, hip = read(folder / f"{shape}-groups.csv"), read(folder / "hip.csv")[0]
    points = triangles.reshape(-1, 3)
    view = facing(hip, points)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5.6))
    picture = raster.Picture(points, 2 * pixels, view, margin=0.1)
    if shape == "cube":
        picture.boxes(groups[:, :3], groups[:, 3:])
    else:
        picture.spheres(groups[:, :3], groups[:, 3])
    show(left, picture)
    left.set_xlabel(f"{len(groups):,} groups (printed: {printed:,})", fontsize=11)
    picture = raster.Picture(points, 2 * pixels, view, margin=0.1)
    picture.triangles(triangles, lines=False)
    toward_viewer = view[2] * 0.01 * (points.max(axis=0) - points.min(axis=0)).max()
    picture.triangles(active + toward_viewer, brightness=0.3, lines=False, cull=False)
    show(right, picture)
    right.set_xlabel(f"dark: the {len(active):,} triangles of the active group, of {len(triangles):,}", fontsize=11)
    figure.suptitle(title, fontsize=13, fontweight="bold")
    figure.tight_layout()
    return figure
