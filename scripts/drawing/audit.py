"""What touchmark audit found: a picture a body and engine, and one page of them all."""
import base64
import collections
import csv
import html
import math

import numpy

from . import raster
from .layout import label
from .results import Record, rows_of, shortened, unique

TEXTS = ["file", "body", "detector", "options", "error_place", "shape", "status"]
NUMBERS = ["triangles", "diagonal", "radius", "tolerance", "points", "made_up", "contacts", "missed", "true_contacts", "max_distance_error",
           "max_distance_error_mm", "error_x", "error_y", "error_z", "hull_share"]
COLOURS = {"made up": "#c0392b", "missed": "#e08e0b", "": "#5b8c5a"}  # of a contact's fault
ROTATION = raster.turned(-35, 25)


class Row(Record):
    """One row of audit.csv."""

    def __init__(self, record, line):
        super().__init__(record, line, TEXTS, NUMBERS)
        self.name = self.detector + (":" + self.options if self.options else "")
        self.key = self.body, self.detector, self.options

    @property
    def error(self):
        if math.isnan(self.max_distance_error):
            return "not told"
        return f"{self.max_distance_error:.4g}" if math.isnan(self.max_distance_error_mm) else f"{self.max_distance_error_mm:.4g} mm"

    @property
    def finding(self):
        if math.isnan(self.points) or not self.points:
            return self.status
        text = "treats it as its convex hull; " if self.shape == "convex hull" else ""
        return (f"{self.status}: {text}{self.made_up:.0f} of {self.contacts:.0f} contacts made up, {self.missed:.0f} of "
                f"{self.true_contacts:.0f} missed, largest error {self.error}")


def read(path):
    """(rows, points by body and engine, the meshes' corners by body)."""
    rows, points = rows_of(path, TEXTS + NUMBERS, Row), collections.defaultdict(list)
    with open(path.with_name("audit_points.csv"), newline="", encoding="utf-8") as file:
        for record in csv.DictReader(file):
            points[record["body"], record["detector"], record["options"]].append(record)
    meshes = {body: raster.corners_in(path.parent / "bodies" / f"{number}.off") for number, body in enumerate(unique(row.body for row in rows), 1)}
    return rows, points, meshes


def column(points, name):
    return numpy.array([float(point[name] or "nan") for point in points])


def draw_audit(plt, row, points, corners, source):
    figure, (body, plot) = plt.subplots(1, 2, figsize=(10.5, 6.4))
    figure.subplots_adjust(left=0.03, right=0.98, top=0.82, bottom=0.15, wspace=0.18)
    picture = raster.Picture(corners.reshape(-1, 3), 480, ROTATION, margin=0.2)
    picture.triangles(corners, cull=False, lines=False)
    body.imshow(picture.image(), cmap="gray", vmin=0, vmax=1)
    body.axis("off")
    at = picture.pixels(numpy.stack([column(points, axis) for axis in "xyz"], axis=-1)) if points else numpy.empty((0, 2))
    true, said = column(points, "true_distance"), column(points, "distance")
    for fault, colour in COLOURS.items():
        chosen = numpy.array([point["fault"] == fault for point in points], dtype=bool)
        of_body = chosen & bool(fault)  # what is right would hide it
        body.scatter(*at[of_body].T, s=9, color=colour, linewidths=0)
        plot.scatter(100 * true[chosen] / row.diagonal, 100 * said[chosen] / row.diagonal, s=9, color=colour, linewidths=0,
                     label=f"contact {fault}" if fault else "contact right")
    if math.isfinite(row.error_x):
        body.plot(*picture.pixels(numpy.array([[row.error_x, row.error_y, row.error_z]]))[0], "k+", markersize=14, label="largest error")
    plot.axline((0, 0), slope=1, color="0.5", linewidth=0.8)
    plot.axvline(100 * row.radius / row.diagonal, color="0.5", linestyle=":", linewidth=1, label="the probe's radius")
    plot.set_xlabel("true distance, % of the diagonal", fontsize=9)
    plot.set_ylabel("distance as the engine has it", fontsize=9)
    handles = plot.get_legend_handles_labels()[0] + body.get_legend_handles_labels()[0]
    label(figure, f"{shortened(row.body)}: {shortened(row.name)}", row.finding, source, "", handles)
    return figure


def page(rows, stems, folder):
    """The whole audit as one file: a table, and the pictures in it."""
    cells = ["body", "name", "triangles", "points", "error", "shape", "finding"]
    def text(value):
        return html.escape(f"{value:.0f}" if isinstance(value, float) else str(value))
    table = "".join("<tr>" + "".join(f"<td>{text(getattr(row, cell))}</td>" for cell in cells) + "</tr>\n" for row in rows)
    heads = "".join(f"<th>{head}</th>" for head in ["body", "engine", "triangles", "points", "largest error", "taken for", "finding"])
    images = "".join(f'<h2>{html.escape(row.body)}: {html.escape(row.name)}</h2>\n<img alt="{html.escape(row.finding)}" src="data:image/png;base64,'
                     f'{base64.b64encode((folder / f"{stem}.png").read_bytes()).decode()}">\n' for row, stem in zip(rows, stems))
    title = "Audit of " + html.escape(", ".join(unique(row.file for row in rows)))
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>body{{font:15px sans-serif;margin:2em}}'
            "table{border-collapse:collapse}td,th{border-bottom:1px solid #ccc;padding:.2em .7em;text-align:left}img{max-width:100%}</style></head>\n"
            f"<body><h1>{title}</h1>\n<table><tr>{heads}</tr>\n{table}</table>\n{images}</body></html>\n")
