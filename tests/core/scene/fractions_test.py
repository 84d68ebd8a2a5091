#!/usr/bin/python3
"""Asks scenes of bodies through the C interface, and judges the answers in whole numbers (exact_bodies.py): no tolerance but
the bounds of docs/exactness.md, E28 and E30.

usage: fractions_test.py LIBRARY [--cases N] [--seed S]
"""
import argparse
import ctypes
import itertools
import math
import random
import sys
from fractions import Fraction

from exact_bodies import (UNIT, Body, box, exactly, minus, octahedron, path_squared, plus, rotation_of, soup,
                          triangle_squared)


class Contact(ctypes.Structure):
    _fields_ = [("point", ctypes.c_double * 3), ("normal", ctypes.c_double * 3), ("distance", ctypes.c_double),
                ("triangle", ctypes.c_uint32), ("side", ctypes.c_int32)]


class Impact(ctypes.Structure):
    _fields_ = [("fraction", ctypes.c_double), ("contact", Contact)]


# --- the library


class Library:
    def __init__(self, path):
        self.c = ctypes.CDLL(path)
        self.c.touchmark_last_error.restype = ctypes.c_char_p
        for name in ("mesh_create", "scene_create", "scene_session_create"):
            getattr(self.c, f"touchmark_{name}").restype = ctypes.c_void_p

    def call(self, name, *arguments):
        result = getattr(self.c, f"touchmark_{name}")(*arguments)
        if result in (-1, None):
            raise AssertionError(f"{name}: {self.c.touchmark_last_error().decode()}")
        return result


def triple(vector):
    return (ctypes.c_double * 3)(*vector)


class Scene:
    """The library's scene, and what is known of it."""

    def __init__(self, library, shapes):
        self.library, self.bodies, self.shapes = library, {}, {}
        self.handle = ctypes.c_void_p(library.call("scene_create"))
        for shape in shapes:
            flat = [x for v in shape.vertices for x in v]
            names = [i for t in shape.triangles for i in t]
            mesh = ctypes.c_void_p(library.call("mesh_create", (ctypes.c_double * len(flat))(*flat),
                                                ctypes.c_size_t(len(shape.vertices)),
                                                (ctypes.c_uint32 * len(names))(*names),
                                                ctypes.c_size_t(len(shape.triangles))))
            number = ctypes.c_uint32()
            library.call("scene_add_mesh", self.handle, mesh, ctypes.byref(number))
            library.c.touchmark_mesh_free(mesh)
            self.shapes[shape] = number.value
        self.session = ctypes.c_void_p(library.call("scene_session_create", self.handle))

    def close(self):
        self.library.c.touchmark_scene_session_free(self.session)
        self.library.c.touchmark_scene_free(self.handle)

    def add(self, shape, position, quaternion):
        number = ctypes.c_uint64()
        self.library.call("scene_add", self.handle, ctypes.c_uint32(self.shapes[shape]), triple(position),
                          (ctypes.c_double * 4)(*quaternion), ctypes.byref(number))
        taken = {body.place for body in self.bodies.values()}
        place = next(i for i in itertools.count() if i not in taken)
        assert number.value not in self.bodies
        self.bodies[number.value] = Body(place, shape, position, quaternion)
        return number.value

    def move(self, number, position, quaternion):
        self.library.call("scene_move", self.handle, ctypes.c_uint64(number), triple(position),
                          (ctypes.c_double * 4)(*quaternion))
        self.bodies[number].put(position, quaternion)

    def remove(self, number):
        self.library.call("scene_remove", self.handle, ctypes.c_uint64(number))
        del self.bodies[number]

    def truth(self, point):
        """The least squared distance, whose body it is (the one in the lowest place) and which triangle."""
        here = exactly(point)
        squares = ((triangle_squared(here, image), body.place, number, i)
                   for number, body in self.bodies.items() for i, image in enumerate(body.images))
        least, _, number, triangle = min(squares)
        return least, number, triangle

    def touches(self, point, radius):
        return self.library.call("scene_touches", self.session, triple(point), ctypes.c_double(radius)) == 1

    def nearest(self, point, reach):
        contact, number = Contact(), ctypes.c_uint64()
        found = self.library.call("scene_nearest", self.session, triple(point), ctypes.c_double(reach),
                                  ctypes.byref(contact), ctypes.byref(number))
        return (contact, number.value) if found == 1 else None

    def first_hit(self, start, end, radius):
        impact, number = Impact(), ctypes.c_uint64()
        found = self.library.call("scene_first_hit", self.session, triple(start), triple(end), ctypes.c_double(radius),
                                  ctypes.byref(impact), ctypes.byref(number))
        return impact if found == 1 else None


# --- questions


class Judge:
    def __init__(self, scene, chance):
        self.scene, self.chance, self.asked = scene, chance, 0

    def expect(self, holds, what):
        if not holds:
            raise AssertionError(what)

    def ask(self, point):
        """Touches and nearest at radii about the true distance, at doubles next to it, and far from it."""
        least, number, triangle = self.scene.truth(point)
        root = math.sqrt(least)  # its neighbours lie on either side of the distance, or one is the distance
        radii = [root, math.nextafter(root, 0), math.nextafter(root, math.inf), 0.5 * root, 1.5 * root, math.inf]
        self.chance.shuffle(radii)
        for radius in radii[:4]:
            within = radius == math.inf or Fraction(radius)**2 >= least
            about = f"point {point}, radius {radius!r}"
            self.expect(self.scene.touches(point, radius) == within, f"{about}: touches is not {within}")
            found = self.scene.nearest(point, radius)
            self.expect((found is not None) == within, f"{about}: nearest found {found}")
            self.asked += 2
            if found:
                self.expect(found[1] == number and found[0].triangle == triangle,
                            f"{about}: body {found[1]}, triangle {found[0].triangle}, not {number} and {triangle}")
                self.judge_distance(found[0].distance, least, point, self.scene.bodies[number].images[triangle])

    def judge_distance(self, told, least, point, image):
        """E28: within 32 u M."""
        largest = max(abs(x - y) for corner in image for x, y in zip(corner, exactly(point)))
        bound = 32 * UNIT * largest
        low, high = max(Fraction(0), Fraction(told) - bound), Fraction(told) + bound
        self.expect(low * low <= least <= high * high, f"point {point}: distance {told!r}, squared {float(least)!r}")

    def sweep(self, start, end, radius):
        """E30: it hits exactly where it hits, never late, and early by a bound."""
        a, way = exactly(start), minus(exactly(end), exactly(start))

        def comes_within(part, reach):
            b = plus(a, way, part)
            return any(path_squared(a, b, image) <= reach * reach
                       for body in self.scene.bodies.values() for image in body.images)

        r = Fraction(radius)
        hits, impact = comes_within(Fraction(1), r), self.scene.first_hit(start, end, radius)
        about = f"from {start} to {end}, radius {radius!r}"
        self.expect((impact is not None) == hits, f"{about}: hits is not {hits}")
        self.asked += 1
        if not impact:
            return
        touching = self.scene.truth(start)[0] <= r * r
        self.expect((impact.fraction == 0) == touching, f"{about}: fraction {impact.fraction!r}, touching {touching}")
        if touching:
            return
        before = Fraction(math.nextafter(impact.fraction, 0))
        self.expect(not comes_within(before, r), f"{about}: fraction {impact.fraction!r} is late")
        # 2^-50 of the way, and twice E27's bound of the image (E30).
        ends = (exactly(start), exactly(end))
        size = r + max(abs(x - y) for body in self.scene.bodies.values() for image in body.images for corner in image
                       for point in ends for x, y in zip(corner, point))
        step = Fraction(2) ** -50 * sum(abs(x) for x in way)
        early = step
        for body in self.scene.bodies.values():
            away = max(sum(abs(x - t) for x, t in zip(point, exactly(body.position))) for point in ends)
            early = max(early, step + 2 * (body.rigid * (3 * size + away) + Fraction(32, 5) * UNIT * 2 * away))
        self.expect(comes_within(Fraction(impact.fraction), r + early), f"{about}: fraction {impact.fraction!r} is early")


class Family:
    """What bodies there are and where: numbers are lengths and parts of them."""

    def __init__(self, name, scale=1.0, offset=(0, 0, 0), turn=1.0, own_offset=0.0, spread=1.2, equal=False):
        self.name, self.scale, self.offset, self.turn = name, scale, offset, turn
        self.own_offset, self.spread, self.equal = own_offset, spread, equal

    def quaternion(self, chance):
        return (1.0, *(self.turn * chance.uniform(-1, 1) for _ in range(3)))

    def position(self, chance):
        return tuple(o + self.scale * self.spread * chance.uniform(-1, 1) for o in self.offset)


FAMILIES = [
    Family("bodies about one place"),
    Family("bodies far from the origin", offset=(1e7, -3e6, 5e5)),
    Family("bodies of which most are one", equal=True),
    Family("rotations of a billionth", turn=1e-9),
    Family("rotations by any quaternion", turn=50.0),
    Family("meshes far from their own origin", own_offset=1e4),
    Family("small bodies", scale=2.0**-60),
    Family("large bodies, far off", scale=1e6, offset=(1e12, 0, 0)),
    Family("nested bodies", spread=0.0),
]


def run_case(library, family, seed):
    """Some questions to one scene, its bodies moving, going and coming between them. Returns how many were asked."""
    chance = random.Random(seed)
    s = family.scale
    shapes = [box(s, 0.5 * s, 0.25 * s), octahedron(0.5 * s, [family.own_offset * s] * 3), soup(chance, 6)]
    shapes[2].vertices = [tuple(s * x for x in v) for v in shapes[2].vertices]
    scene = Scene(library, shapes)
    numbers = []

    def add():
        shape = chance.choice(shapes)
        copies = 3 if family.equal and chance.random() < 0.5 else 1
        position, quaternion = family.position(chance), family.quaternion(chance)
        if shape is shapes[1]:
            turned = rotation_of(quaternion)
            position = tuple(p - sum(r) * family.own_offset * s for p, r in zip(position, turned))
        numbers.extend(scene.add(shape, position, quaternion) for _ in range(copies))

    def step(size):
        return tuple(size * s * chance.uniform(-1, 1) for _ in range(3))

    for _ in range(4):
        add()
    judge = Judge(scene, chance)
    point, way = family.position(chance), step(0.01)
    for tick in range(8):
        # On along a way, to a corner or next to it, or anywhere.
        kind = chance.random()
        if kind < 0.6:
            point = tuple(p + w for p, w in zip(point, way))
        elif kind < 0.8:
            image = chance.choice(scene.bodies[chance.choice(numbers)].images)
            corner = tuple(float(x) for x in chance.choice(image))
            off = step(10.0**chance.uniform(-16, 0)) if chance.random() < 0.7 else (0, 0, 0)
            point, way = tuple(c + o for c, o in zip(corner, off)), step(10.0**chance.uniform(-4, -1))
        else:
            point, way = family.position(chance), step(10.0**chance.uniform(-4, -1))
        judge.ask(point)
        if tick % 3 == 2:
            distance = math.sqrt(scene.truth(point)[0])
            end = tuple(p + w for p, w in zip(point, step(1)))
            judge.sweep(point, end, chance.choice([0.0, 0.9 * distance, distance, 1.1 * distance]))
        if tick % 2 == 0:
            continue
        number, what = chance.choice(numbers), chance.random()
        body = scene.bodies[number]
        if what < 0.4:  # a little: what sessions know still holds, but for that
            scene.move(number, tuple(p + w for p, w in zip(body.position, step(1e-3))), body.quaternion)
        elif what < 0.6:  # under the probe
            scene.move(number, tuple(float(x) for x in point), family.quaternion(chance))
        elif what < 0.8 and len(numbers) > 2:  # the one that is nearest
            number = scene.truth(point)[1]
            scene.remove(number)
            numbers.remove(number)
        else:
            add()
        judge.ask(point)
    scene.close()
    return judge.asked


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("library", help="libtouchmark_c.so")
    parser.add_argument("--cases", type=int, default=27, help="scenes to ask (27)")
    parser.add_argument("--seed", type=int, default=1, help="of the first one (1)")
    options = parser.parse_args()
    library, asked, wrong = Library(options.library), 0, 0
    for case in range(options.cases):
        family, seed = FAMILIES[case % len(FAMILIES)], options.seed + case
        try:
            asked += run_case(library, family, seed)
        except AssertionError as fault:
            wrong += 1
            print(f"{family.name}, seed {seed}: {fault}")
    print(f"{options.cases} scenes, {asked} questions, {wrong} scenes with a wrong answer")
    return 1 if wrong or asked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
