#!/usr/bin/python3
"""Asks the Python module, and compares with brute force in numpy that shares nothing with it.

usage: PYTHONPATH=FOLDER module_test.py
"""
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import touchmark
from touchmark import Side

FORMS = [(touchmark.BruteForce, {}), (touchmark.AabbTree, {"leaf_size": 2}), (touchmark.GridGroup, {}),
         (touchmark.GridGroup, {"lookup": "scan", "shape": "sphere"}), (touchmark.GridGroup, {"cell": "1%", "build": "lazy"}),
         (touchmark.SphereCluster, {}), (touchmark.SphereCluster, {"clustering": 0.05, "simd": "portable"}),
         (touchmark.SphereCluster, {"lookup": "scan"})]


def bumpy_sphere(rings, sectors):
    """A closed mesh of 2 * sectors * (rings - 1) triangles, outside outwards."""
    random = np.random.default_rng(5)
    vertices = [[0, 0, 1.0]]
    for ring in range(1, rings):
        for sector in range(sectors):
            polar, round_ = np.pi * ring / rings, 2 * np.pi * sector / sectors
            radius = random.uniform(0.8, 1.0)
            vertices.append([radius * np.sin(polar) * np.cos(round_), radius * np.sin(polar) * np.sin(round_),
                             radius * np.cos(polar)])
    vertices.append([0, 0, -1.0])

    def at(ring, sector):
        return 1 + (ring - 1) * sectors + sector % sectors
    faces = []
    for sector in range(sectors):
        faces.append([0, at(1, sector), at(1, sector + 1)])
        faces.append([len(vertices) - 1, at(rings - 1, sector + 1), at(rings - 1, sector)])
        for ring in range(1, rings - 1):
            faces.append([at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)])
            faces.append([at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)])
    return np.array(vertices), np.array(faces)


def to_segments(points, start, end):
    """Squared distances (points, segments) by projection, clamped to the ends."""
    along = end - start
    share = np.einsum("psk,sk->ps", points[:, None] - start, along) / np.einsum("sk,sk->s", along, along)
    nearest = start + np.clip(share, 0, 1)[..., None] * along
    return ((points[:, None] - nearest) ** 2).sum(-1)


def distances_by_numpy(vertices, faces, points):
    """(points, triangles): to the plane where a point's foot is inside, by solving for it, else to the nearest edge."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    height = np.einsum("ptk,tk->pt", points[:, None] - a, normal)
    basis = np.linalg.inv(np.stack([b - a, c - a, normal], axis=-1))
    u, v = np.moveaxis(np.einsum("tij,ptj->pti", basis, points[:, None] - a), -1, 0)[:2]
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    edges = np.minimum.reduce([to_segments(points, *ends) for ends in ((a, b), (b, c), (c, a))])
    return np.sqrt(np.where(inside, height ** 2, edges))


VERTICES, FACES = bumpy_sphere(8, 10)
MESH = touchmark.Mesh(VERTICES, FACES)
POINTS = np.random.default_rng(11).uniform(-1.3, 1.3, (400, 3))
TRUTH = distances_by_numpy(VERTICES, FACES, POINTS)


class Answers(unittest.TestCase):
    def test_nearest_is_that_of_numpy(self):
        for kind, options in FORMS:
            with self.subTest(kind.__name__, **options):
                found = kind(MESH, **options).nearest(POINTS)
                self.assertTrue(found.found.all())
                np.testing.assert_allclose(found.distance, TRUTH.min(axis=1), rtol=0, atol=1e-14)
                # The triangle named is as near as the nearest, and point, normal and distance agree with one another.
                np.testing.assert_allclose(TRUTH[np.arange(len(POINTS)), found.triangle], found.distance, atol=1e-14)
                np.testing.assert_allclose(np.linalg.norm(POINTS - found.point, axis=1), found.distance, atol=1e-14)
                np.testing.assert_allclose(found.point + found.normal * found.distance[:, None], POINTS, atol=1e-13)

    def test_a_reach_leaves_out_what_is_farther(self):
        detector = touchmark.GridGroup(MESH)
        reaches = np.random.default_rng(2).uniform(0, 0.4, len(POINTS))
        found = detector.nearest(POINTS, reaches)
        near = TRUTH.min(axis=1) <= reaches
        self.assertTrue(0 < near.sum() < len(POINTS))
        np.testing.assert_array_equal(found.found, near)
        np.testing.assert_array_equal(found.distance[~near], np.inf)
        np.testing.assert_array_equal(found.triangle[~near], -1)
        self.assertTrue(np.isnan(found.point[~near]).all() and np.isnan(found.normal[~near]).all())
        np.testing.assert_array_equal(detector.touches(POINTS, reaches), near)
        np.testing.assert_array_equal(detector.touches(POINTS, 0.2), TRUTH.min(axis=1) <= 0.2)

    def test_first_hit_is_where_the_distance_falls_to_the_radius(self):
        starts, ends = POINTS[:200], POINTS[200:]
        radius = 0.05
        ways = np.linspace(0, 1, 401)
        centers = starts[:, None] + ways[:, None] * (ends - starts)[:, None]
        along = np.stack([distances_by_numpy(VERTICES, FACES, way).min(axis=1) for way in centers])
        for kind in (touchmark.GridGroup, touchmark.SphereCluster):
            with self.subTest(kind.__name__):
                hit = kind(MESH).first_hit(starts, ends, radius)
                self.assertTrue(20 < hit.found.sum() < 200)
                for way, found, fraction, distance in zip(along, hit.found, hit.fraction, hit.distance):
                    # The distance changes by no more than the way, so samples cannot miss more than half a step.
                    step = 2.6 * np.sqrt(3) / 400
                    if not found:
                        self.assertGreater(way.min(), radius - 1e-12)
                    else:
                        before = way[ways < fraction]
                        self.assertTrue((before > radius - 1e-12).all())
                        self.assertLess(way[np.searchsorted(ways, fraction, "right") - 1], radius + step)
                        self.assertAlmostEqual(distance, way[0] if fraction == 0 else radius, places=9)

    def test_sides_are_those_of_the_solid_angle(self):
        a, b, c = (VERTICES[FACES[:, k]] - POINTS[:, None] for k in range(3))
        la, lb, lc = (np.linalg.norm(x, axis=-1) for x in (a, b, c))
        above = np.einsum("ptk,ptk->pt", a, np.cross(b, c))
        below = la * lb * lc + (a * b).sum(-1) * lc + (b * c).sum(-1) * la + (c * a).sum(-1) * lb
        winding = np.arctan2(above, below).sum(axis=1) / (2 * np.pi)
        expected = np.where(winding > 0.5, Side.INSIDE, Side.OUTSIDE)
        self.assertTrue(50 < (expected == Side.INSIDE).sum() < 350)
        for kind in (touchmark.GridGroup, touchmark.SphereCluster):
            np.testing.assert_array_equal(kind(MESH).side(POINTS), expected)
        self.assertEqual(touchmark.GridGroup(MESH).side(VERTICES[:1])[0], Side.ON_SURFACE)
        sheet = touchmark.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        self.assertEqual(touchmark.GridGroup(sheet).side([[3, 3, 0.1]])[0], Side.UNDECIDED)

    def test_order_and_threads_change_no_bit(self):
        points = np.random.default_rng(3).uniform(-1.3, 1.3, (5000, 3))
        for kind in (touchmark.GridGroup, touchmark.SphereCluster):
            detector = kind(MESH)
            once = detector.nearest(points)
            order = np.random.default_rng(4).permutation(len(points))
            shuffled = detector.nearest(points[order])
            for threads in (0, 2, 7):
                for first, second in zip(once, detector.nearest(points, threads=threads)):
                    np.testing.assert_array_equal(first, second)
            for first, second in zip(once, shuffled):
                np.testing.assert_array_equal(first[order], second)

    def test_far_off_and_tiny_meshes(self):
        for scale, shift in ((2.0 ** -300, 0), (2.0 ** 300, 0), (1.0, 2.0 ** 40)):
            # Moved by rounding once, and then what is stored is what is asked.
            vertices = VERTICES * scale + shift
            points = POINTS * scale + shift
            expected = distances_by_numpy((vertices - shift) / scale, FACES, (points - shift) / scale).min(axis=1)
            found = touchmark.SphereCluster(touchmark.Mesh(vertices, FACES)).nearest(points)
            np.testing.assert_allclose(found.distance / scale, expected, rtol=1e-9, atol=1e-13)


class Arrays(unittest.TestCase):
    detector = touchmark.GridGroup(MESH)

    def test_any_real_array_is_taken(self):
        whole = np.array([[0, 0, 2], [1, 1, 1], [2, 0, 0]])
        expected = self.detector.nearest(whole.astype(float)).distance
        spread = np.zeros((6, 6))
        spread[::2, ::2] = whole
        for value in (whole.tolist(), whole, whole.astype(np.int8), whole.astype(np.uint64), whole.astype(np.float16),
                      whole.astype(">f8"), np.asfortranarray(whole, float), spread[::2, ::2],
                      np.frombuffer(b"x" + whole.astype(float).tobytes(), float, 9, 1).reshape(3, 3)):
            np.testing.assert_array_equal(self.detector.nearest(value).distance, expected)

    def test_what_is_no_real_array_is_refused_by_name(self):
        good = [[0, 0, 0]]
        masked = np.ma.masked_equal([[0, 1, 2]], 1)
        refused = [
            (lambda: self.detector.nearest([[1j, 0, 0]]), "points holds complex128"),
            (lambda: self.detector.nearest([["a", "b", "c"]]), "points holds <U1"),
            (lambda: self.detector.nearest(np.array([[True, False, True]])), "points holds bool"),
            (lambda: self.detector.nearest(np.zeros((1, 3), np.longdouble)), "points holds float128"),
            (lambda: self.detector.nearest([0, 0, 0]), r"points has the shape \(3,\)"),
            (lambda: self.detector.nearest(np.zeros((2, 3, 1))), r"points has the shape \(2, 3, 1\)"),
            (lambda: self.detector.nearest([[1, 2, 3], [1]]), "points is no rectangular array"),
            (lambda: self.detector.nearest(good, -1), "reach is -1.0; it must be 0 or more"),
            (lambda: self.detector.touches(good * 2, [1, np.nan]), r"radius\[1\] is nan; it must be 0 or more"),
            (lambda: self.detector.touches(good * 3, [1, 2]), r"radius has the shape \(2,\)"),
            (lambda: self.detector.first_hit(good, good * 2), "starts has 1 points and ends has 2"),
            (lambda: self.detector.nearest(good, threads=-1), "threads is -1"),
            (lambda: self.detector.nearest(good, threads=1.5), "threads is 1.5"),
            (lambda: touchmark.Mesh(VERTICES, FACES.astype(float)), "faces holds float64"),
            (lambda: touchmark.Mesh(VERTICES, [[0, 1, -1]]), r"faces\[0, 2\] is -1"),
            (lambda: touchmark.Mesh(VERTICES, [[0, 1, 2 ** 40]]), r"faces\[0, 2\] is 1099511627776"),
            (lambda: touchmark.Mesh(VERTICES, [[0, 1, 5000]]), f"triangle 0 names vertex 5000 of {len(VERTICES)}"),
            (lambda: touchmark.Mesh([[0, 0, 0], [1, 0, np.inf]], [[0, 1, 1]]), "vertex 1 is not finite"),
            (lambda: touchmark.Mesh(VERTICES, np.zeros((0, 3), int)), "the mesh has no triangle"),
            (lambda: self.detector.nearest(masked), "points is a masked array.*leave those entries out"),
            (lambda: self.detector.nearest([masked[0], [1, 2, 3]]), "points is a masked array"),
            (lambda: self.detector.nearest([(0, np.ma.masked, 0)]), "points is a masked array"),
            (lambda: self.detector.touches(good, masked[0, :1]), "radius is a masked array"),
            (lambda: touchmark.Mesh(VERTICES, masked), "faces is a masked array"),
            (lambda: touchmark.Box(masked[0]), "size is a masked array"),
            (lambda: touchmark.Scene().add(MESH, orientation=[1, 0, 0, np.ma.masked]), "orientation is a masked array"),
            (lambda: touchmark.GridGroup(MESH, cell="wide"), 'grid-group: cell="wide"'),
            (lambda: touchmark.GridGroup(MESH, shape="octagon"), "none of cube, sphere, centered-sphere"),
            (lambda: touchmark.SphereCluster(MESH, clustering=-1.0), 'clustering="-1.0" is not a length'),
            (lambda: touchmark.AabbTree(MESH, leaf_size=0), "leaf"),
        ]
        for call, message in refused:
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                call()
        for call in (lambda: touchmark.Detector(MESH), lambda: touchmark.GridGroup(VERTICES)):
            with self.assertRaises(TypeError):
                call()

    def test_no_points_give_no_answers(self):
        for nothing in ([], np.zeros((0, 3))):
            self.assertEqual(self.detector.nearest(nothing).point.shape, (0, 3))
            self.assertEqual(self.detector.touches(nothing, 1).shape, (0,))
            self.assertEqual(self.detector.first_hit(nothing, nothing).fraction.shape, (0,))
            self.assertEqual(self.detector.side(nothing).shape, (0,))

    def test_a_point_that_is_no_place_finds_nothing(self):
        found = self.detector.nearest([[np.nan, 0, 0], [0, 0, 2]])
        np.testing.assert_array_equal(found.found, [False, True])

    def test_the_mesh_is_a_copy_that_cannot_be_written_to(self):
        vertices = VERTICES.copy()
        mesh = touchmark.Mesh(vertices, FACES)
        vertices[:] = 0
        np.testing.assert_array_equal(mesh.vertices, VERTICES)
        np.testing.assert_array_equal(mesh.faces, FACES)
        with self.assertRaises(ValueError):
            mesh.vertices[0, 0] = 1
        kept = touchmark.Mesh(VERTICES, FACES).vertices  # outlives the mesh
        np.testing.assert_array_equal(kept, VERTICES)
        np.testing.assert_array_equal(mesh.bounds, [VERTICES.min(axis=0), VERTICES.max(axis=0)])

    def test_other_threads_go_on_while_a_batch_runs(self):
        detector = touchmark.BruteForce(MESH)
        points = np.tile(POINTS, (100, 1))
        inside = threading.Event()
        ticks = []

        def count():
            inside.wait()
            while inside.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.001)
        counter = threading.Thread(target=count)
        counter.start()
        inside.set()
        begin = time.perf_counter()
        detector.nearest(points)
        end = time.perf_counter()
        inside.clear()
        counter.join()
        self.assertGreater(sum(begin < tick < end for tick in ticks), 3)


def turn(quaternion):
    """The rotation of a quaternion of any length, by what it does to the three axes."""
    w, v = quaternion[0], np.array(quaternion[1:])
    axes = np.eye(3)
    turned = axes + 2 * np.cross(v, w * axes + np.cross(v, axes)) / (w * w + v @ v)
    return turned.T


class Scenes(unittest.TestCase):
    POSES = [((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)), ((2.5, 0.3, -0.2), (0.3, -0.5, 0.2, 0.9)),
             ((0.0, 2.6, 0.1), (0.0, 2.0, 0.0, 0.0))]

    @staticmethod
    def truth(poses, points):
        """(bodies, points): the distance of each point to each body, in numpy."""
        return np.stack([distances_by_numpy(VERTICES @ turn(q).T + np.array(p), FACES, points).min(axis=1) for p, q in poses])

    def scene(self, poses):
        scene, bodies = touchmark.Scene(), []
        for position, orientation in poses:
            bodies.append(scene.add(MESH, position, orientation))
        return scene, bodies

    def test_nearest_is_that_of_numpy_and_names_the_body(self):
        scene, bodies = self.scene(self.POSES)
        points = np.random.default_rng(8).uniform(-1.5, 4, (400, 3))
        truth = self.truth(self.POSES, points)
        found = scene.nearest(points)
        np.testing.assert_allclose(found.distance, truth.min(axis=0), rtol=0, atol=1e-13)
        np.testing.assert_array_equal(found.body, np.array(bodies)[truth.argmin(axis=0)])
        self.assertEqual(len(set(found.body)), 3)
        np.testing.assert_allclose(found.point + found.normal * found.distance[:, None], points, atol=1e-13)
        near = truth.min(axis=0) <= 0.5
        within = scene.nearest(points, 0.5)
        np.testing.assert_array_equal(within.found, near)
        np.testing.assert_array_equal(within.body[~near], -1)
        np.testing.assert_array_equal(scene.touches(points, 0.5), near)
        for first, second in zip(found, scene.nearest(points, threads=3)):
            np.testing.assert_array_equal(first, second)

    def test_a_body_that_moves_is_found_where_it_is_and_one_that_is_removed_is_not(self):
        scene, bodies = self.scene(self.POSES)
        points = np.random.default_rng(9).uniform(-1.5, 4, (200, 3))
        moved = [self.POSES[0], ((-1.0, 2.0, 1.0), (0.5, 0.5, -0.5, 0.5)), self.POSES[2]]
        scene.move(bodies[1], *moved[1])
        np.testing.assert_allclose(scene.nearest(points).distance, self.truth(moved, points).min(axis=0), rtol=0, atol=1e-13)
        position, rotation = scene.pose(bodies[1])
        np.testing.assert_array_equal(position, moved[1][0])
        np.testing.assert_allclose(rotation, turn(moved[1][1]), atol=1e-15)
        scene.remove(bodies[0])
        self.assertEqual(len(scene), 2)
        found = scene.nearest(points)
        np.testing.assert_allclose(found.distance, self.truth(moved[1:], points).min(axis=0), rtol=0, atol=1e-13)
        self.assertNotIn(bodies[0], found.body)
        again = scene.add(MESH, *self.POSES[0])
        self.assertNotIn(again, bodies)
        np.testing.assert_allclose(scene.nearest(points).distance, self.truth(moved, points).min(axis=0), rtol=0, atol=1e-13)

    def test_first_hit_stops_at_the_body_in_the_way(self):
        scene, bodies = self.scene(self.POSES)
        hit = scene.first_hit([[4.5, 0.3, -0.2], [0, 0, 9]], [[-2, 0, 0], [9, 9, 9]], 0.01)
        np.testing.assert_array_equal(hit.found, [True, False])
        np.testing.assert_array_equal(hit.body, [bodies[1], -1])
        at = np.array([4.5, 0.3, -0.2]) + hit.fraction[0] * (np.array([-2, 0, 0]) - [4.5, 0.3, -0.2])
        self.assertAlmostEqual(self.truth(self.POSES, at[None]).min(), 0.01, places=9)

    def test_primitives_are_as_far_as_geometry_has_it(self):
        position, orientation = (1.0, -2.0, 0.5), (0.3, -0.5, 0.2, 0.9)
        points = np.random.default_rng(10).uniform(-4, 4, (500, 3))
        seen = (points - position) @ turn(orientation)  # in the body's frame
        half = np.array([0.5, 1.0, 1.5])
        beyond = np.abs(seen) - half
        box = np.where((beyond < 0).all(axis=1), -beyond.max(axis=1), np.linalg.norm(np.maximum(beyond, 0), axis=1))
        flat = np.linalg.norm(np.concatenate([np.maximum(np.abs(seen[:, :2]) - half[:2], 0), seen[:, 2:]], axis=1), axis=1)
        along = seen - np.stack([0 * seen[:, 0], 0 * seen[:, 0], np.clip(seen[:, 2], -0.5, 0.5)], axis=1)
        for shape, truth, triangles in ((touchmark.Box((1, 2, 3)), box, 12), (touchmark.Plane(2 * half[:2]), flat, 2),
                                        (touchmark.Sphere(2), np.abs(np.linalg.norm(seen, axis=1) - 2), 1),
                                        (touchmark.Capsule(1.5, 1), np.abs(np.linalg.norm(along, axis=1) - 1.5), 1)):
            with self.subTest(shape):
                scene = touchmark.Scene()
                body = scene.add(shape, position, orientation)
                found = scene.nearest(points)
                np.testing.assert_allclose(found.distance, truth, rtol=0, atol=1e-13)
                np.testing.assert_allclose(found.point + found.normal * found.distance[:, None], points, atol=1e-13)
                np.testing.assert_array_equal(found.body, body)
                np.testing.assert_array_equal(scene.touches(points, 0.5), truth <= 0.5)
                self.assertEqual(set(found.triangle) - set(range(triangles)), set())

    def test_primitives_of_the_same_sizes_share_a_shape(self):
        scene = touchmark.Scene()
        scene.add(touchmark.Box((1, 2, 3)))
        one = scene.nbytes
        for x in range(1, 100):
            scene.add(touchmark.Box(np.array([1.0, 2.0, 3.0])), (9.0 * x, 0, 0))
        self.assertLess((scene.nbytes - one) / 99, 500)
        self.assertEqual(len(scene), 100)

    def test_sizes_of_primitives_that_are_none_are_refused(self):
        for make, message in ((lambda: touchmark.Box((1, 2)), r"size has the shape \(2,\); it must be \(3,\)"),
                              (lambda: touchmark.Plane(1.0), r"size has the shape \(\); it must be \(2,\)"),
                              (lambda: touchmark.Sphere([1.0]), "radius has the shape .* one number"),
                              (lambda: touchmark.Sphere("large"), "radius holds"),
                              (lambda: touchmark.Scene().add(touchmark.Sphere(0)), "the radius of a sphere is 0"),
                              (lambda: touchmark.Scene().add(touchmark.Capsule(1, -1)), "the length of a capsule is -1"),
                              (lambda: touchmark.Scene().add(touchmark.Box((1, np.nan, 1))), "the size of a box is nan"),
                              (lambda: touchmark.Scene().add(touchmark.Plane((1, 1e31))), "the size of a plane is")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                make()

    def test_an_empty_scene_touches_nothing(self):
        scene = touchmark.Scene()
        self.assertFalse(scene.nearest(POINTS).found.any())
        self.assertFalse(scene.touches(POINTS, np.inf).any())
        self.assertEqual(len(scene), 0)

    def test_what_no_scene_has_is_refused(self):
        scene, bodies = self.scene(self.POSES[:1])
        scene.remove(bodies[0])
        for call, message in ((lambda: scene.move(bodies[0], (0, 0, 0)), "body"), (lambda: scene.remove(bodies[0]), "body"),
                              (lambda: scene.pose(7), "body"), (lambda: scene.pose(-1), "no body -1"),
                              (lambda: scene.add(MESH, (0, 0)), r"position has the shape \(2,\)"),
                              (lambda: scene.add(MESH, (0, 0, np.nan)), "finite"),
                              (lambda: scene.add(MESH, orientation=(0, 0, 0, 0)), "quaternion"),
                              (lambda: scene.add(MESH, orientation=np.eye(3)), r"orientation has the shape \(3, 3\)")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                call()
        with self.assertRaises(TypeError):
            scene.add(VERTICES)
        self.assertEqual(len(scene), 0)

    def test_a_batch_sees_all_of_a_change_or_nothing_of_it(self):
        sheet = touchmark.Mesh([[-9, -9, 0], [9, -9, 0], [0, 18, 0]], [[0, 1, 2]])
        scene = touchmark.Scene()
        body = scene.add(sheet, (0, 0, 1))
        points = np.zeros((4000, 3))
        ended = threading.Event()

        def move():
            for i in range(1000):
                scene.move(body, (0, 0, 1 + i % 2))
            ended.set()
        mover = threading.Thread(target=move)
        mover.start()
        asked = 0
        while not ended.is_set() or asked == 0:
            distances = scene.nearest(points, threads=2).distance
            self.assertIn(distances[0], (1, 2))
            np.testing.assert_array_equal(distances, distances[0])
            asked += 1
        mover.join()


class Updates(unittest.TestCase):
    def test_a_mesh_that_moves_is_asked_where_it_is(self):
        moved = VERTICES + 0.2 * np.sin(3 * VERTICES[:, ::-1])
        truth = distances_by_numpy(moved, FACES, POINTS)
        for kind, options in FORMS:
            with self.subTest(kind.__name__, **options):
                detector = kind(MESH, **options)
                detector.update(moved)
                np.testing.assert_allclose(detector.nearest(POINTS).distance, truth.min(axis=1), rtol=0, atol=1e-14)
                np.testing.assert_array_equal(detector.mesh.vertices, moved)
                np.testing.assert_array_equal(detector.mesh.faces, FACES)
        np.testing.assert_array_equal(MESH.vertices, VERTICES)

    def test_sides_follow(self):
        detector = touchmark.GridGroup(MESH)
        self.assertEqual(detector.side([[0, 0, 0]])[0], Side.INSIDE)
        detector.update(VERTICES + 5.0)
        np.testing.assert_array_equal(detector.side([[0, 0, 0], [5, 5, 5]]), [Side.OUTSIDE, Side.INSIDE])

    def test_what_is_refused_changes_nothing(self):
        detector = touchmark.SphereCluster(MESH)
        before = detector.nearest(POINTS).distance
        bad = VERTICES.copy()
        bad[3, 1] = np.nan
        for vertices, message in ((VERTICES[:-1], f"vertices has {len(VERTICES) - 1} rows"), (bad, "vertex 3 is not finite"),
                                  (VERTICES[:, :2], "vertices has the shape")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                detector.update(vertices)
        np.testing.assert_array_equal(detector.nearest(POINTS).distance, before)

    def test_batches_and_updates_of_several_threads_take_turns(self):
        detector = touchmark.GridGroup(MESH)
        points = np.tile(POINTS, (20, 1))
        places = [VERTICES, VERTICES + 0.5]
        expected = [np.tile(distances_by_numpy(place, FACES, POINTS).min(axis=1), 20) for place in places]
        stop = threading.Event()

        def update():
            i = 0
            while not stop.is_set():
                i = 1 - i
                detector.update(places[i])
        proxy = touchmark.Proxy(detector, (0, 0, 3))
        updater = threading.Thread(target=update)
        updater.start()
        try:
            for _ in range(30):
                distance = detector.nearest(points, threads=2).distance
                self.assertTrue(any(np.allclose(distance, one, rtol=0, atol=1e-13) for one in expected))
                proxy.step((0, 0, 2.9))
        finally:
            stop.set()
            updater.join()


class ContactLists(unittest.TestCase):
    def test_they_are_those_of_numpy_nearest_first(self):
        reaches = np.random.default_rng(2).uniform(0, 0.6, len(POINTS))
        for kind, options in FORMS:
            with self.subTest(kind.__name__, **options):
                found = kind(MESH, **options).contacts(POINTS, reaches)
                self.assertEqual(len(found.ends), len(POINTS))
                self.assertEqual(found.ends[-1], (TRUTH <= reaches[:, None]).sum())
                for i in range(len(POINTS)):
                    rows = found.of(i)
                    self.assertEqual(set(found.triangle[rows]), set(np.flatnonzero(TRUTH[i] <= reaches[i])))
                    np.testing.assert_allclose(found.distance[rows], TRUTH[i, found.triangle[rows]], atol=1e-14)
                    self.assertTrue((np.diff(found.distance[rows]) >= 0).all())
                away = np.repeat(POINTS, np.diff(found.ends, prepend=0), axis=0)
                np.testing.assert_allclose(found.point + found.normal * found.distance[:, None], away, atol=1e-13)

    def test_all_of_a_mesh_fits_and_nothing_gives_nothing(self):
        detector = touchmark.GridGroup(MESH)
        self.assertEqual(detector.contacts(POINTS[:3], np.inf).ends.tolist(), [len(FACES), 2 * len(FACES), 3 * len(FACES)])
        for points in ([], np.zeros((0, 3))):
            self.assertEqual(detector.contacts(points, 1).point.shape, (0, 3))
        nowhere = detector.contacts([[np.nan, 0, 0], [0, 0, 50]], 1)
        self.assertEqual(nowhere.ends.tolist(), [0, 0])
        with self.assertRaises(IndexError):
            nowhere.of(2)
        with self.assertRaisesRegex(ValueError, "reach is -1.0"):
            detector.contacts(POINTS, -1)


class Proxies(unittest.TestCase):
    PLATE = touchmark.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])

    def test_it_is_pushed_back_by_the_depth_of_the_device(self):
        for radius in (0.0, 0.1):
            proxy = touchmark.Proxy(touchmark.AabbTree(self.PLATE), (0, 0, 1), radius=radius, stiffness=200)
            free = proxy.step((0.1, 0.2, 0.5))
            self.assertEqual(free.status, touchmark.ProxyStatus.FREE)
            np.testing.assert_array_equal(free.position, (0.1, 0.2, 0.5))
            np.testing.assert_array_equal(free.force, 0)
            self.assertEqual(free.contacts.shape, (0, 3))
            held = proxy.step((0.1, 0.2, -0.3))
            self.assertEqual(held.status, touchmark.ProxyStatus.IN_CONTACT)
            np.testing.assert_allclose(held.position, (0.1, 0.2, radius), atol=1e-9)
            np.testing.assert_allclose(held.force, (0, 0, 200 * (0.3 + radius)), atol=1e-6)
            np.testing.assert_allclose(held.contacts, [[0, 0, 1]], atol=1e-12)
            np.testing.assert_array_equal(proxy.force_now((0.1, 0.2, -0.3)), held.force)
            np.testing.assert_allclose(proxy.force_now((0.2, 0.2, -0.4)), (0, 0, 200 * (0.4 + radius)), atol=1e-6)
            np.testing.assert_array_equal(proxy.force_now((0, 0, 0.5)), 0)

    def test_it_stays_outside_of_a_mesh_that_it_is_pushed_into(self):
        detector = touchmark.SphereCluster(MESH)
        proxy = touchmark.Proxy(detector, (0, 0, 2), radius=0.05)
        path = np.stack([np.linspace(0, 0.6, 200), np.linspace(0, -0.4, 200), np.linspace(2, 0.1, 200)], axis=1)
        positions = np.array([proxy.step(goal).position for goal in path])
        distances = distances_by_numpy(VERTICES, FACES, positions).min(axis=1)
        self.assertGreater(distances.min(), 0.05 - 1e-12)
        self.assertLess(distances.min(), 0.05 + 1e-9)
        np.testing.assert_array_equal(detector.side(positions), Side.OUTSIDE)

    def test_a_step_ends_where_its_work_does(self):
        detector = touchmark.SphereCluster(MESH)
        proxy = touchmark.Proxy(detector, (0, 0, 2), radius=0.05, max_work=1)
        first = proxy.step((0, 0, 0))
        self.assertTrue(first.unfinished)
        np.testing.assert_array_equal(first.position, (0, 0, 2))
        np.testing.assert_allclose(first.force, (0, 0, 2000))
        self.assertFalse(touchmark.Proxy(detector, (0, 0, 2), radius=0.05, max_work=100000).step((0, 0, 0)).unfinished)
        for wrong in (-1, 1.5, True):
            with self.assertRaisesRegex(ValueError, "max_work is .*; it must be a whole number"):
                touchmark.Proxy(detector, (0, 0, 2), max_work=wrong)
        with self.assertRaisesRegex(ValueError, "keeps to no limit"):
            touchmark.Proxy(touchmark.AabbTree(MESH), (0, 0, 2), max_work=5)

    def test_it_notices_an_update_of_its_detector(self):
        detector = touchmark.GridGroup(self.PLATE)
        proxy = touchmark.Proxy(detector, (0, 0, 1), radius=0.1)
        self.assertEqual(proxy.step((0, 0, 0)).status, touchmark.ProxyStatus.IN_CONTACT)
        detector.update(np.array(self.PLATE.vertices) - [0, 0, 5])
        np.testing.assert_array_equal(proxy.step((0, 0, 0)).position, 0)
        self.assertIs(proxy.detector, detector)

    def test_a_surface_that_an_update_moves_over_it_pushes_it(self):
        for radius in (0, 0.1):
            detector = touchmark.AabbTree(self.PLATE)
            proxy = touchmark.Proxy(detector, (0, 0, 1), radius=radius)
            above = np.array(self.PLATE.vertices) + [0, 0, 3]
            self.assertTrue(proxy.surface_moving(above))
            detector.update(above)
            held = proxy.step((0, 0, 0))
            np.testing.assert_allclose(held.position, (0, 0, 3 + radius), atol=1e-6)
            self.assertEqual(held.status, touchmark.ProxyStatus.IN_CONTACT)
            with self.assertRaisesRegex(ValueError, "vertices has 1 rows"):
                proxy.surface_moving(((0, 0, 0),))
        with self.assertRaisesRegex(ValueError, "does not see how a mesh moves"):
            touchmark.Proxy(touchmark.GridGroup(self.PLATE), (0, 0, 1)).surface_moving(above)

    def test_what_it_cannot_be_made_of_or_follow_is_refused(self):
        detector = touchmark.GridGroup(self.PLATE)
        for call, message in ((lambda: touchmark.Proxy(detector, (0, 0)), r"position has the shape \(2,\)"),
                              (lambda: touchmark.Proxy(detector, (0, 0, np.inf)), "position is not finite"),
                              (lambda: touchmark.Proxy(detector, (0, 0, 1), radius=-1), "radius is -1"),
                              (lambda: touchmark.Proxy(detector, (0, 0, 1), dynamic_friction=1), "more than static_friction"),
                              (lambda: touchmark.Proxy(touchmark.SphereCluster(self.PLATE, precise=False), (0, 0, 1)),
                               "does not decide exactly"),
                              (lambda: touchmark.Proxy(detector, (0, 0, 1)).step([[0, 0, 0]]), "goal has the shape")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                call()
        with self.assertRaises(TypeError):
            touchmark.Proxy(self.PLATE, (0, 0, 1))
        state = touchmark.Proxy(detector, (0, 0, 1)).step((np.nan, 0, 0))
        self.assertEqual(state.status, touchmark.ProxyStatus.UNANSWERED)
        np.testing.assert_array_equal(state.force, 0)


class Examples(unittest.TestCase):
    """Run as the page says: with a script's own folder before all others where Python looks for modules."""

    def run_example(self, name, *arguments):
        script = pathlib.Path(__file__).resolve().parents[2] / "python" / "examples" / name
        done = subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_the_scan_is_compared_and_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder, "deviation.png")
            # The dent is 0.03 deep and the bead 0.015 high, to which noise is added.
            least, most = map(float, self.run_example("deviation.py", "--out", picture).replace(",", "").split()[2:5:2])
            self.assertAlmostEqual(least, -0.03, delta=0.004)
            self.assertAlmostEqual(most, 0.015, delta=0.004)
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_throughput_names_all_that_were_asked(self):
        printed = self.run_example("throughput.py", "--triangles", "500", "--points", "300", "--turns", "1")
        for name in ("scattered points", "points along a path", "GridGroup", "SphereCluster"):
            self.assertIn(name, printed)


if __name__ == "__main__":
    unittest.main()
