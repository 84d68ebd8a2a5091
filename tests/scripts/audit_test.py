#!/usr/bin/python3
"""touchmark audit, as a user runs it: engines that lie about a mesh in known ways, and one that does not.

Argument: the program.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1)
ENVIRONMENT = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
# A channel: a box of 3 by 2 by 1 with a groove of 1 by 1 along it. Its convex hull is its box.
OUTLINE = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
LID = [(1, 2, 3), (1, 3, 4), (0, 1, 4), (0, 4, 5), (0, 5, 6), (0, 6, 7)]
HONEST = """
import importlib.util, numpy as np
spec = importlib.util.spec_from_file_location("honest", {example!r})
honest = importlib.util.module_from_spec(spec)
spec.loader.exec_module(honest)
name = "liar"
class Detector:
    def __init__(self, vertices, faces):
        self.low, self.high = vertices.min(axis=0), vertices.max(axis=0)
        self.honest = honest.Detector(vertices, faces{faces})
    def nearest(self, center, reach):
        {nearest}
"""
BOX = """nearest = np.clip(center, self.low, self.high)
        distance = float(np.linalg.norm(center - nearest))
        return (nearest, np.array([0.0, 0, 1]), distance, None) if distance <= reach else None"""
MOVED = """found = self.honest.nearest(center, np.inf)
        distance = max(0.0, found[2] + {more})
        return (found[0], found[1], distance, None) if distance <= reach else None"""


def channel():
    triangles = [tuple(reversed(lid)) for lid in LID] + [tuple(8 + k for k in lid) for lid in LID]
    for k in range(8):
        n = (k + 1) % 8
        triangles += [(k, n, n + 8), (k, n + 8, k + 8)]
    lines = [f"OFF\n16 {len(triangles)} 0"] + [f"{x} {y} {z}" for z in (0, 1) for x, y in OUTLINE]
    return "\n".join(lines + [f"3 {a} {b} {c}" for a, b, c in triangles]) + "\n"


class Audit(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"
        self.mesh = self.folder / "channel.off"
        self.mesh.write_text(channel(), encoding="utf-8")

    def liar(self, nearest, faces=""):
        path = self.folder / "liar.py"
        example = str(ROOT / "docs" / "examples" / "plugin" / "mine.py")
        path.write_text(HONEST.format(example=example, nearest=nearest, faces=faces), encoding="utf-8")
        return path

    def audit(self, *arguments):
        return subprocess.run([PROGRAM, "audit", *arguments], capture_output=True, text=True, timeout=120, check=False, env=ENVIRONMENT)

    def rows(self, name="audit.csv"):
        with open(self.out / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def audited(self, plugin, *more):
        done = self.audit(self.mesh, "--plugin", plugin, "--points", "400", "--out", self.out, *more)
        row, = self.rows()
        checked = subprocess.run([PROGRAM, "validate", self.out / "audit.csv"], capture_output=True, text=True, check=False)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""), checked.stdout)
        return done, row

    def test_an_honest_engine_is_within_the_tolerance(self):
        done, row = self.audited(ROOT / "docs" / "examples" / "plugin" / "mine.py")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual([row[name] for name in ("status", "shape", "made_up", "missed", "triangles", "hull_share")],
                         ["ok", "surface", "0", "0", "28", "0"])
        self.assertEqual([row[place] for place in ("inside", "cavities", "near", "beyond")], ["100"] * 4)
        self.assertLess(float(row["max_distance_error"]), 1e-9)

    def test_the_convex_hull_is_called_by_its_name(self):
        done, row = self.audited(self.liar(BOX), "--unit", "cm")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("treats it as its convex hull: 100 % of its answers in cavities", done.stdout)
        self.assertEqual((row["shape"], row["status"], row["hull_share"]), ("convex hull", "differs", "1"))
        faults = [(point["place"], point["fault"]) for point in self.rows("audit_points.csv")]
        self.assertEqual(faults.count(("cavities", "made up")), 100)
        self.assertEqual(row["missed"], "0")
        # In the middle of the groove's mouth the mesh is half its width away: 5 mm at the most.
        self.assertLess(3.5, float(row["max_distance_error_mm"]))
        self.assertLessEqual(float(row["max_distance_error_mm"]), 5)
        at = [float(row[f"error_{axis}"]) for axis in "xyz"]
        self.assertTrue(1 < at[0] < 2 and 1 < at[1] < 2 and 0 < at[2] < 1, at)

    def test_an_inflated_mesh_makes_contacts_up_near_the_surface(self):
        done, row = self.audited(self.liar(MOVED.format(more=-0.01)))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual((row["shape"], row["missed"]), ("surface", "0"))
        self.assertGreater(int(row["made_up"]), 0)
        self.assertAlmostEqual(float(row["max_distance_error"]), 0.01)
        self.assertEqual(self.audit(self.mesh, "--plugin", self.liar(MOVED.format(more=-0.01)), "--tolerance", "0.0101").returncode, 0)

    def test_a_hole_and_a_thinner_mesh_miss_contacts(self):
        for nearest, faces in ((MOVED.format(more=0.01), ""), (MOVED.format(more=0), "[4:]")):
            with self.subTest(faces=faces):
                done, row = self.audited(self.liar(nearest, faces))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertEqual((row["shape"], row["made_up"]), ("surface", "0"))
                self.assertGreater(int(row["missed"]), 0)
                self.assertEqual(sum(point["fault"] == "missed" for point in self.rows("audit_points.csv")), int(row["missed"]))

    def test_a_solid_is_no_lie(self):
        inside = """inside = (self.low < center).all() and (center < self.high).all() and not (1 < center[0] < 2 and center[1] > 1)
        found = self.honest.nearest(center, reach)
        return (found[0], found[1], 0.0, None) if inside and found else found"""
        done, row = self.audited(self.liar(inside))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((row["shape"], row["status"]), ("solid", "ok"))

    def test_a_scene_has_a_row_for_each_mesh_and_pictures(self):
        scene = self.folder / "scene.json"
        body = {"mesh": "channel.off", "position": [0, 0, 0], "orientation": [1, 0, 0, 0]}
        scene.write_text(json.dumps({"bodies": [{"name": "left", **body}, {"name": "right", **body},
                                                {"name": "ball", **body, "mesh": "icosphere:2"}]}), encoding="utf-8")
        done = self.audit(scene, "--plugin", self.liar(BOX), "--points", "128", "--out", self.out)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual([(row["body"], row["bodies"], row["shape"]) for row in self.rows()],
                         [("left", "2", "convex hull"), ("ball", "1", "solid")])
        drawn = subprocess.run([ROOT / "scripts" / "plot", self.out], capture_output=True, text=True, check=False)
        self.assertEqual((drawn.returncode, drawn.stderr), (0, ""))
        self.assertEqual(sorted(path.name for path in (self.out / "plots").glob("*.png")), ["audit-ball.png", "audit-left.png"])
        page = (self.out / "plots" / "audit.html").read_text(encoding="utf-8")
        self.assertIn("treats it as its convex hull", page)
        self.assertEqual(page.count("<img"), 2)

    def test_an_engine_that_fails_is_a_status(self):
        done, row = self.audited(self.liar("raise ValueError('no')"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(row["status"], r"^crashed: ?ValueError: no \(liar.py, line \d+\)")
        self.assertEqual((row["points"], row["shape"]), ("0", ""))

    def test_an_engine_that_refuses_every_body_is_inconclusive(self):
        done, row = self.audited(self.liar(BOX, faces="[0:0][0]"))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertTrue(row["status"].startswith("refused: "), row["status"])

    def test_who_is_slow_is_asked_less(self):
        slow = "__import__('time').sleep(0.005)\n        return self.honest.nearest(center, reach)"
        done, row = self.audited(self.liar(slow), "--seconds", "0.1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((row["points"], row["inside"]), ("128", "32"))

    def test_bad_input_is_one_line(self):
        for words, named in (((self.mesh,), "--plugin"), ((self.mesh, "--detector", "aabb-tree", "--tolerance", "0"), "--tolerance"),
                             ((self.folder / "none.urdf", "--detector", "aabb-tree"), "none.urdf"),
                             ((self.mesh, "--detector", "aabb-tree", "--points", "5"), "--points")):
            with self.subTest(named=named):
                done = self.audit(*words)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                self.assertIn(named, done.stderr)


if __name__ == "__main__":
    unittest.main()
