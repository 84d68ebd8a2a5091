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


def sheet(plt, columns, rows, size, cell):
    """A figure of (label, what) columns and rows: cell(column, row) gives a picture and the words below it, or None."""
    figure, axes = plt.subplots(len(rows), len(columns), squeeze=False, figsize=size)
    for line, (row_label, row) in zip(axes, rows):
        line[0].set_ylabel(row_label, fontsize=11)
        for panel, (_, column) in zip(line, columns):
            drawn = cell(column, row)
            if drawn is None:
                panel.set_visible(False)
                continue
            show(panel, drawn[0])
            panel.set_xlabel(drawn[1], fontsize=9)
    for panel, (label, _) in zip(axes[0], columns):
        panel.set_title(label, fontsize=11)
    return figure


def named(levels):
    return [("original" if level == 0 else f"level {level}", level) for level in levels]


BY_METHOD = [(label, method) for method, label in METHODS]


def title_above(figure, title):
    figure.suptitle(title, fontsize=13, fontweight="bold", y=0.995, va="top")
    figure.tight_layout(rect=(0, 0, 1, 0.99), h_pad=0.6, w_pad=0.4)
    return figure


def with_room(points):
    """Points of a frame that leaves room for what stands out."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    return middle + 1.12 * (points - middle)


def draw_surfaces(plt, directory, what, unit, title, pixels=PIXELS):
    """The paper's sheet: a column a method, a row a level; the original is drawn once and shown in every column."""
    folder = folder_of(directory)
    frame = read_triangles(folder / "original-0-mesh.csv").reshape(-1, 3)
    frame = frame if what == "mesh" else with_room(frame)
    levels = 1 + max(int(path.name.split("-mesh")[0].rsplit("-", 1)[1]) for path in folder.glob("*-mesh.csv"))
    original = surface_picture(folder, "original", 0, what, frame, pixels)

    def cell(method, level):
        drawn = surface_picture(folder, method, level, what, frame, pixels) if level else original
        return drawn and (drawn[0], f"{drawn[1]:,} {unit}")

    return title_above(sheet(plt, BY_METHOD, named(range(levels)), (2.5 * len(METHODS), 2.75 * levels + 0.5), cell), title)


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
    """Left the groups; right the HIP, the group that holds it, and the triangles looked at for it, on the pale model,
    seen from outside where they are."""
    folder = folder_of(directory)
    triangles = read_triangles(folder / "original-mesh.csv")
    active = read_triangles(folder / f"{shape}-active.csv")
    groups, hip = read(folder / f"{shape}-groups.csv"), read(folder / "hip.csv")[0]
    points = triangles.reshape(-1, 3)
    view = facing(hip, points)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5.8))
    picture = raster.Picture(points, 2 * pixels, view, margin=0.1)
    add_shapes(picture, groups)
    show(left, picture)
    left.set_xlabel(f"{len(groups):,} groups (printed: {printed:,})", fontsize=11)
    # Room for the triangles looked at and for the group itself.
    group = read(folder / f"{shape}-active-shape.csv")[0]
    bounds = group.reshape(2, 3) if len(group) == 6 else numpy.array([group[:3] - group[3], group[:3] + group[3]])
    reach = 2.2 * numpy.abs(numpy.vstack([active.reshape(-1, 3), bounds]) - hip).max() / extent(points)
    picture = raster.Picture(around(hip, points, reach), 2 * pixels, view, margin=0.02)
    picture.triangles(triangles, lines=False)
    front = view[2] * 0.01 * extent(points)
    picture.triangles(active + front, brightness=0.45, lines=True, cull=False)
    outline(picture, read(folder / f"{shape}-active-shape.csv"), 3 * front)
    picture.spheres((hip + 6 * front)[None], numpy.array([0.008 * extent(points)]), brightness=0.05)
    show(right, picture)
    right.set_xlabel(f"near the HIP (black dot): its group outlined, dark the {len(active):,} triangles\nlooked at, of "
                     f"{len(triangles):,}", fontsize=10)
    figure.suptitle(title, fontsize=13, fontweight="bold")
    figure.tight_layout()
    return figure


def extent(points):
    return (points.max(axis=0) - points.min(axis=0)).max()


def around(point, points, part):
    """The corners of a cube about the point, of this part of the model's extent."""
    half = part * extent(points) / 2
    return numpy.array([point - half, point + half])


def add_shapes(picture, shapes):
    """Boxes have six columns, spheres four."""
    if shapes.shape[1] == 6:
        picture.boxes(shapes[:, :3], shapes[:, 3:])
    else:
        picture.spheres(shapes[:, :3], shapes[:, 3])


def outline(picture, shapes, front):
    """A box by its edges, a sphere by a circle that faces the viewer; moved to the front, to be seen."""
    for shape in shapes:
        if len(shape) == 6:
            picture._box_edges(shape[None, :3] + front, shape[None, 3:] + front)
            continue
        angles = numpy.linspace(0, 2 * numpy.pi, 2000)
        right, up = picture.rotation[0], picture.rotation[1]
        circle = shape[:3] + shape[3] * (numpy.cos(angles)[:, None] * right + numpy.sin(angles)[:, None] * up)
        picture.spheres(circle + front + shape[3] * picture.rotation[2], numpy.full(len(angles), 0.8 / picture.scale),
                        brightness=0.05)


def draw_grouping(plt, directory, pixels=PIXELS):
    """Figs 1 to 3, step by step, from the program's own cells and groups."""
    folder = folder_of(directory)
    triangles, hip = read_triangles(folder / "original-mesh.csv"), read(folder / "hip.csv")[0]
    points, data = triangles.reshape(-1, 3), {}
    for name in ("cells", "cell", "cuboid", "cuboids", "centered", "smallest", "spheres"):
        data[name] = read(folder / f"grouping-{name}.csv")
    members = read_triangles(folder / "grouping-triangles.csv")
    view = facing(hip, points)
    front = view[2] * 0.02 * extent(points)
    sphere, smallest = data["centered"][0], data["smallest"][0]
    near = numpy.vstack([members.reshape(-1, 3), *raster.box_corners(data["cell"][:, :3], data["cell"][:, 3:]),
                         *raster.box_corners(data["cuboid"][:, :3], data["cuboid"][:, 3:]),
                         *(ball[:3] + sign * ball[3] * view[k] for ball in (sphere, smallest) for k in (0, 1)
                           for sign in (-1, 1))])
    cells = raster.box_corners(data["cells"][:, :3], data["cells"][:, 3:]).reshape(-1, 3)

    def cell_picture(shapes):
        picture = raster.Picture(near, pixels, view, margin=0.02)
        picture.triangles(members, cull=False, brightness=0.6)
        for name in shapes:
            outline(picture, data[name], 0 * front)
        return picture

    def whole(shapes, model=True):
        picture = raster.Picture(cells, pixels, view, margin=0.04)
        if model:
            picture.triangles(triangles, lines=False)
        shapes(picture)
        return picture

    steps = [
        ("(1) the model in cells", whole(lambda p: p._box_edges(data["cells"][:, :3] + front, data["cells"][:, 3:] + front))),
        ("(2) a cell and all triangles that touch it", cell_picture(["cell"])),
        ("(3) the cuboid around them", cell_picture(["cuboid"])),
        (f"(4) all {len(data['cuboids'])} cuboids", whole(lambda p: add_shapes(p, data["cuboids"]), False)),
        ("(5) from the finished cuboid ...", cell_picture(["cuboid"])),
        ("(6) its centre and farthest vertex", cell_picture(["cuboid", "centered"])),
        ("(6') or the smallest sphere", cell_picture(["cuboid", "smallest"])),
        (f"(7) all {len(data['spheres'])} spheres", whole(lambda p: add_shapes(p, data["spheres"]), False))]
    figure, axes = plt.subplots(2, 4, figsize=(12, 6.8))
    for cell, (text, picture) in zip(axes.flat, steps):
        show(cell, picture)
        cell.set_xlabel(text, fontsize=9.5)
    figure.suptitle("Park & Jang 2018, Figs 1 to 3: grouping by cuboids (above) and by spheres (below)", fontsize=13,
                    fontweight="bold")
    figure.tight_layout()
    return figure


def draw_closeups(plt, directory, title, pixels=PIXELS):
    """A row a level of the same small part of every surface, where the shapes of triangles can be told."""
    folder = folder_of(directory)
    points = read_triangles(folder / "original-0-mesh.csv").reshape(-1, 3)
    frame = around(points[numpy.argmax(points @ FRONT[2])], points, 0.28)

    def cell(method, level):
        path = folder / f"{method if level else 'original'}-{level}-mesh.csv"
        if not path.exists():
            return None
        picture = raster.Picture(frame, pixels, FRONT, margin=0)
        picture.triangles(read_triangles(path), lines=True)
        return picture, ""

    return title_above(sheet(plt, BY_METHOD, named(range(3)), (2.5 * len(METHODS), 8.3), cell), title)


def draw_spheres_side_by_side(plt, directory, title, pixels=PIXELS):
    """LS3's spheres, above without and below with clustering, a column a level."""
    folder = folder_of(directory)
    frame = with_room(read_triangles(folder / "original-0-mesh.csv").reshape(-1, 3))
    levels = named(level for level in range(6) if level == 0 or (folder / f"ls3-{level}-mesh.csv").exists())

    def cell(level, what):
        picture, count = surface_picture(folder, "ls3", level, what, frame, pixels)
        return picture, f"{count:,} spheres"

    figure = sheet(plt, levels, [("without clustering", "spheres"), ("with clustering", "clustered")], (2.6 * len(levels) + 0.4, 6), cell)
    figure.suptitle(title, fontsize=13, fontweight="bold")
    figure.tight_layout()
    return figure
