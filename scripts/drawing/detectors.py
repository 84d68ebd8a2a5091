"""How each detector looks and where it stands, the same in every picture: colour and shape by kind, filling by options,
so that grey print tells them apart too."""
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
    None: ("#8060c0", "h"),  # all others
    "grid-group as published": ("#c04a00", "s"),
    "sphere-cluster as published": ("#0060a8", "o"),
    "brute-force": ("#000000", "*"),
}
PLACES = {kind: place for place, kind in enumerate(KINDS)}
FILLINGS = ["full", "none", "left", "bottom", "right", "top"]
LINES = {"full": "-", "none": "--", "left": ":", "bottom": "-.", "right": (0, (5, 1, 1, 1, 1, 1)), "top": (0, (1, 3))}
KNOWN_FILLINGS = {
    "grid-group:lookup=scan": "none",
    "grid-group:lookup=scan,shape=sphere": "left",
    "sphere-cluster:lookup=scan": "none",
    "sphere-cluster:lookup=scan,precise=false": "left",
    "bullet:precision=float": "none",
    "bullet:precision=float,frame=fitted": "left",
    "bullet:method=callback,frame=fitted": "bottom",
    "fcl:bv=obbrss": "none",
    "fcl:bv=aabb,method=distance,narrow=exact": "bottom",
    "libccd+aabb:algorithm=mpr": "none",
    "cgal:kernel=simple,hint=bounded": "bottom",
}


def kind_of(name):
    detector, _, options = name.partition(":")
    if "lookup=scan" in options.split(",") and f"{detector} as published" in KINDS:
        return f"{detector} as published"
    return detector if detector in KINDS else None


def in_order(names):
    """Each name once, at its fixed place."""
    return sorted(unique(names), key=lambda name: (PLACES[kind_of(name)], ":" in name, name))


def filling(name):
    if name in KNOWN_FILLINGS:
        return KNOWN_FILLINGS[name]
    if ":" not in name and kind_of(name):
        return "full"
    return chosen_fillings.get(name) or preferred(name)[0]


def preferred(name):
    """The fillings in the order in which a detector that is not known would like them: the same everywhere."""
    first = 1 + zlib.crc32(name.encode()) % (len(FILLINGS) - 1)
    return FILLINGS[first:] + FILLINGS[1:first] + FILLINGS[:1]


chosen_fillings = {}  # of detectors that are not known


def tell_apart(names):
    """Of those to be drawn in one go: gives each that is not known a filling that no other of its kind has, if one is
    left."""
    known = [name for name in names if name in KNOWN_FILLINGS or ":" not in name and kind_of(name)]
    taken = {(kind_of(name), filling(name)) for name in known}
    for name in in_order(set(names) - set(known)):
        free = [filling for filling in preferred(name) if (kind_of(name), filling) not in taken]
        chosen_fillings[name] = (free or preferred(name))[0]
        taken.add((kind_of(name), chosen_fillings[name]))


def colour(name):
    return KINDS[kind_of(name)][0]


def mark(name, size=7):
    """Of a point or a legend's entry: arguments for axes.plot."""
    shape = KINDS[kind_of(name)][1]
    return {"marker": shape, "color": colour(name), "markerfacecolor": colour(name), "markerfacecoloralt": "white",
            "markeredgecolor": colour(name), "markeredgewidth": 1.1, "fillstyle": filling(name),
            "markersize": size + 3 * (shape == "*") - (shape == "D")}


def line(name):
    return {"linestyle": LINES[filling(name)], "linewidth": 1.3}
