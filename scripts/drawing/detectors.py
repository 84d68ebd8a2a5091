"""How each detector looks and where it stands, the same in every picture: colour and shape by kind, filling by options,
so that grey print tells most of them apart too; tone where one kind has more forms than there are fillings."""
import colorsys
import zlib

from .results import unique

# Ours, the rivals, the forms as published, and what all are measured against.
KINDS = {  # kind: colour, marker
    "sphere-cluster": ("#0060a8", "o"),
    "grid-group": ("#c04a00", "s"),
    "aabb-tree": ("#555555", "^"),
    "embree": ("#008060", "D"),
    "cgal": ("#b0508c", "p"),
    "bullet": ("#b07d00", "v"),
    "fcl": ("#3f97d0", ">"),
    "libccd+aabb": ("#7a1f4f", "X"),
    "chai3d": ("#5a8f00", "<"),
    "field": ("#0060a8", "P"),
    "openvdb": ("#c43a5a", "d"),
    "vtk": ("#6a7f2a", "H"),
    None: ("#8060c0", "h"),  # all others
    "grid-group as published": ("#c04a00", "s"),
    "sphere-cluster as published": ("#0060a8", "o"),
    "brute-force": ("#000000", "*"),
}
PLACES = {kind: place for place, kind in enumerate(KINDS)}
FILLINGS = ["full", "none", "left", "bottom", "right", "top"]
LINES = {"full": "-", "none": "--", "left": ":", "bottom": "-.", "right": (0, (5, 1, 1, 1, 1, 1)), "top": (0, (1, 3))}
# A detector's look is its place here: the six fillings in the kind's colour, then the six in each other tone of it. New
# ones are appended, so that nobody's look changes from one recording to the next.
KNOWN = {
    "sphere-cluster": ["", "lookup=scan", "lookup=scan,precise=false", "build=lazy", "prepare=true", "precise=false",
                       "clustering=2%", "clustering=2%,precise=false", "clustering=1%,precise=false",
                       "clustering=0.5%,precise=false", "clustering=5%,precise=false", "certified=false",
                       "lookup=scan,clustering=2%", "lookup=scan,clustering=2%,precise=false"],
    "grid-group": ["", "lookup=scan", "lookup=scan,shape=sphere", "build=lazy", "cell=1%", "cell=0.5%", "cell=4%",
                   "certified=false"],
    "aabb-tree": ["", "precision=float", "certified=false"],
    "embree": ["", "geometry=triangle", "quality=refit", "query=plain"],
    "cgal": ["", "kernel=simple,hint=bounded", "kernel=epeck,hint=bounded"],
    "bullet": ["", "precision=float", "precision=float,frame=fitted", "method=callback,frame=fitted", "frame=fitted",
               "precision=float,method=callback"],
    "fcl": ["", "bv=obbrss", "bv=obb", "bv=aabb,method=distance,narrow=exact", "bv=kios,method=traverse,narrow=exact",
            "bv=rss,method=distance"],
    "libccd+aabb": ["", "algorithm=mpr", "tolerance=1e-8", "tolerance=1e-2", "iterations=5", "tolerance=1e-8,iterations=20",
                    "algorithm=mpr,tolerance=1e-2", "algorithm=mpr,tolerance=1e-8"],
    "field": ["", "error=0.3%", "answers=exact", "error=2%"],
    "openvdb": ["", "voxel=0.25%", "contact=polygon", "voxel=0.5%", "voxel=2%", "voxel=0.125%", "voxel=0.25%,contact=polygon"],
    "vtk": ["", "cells=1", "locator=implicit"],
}
TONES = 5  # in which a detector that is not known looks for a place of its own


def kind_of(name):
    detector, _, options = name.partition(":")
    if "lookup=scan" in options.split(",") and f"{detector} as published" in KINDS:
        return f"{detector} as published"
    return detector if detector in KINDS else None


def in_order(names):
    """Each name once, at its fixed place."""
    return sorted(unique(names), key=lambda name: (PLACES[kind_of(name)], ":" in name, name))


def family_of(name):
    """Whose mark and colour it has: a form as published shares those of ours."""
    detector = name.partition(":")[0]
    return detector if detector in KINDS else None


def look(name):
    """A number: filling and tone. No two names of a family that are known, or drawn in one go, have the same."""
    known = KNOWN.get(family_of(name), [""])
    options = name.partition(":")[2]
    if family_of(name) and options in known:
        return known.index(options)
    return chosen_looks.get(name, first_look(name))


def first_look(name):
    """Of a detector that is not known, when no other one has it: the same everywhere."""
    reserved = len(KNOWN.get(family_of(name), [""]))
    return reserved + zlib.crc32(name.encode()) % (TONES * len(FILLINGS) - reserved)


chosen_looks = {}  # of detectors that are not known


def tell_apart(names):
    """Of those to be drawn in one go: gives each that is not known a look that no other of its family has."""
    unknown = [name for name in in_order(names)
               if not family_of(name) or name.partition(":")[2] not in KNOWN.get(family_of(name), [""])]
    taken = set()
    for name in unknown:
        chosen = first_look(name)
        while (family_of(name), chosen) in taken:
            chosen += 1
        chosen_looks[name] = chosen
        taken.add((family_of(name), chosen))


def filling(name):
    return FILLINGS[look(name) % len(FILLINGS)]


def colour(name):
    """The family's, or a tone of it: lighter, darker, then turned in hue."""
    basic, tone = KINDS[kind_of(name)][0], look(name) // len(FILLINGS)
    channels = [int(basic[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    if tone == 1:
        channels = [1 - 0.55 * (1 - channel) for channel in channels]
    elif tone == 2:
        channels = [0.5 * channel for channel in channels]
    elif tone > 2:
        hue, value, saturation = colorsys.rgb_to_hls(*channels)
        channels = colorsys.hls_to_rgb((hue + 0.15 * (tone - 2)) % 1, min(max(value, 0.3), 0.6), max(saturation, 0.5))
    return "#" + "".join(f"{round(255 * channel):02x}" for channel in channels)


def mark(name, size=7):
    """Of a point or a legend's entry: arguments for axes.plot."""
    shape = KINDS[kind_of(name)][1]
    return {"marker": shape, "color": colour(name), "markerfacecolor": colour(name), "markerfacecoloralt": "white",
            "markeredgecolor": colour(name), "markeredgewidth": 1.1, "fillstyle": filling(name),
            "markersize": size + 3 * (shape == "*") - (shape == "D")}


def line(name):
    return {"linestyle": LINES[filling(name)], "linewidth": 1.3}
