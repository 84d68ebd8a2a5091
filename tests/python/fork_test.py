#!/usr/bin/python3
"""Forks beside threads that use the Python module, and sends its objects to other processes.

usage: PYTHONPATH=FOLDER fork_test.py
"""
import copy
import multiprocessing
import os
import pickle
import signal
import threading
import time
import traceback
import unittest
from unittest import mock

import numpy as np

import touchmark

RANDOM = np.random.default_rng(3)
CORNERS = RANDOM.uniform(-1, 1, (1500, 1, 3))
PLACES = [(CORNERS + RANDOM.uniform(-0.05, 0.05, (1500, 3, 3))).reshape(-1, 3) for _ in range(2)]
FACES = np.arange(4500).reshape(-1, 3)
MESH = touchmark.Mesh(PLACES[0], FACES)
POINTS = RANDOM.uniform(-1.2, 1.2, (20000, 3))
FEW = POINTS[:200]
CUBE = touchmark.Mesh([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
                      [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                       [0, 6, 4], [1, 5, 7], [1, 7, 3]])
FORMS = [(touchmark.BruteForce, {}), (touchmark.AabbTree, {"leaf_size": 2, "certified": False}),
         (touchmark.GridGroup, {"cell": "3%", "build": "lazy"}), (touchmark.GridGroup, {"lookup": "scan", "shape": "sphere"}),
         (touchmark.SphereCluster, {}), (touchmark.SphereCluster, {"clustering": 0.05, "build": "lazy"})]


def distances(vertices):
    return touchmark.BruteForce(touchmark.Mesh(vertices, FACES)).nearest(FEW).distance


def assert_same(a, b):
    for one, other in zip(a, b):
        np.testing.assert_array_equal(one, other)


class Fixed(touchmark.SphereCluster):
    """A class of a user's own."""

    def __init__(self, mesh, name):
        super().__init__(mesh, precise=False)
        self.name = name


def nearest_in(asked):
    """For other processes."""
    return asked.nearest(FEW)


class Forks(unittest.TestCase):
    def setUp(self):
        self.expected = [distances(place) for place in PLACES]
        self.detector = touchmark.GridGroup(MESH)
        self.cube = touchmark.AabbTree(CUBE)
        self.lazy = touchmark.SphereCluster(MESH, build="lazy")
        self.lazy_grid = touchmark.GridGroup(MESH, build="lazy")
        self.scene = touchmark.Scene()
        self.body = self.scene.add(MESH)
        self.proxy = touchmark.Proxy(self.cube, (0, 0, 3), radius=0.5)

    def run_in_child(self, check):
        """Forks, and returns how the child ended after check(): 0, or what went wrong."""
        child = os.fork()
        if child == 0:
            try:
                check()
                os._exit(0)
            except BaseException:
                traceback.print_exc()
                os._exit(1)
        return self.wait(child)

    def wait(self, child):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status)
            time.sleep(0.001)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return "it hangs"

    def check_all(self):
        """Uses everything, also by a thread of its own; what another thread changed is all changed, or not at all."""
        thread = threading.Thread(target=self.cube.side, args=(FEW,))
        thread.start()
        found = self.detector.nearest(FEW, threads=2).distance
        self.assertTrue(any(np.array_equal(found, one) for one in self.expected))
        self.detector.update(PLACES[1])
        np.testing.assert_array_equal(self.detector.nearest(FEW).distance, self.expected[1])
        for lazy in (self.lazy, self.lazy_grid):
            np.testing.assert_array_equal(lazy.nearest(FEW).distance, self.expected[0])
        x = self.scene.pose(self.body)[0][0]
        self.assertEqual(self.scene.touches(np.array(MESH.vertices[:9]) + [x, 0, 0], 1e-9).tolist(), [True] * 9)
        self.scene.move(self.body, (0, 0, 5))
        self.scene.add(touchmark.Sphere(1), (9, 9, 9))
        np.testing.assert_array_equal(self.cube.side(FEW) == touchmark.Side.INSIDE, (abs(FEW) < 1).all(axis=1))
        self.cube.update(CUBE.vertices)
        self.proxy.place((0, 0, 3))
        np.testing.assert_allclose(self.proxy.step((0, 0, 1)).position, (0, 0, 1.5), atol=1e-9)
        thread.join()

    def fork_beside(self, *others, children=5):
        stop = threading.Event()

        def repeat(other):
            i = 0
            while not stop.is_set():
                i += 1
                other(i)
        threads = [threading.Thread(target=repeat, args=(other,)) for other in others]
        for thread in threads:
            thread.start()
        try:
            for _ in range(children):
                time.sleep(0.005)
                self.assertEqual(self.run_in_child(self.check_all), 0)
        finally:
            stop.set()
            for thread in threads:
                thread.join()

    def test_beside_batches(self):
        self.fork_beside(lambda i: self.detector.nearest(POINTS, threads=0), lambda i: self.scene.nearest(POINTS))

    def test_beside_updates_of_two_detectors(self):
        self.fork_beside(lambda i: self.detector.update(PLACES[i % 2]), lambda i: self.cube.update(CUBE.vertices))

    def test_beside_bodies_that_come_move_and_go(self):
        def change(i):
            self.scene.move(self.body, (i % 7, 0, 0))
            self.scene.remove(self.scene.add(touchmark.Box((1, 1, 1 + i % 3)), (0, 20, 0)))
        self.fork_beside(change)

    def test_beside_sides_that_are_found_anew(self):
        def find(i):
            self.cube.update(CUBE.vertices)
            self.cube.side(FEW)
        self.fork_beside(find)

    def test_beside_a_proxy_whose_detector_is_updated(self):
        self.fork_beside(lambda i: self.proxy.step((0, 0, i % 3)), lambda i: self.cube.update(CUBE.vertices))

    def test_beside_queries_that_build_lazily(self):
        def build(i):
            self.lazy = touchmark.SphereCluster(MESH, build="lazy")
            self.lazy_grid = touchmark.GridGroup(MESH, build="lazy")
            self.lazy.nearest(POINTS[::10])
            self.lazy_grid.nearest(POINTS[::10])
        self.fork_beside(build, children=10)

    def test_a_child_forks_again_beside_threads_of_its_own(self):
        def check():
            self.check_all()
            self.detector.update(PLACES[0])
            self.scene.move(self.body, (0, 0, 0))
            self.fork_beside(lambda i: self.detector.update(PLACES[i % 2]), children=2)
        self.assertEqual(self.run_in_child(check), 0)

    def test_a_batch_goes_on_in_the_child_that_a_signal_handler_forks(self):
        points = np.tile(POINTS, (10, 1))
        detector = touchmark.BruteForce(CUBE)
        expected = touchmark.AabbTree(CUBE).nearest(points)
        children = []
        before = signal.signal(signal.SIGALRM, lambda *_: children.append(os.fork()))
        parent = os.getpid()
        try:
            for threads in (1, 2):
                children.clear()
                found = None
                while not children:  # until the batch takes long enough
                    points, expected = (points, expected) if found is None else (
                        np.tile(points, (2, 1)), [np.concatenate([part, part]) for part in expected])
                    signal.setitimer(signal.ITIMER_REAL, 0.02)
                    found = detector.nearest(points, threads=threads)
                    signal.setitimer(signal.ITIMER_REAL, 0)
                try:
                    assert_same(found, expected)
                    detector.update(CUBE.vertices)
                    wrong = 0
                except AssertionError:
                    wrong = 1
                if os.getpid() != parent:
                    os._exit(wrong)
                self.assertEqual([wrong, self.wait(children[0])], [0, 0])
        finally:
            signal.signal(signal.SIGALRM, before)


class Pickles(unittest.TestCase):
    def copies(self, original):
        """By every protocol that there is for classes with slots, and as copy makes them."""
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            yield pickle.loads(pickle.dumps(original, protocol))
        yield copy.copy(original)
        yield copy.deepcopy(original)

    def test_a_mesh(self):
        for mesh in self.copies(MESH):
            np.testing.assert_array_equal(mesh.vertices, MESH.vertices)
            np.testing.assert_array_equal(mesh.faces, MESH.faces)

    def test_a_detector_with_its_options_and_its_last_update(self):
        for kind, options in FORMS:
            detector = kind(MESH, **options)
            detector.update(PLACES[1])
            expected = detector.nearest(FEW)
            with self.subTest(kind.__name__, **options):
                for other in self.copies(detector):
                    self.assertIs(type(other), kind)
                    assert_same(other.nearest(FEW), expected)
                    other.update(PLACES[0])
                assert_same(detector.nearest(FEW), expected)

    def test_a_detector_of_a_class_of_the_users(self):
        detector = Fixed(MESH, "left hand")
        for other in self.copies(detector):
            self.assertEqual((type(other), other.name), (Fixed, "left hand"))
            assert_same(other.nearest(FEW), detector.nearest(FEW))

    def test_a_scene_with_its_poses_and_its_numbers(self):
        scene = touchmark.Scene()
        shapes = [MESH, touchmark.Box((1, 2, 3)), touchmark.Sphere(0.1), touchmark.Capsule(0.1, 0.2), touchmark.Plane((1, 2))]
        bodies = [scene.add(shape, RANDOM.uniform(-1, 1, 3), RANDOM.uniform(-1, 1, 4)) for shape in shapes * 3]
        for _ in range(3):
            scene.remove(bodies[4])
            bodies[4] = scene.add(shapes[2], (0, 0, 1))
        gone = [bodies.pop(9), bodies.pop(2)]
        for body in gone:
            scene.remove(body)
        ways = FEW[:100], FEW[100:]
        nearest, hit = scene.nearest(FEW), scene.first_hit(*ways, 0.01)
        before = scene.nbytes
        for other in [*self.copies(scene), *self.copies(pickle.loads(pickle.dumps(scene)))]:
            self.assertEqual(len(other), len(scene))
            assert_same(other.nearest(FEW), nearest)
            assert_same(other.first_hit(*ways, 0.01), hit)
            for body in bodies:
                assert_same(other.pose(body), scene.pose(body))
            for body in gone:
                with self.assertRaisesRegex(ValueError, f"no body {body}$"):
                    other.pose(body)
            added = [other.add(shapes[1]) for _ in range(4)]
            self.assertFalse({*gone, *bodies} & {*added})
            other.remove(bodies[4])
            self.assertNotIn(other.add(shapes[0]), bodies + gone + added)
        self.assertEqual(scene.nbytes, before)
        self.assertEqual(len(pickle.loads(pickle.dumps(touchmark.Scene()))), 0)

    def test_a_mesh_is_shared_in_what_is_pickled_together(self):
        mesh, scene = pickle.loads(pickle.dumps((MESH, self.scene_of(MESH))))
        before = scene.nbytes
        scene.add(mesh)
        self.assertLess(scene.nbytes, 1.1 * before)
        self.assertLess(len(pickle.dumps((MESH, scene, touchmark.AabbTree(MESH)))), 2.5 * len(pickle.dumps(MESH)))

    @staticmethod
    def scene_of(shape):
        scene = touchmark.Scene()
        scene.add(shape)
        return scene

    def test_a_scene_that_other_threads_change(self):
        scene = touchmark.Scene()
        stop = threading.Event()

        def change():
            for size in range(1, 300):
                scene.remove(scene.add(touchmark.Sphere(size)))
                if stop.is_set():
                    return
        thread = threading.Thread(target=change)
        thread.start()
        try:
            while thread.is_alive():
                other = pickle.loads(pickle.dumps(scene))
                other.remove(other.add(touchmark.Sphere(1)))
                other.add(touchmark.Sphere(max((shape.radius for shape in other._shapes), default=1)))
        finally:
            stop.set()
            thread.join()

    def test_other_processes_get_them(self):
        asked = [touchmark.SphereCluster(MESH), Fixed(MESH, "right hand"), self.scene_of(MESH), self.scene_of(touchmark.Box((1, 1, 1)))]
        for method in ("fork", "spawn"):
            with self.subTest(method), multiprocessing.get_context(method).Pool(1) as pool:
                for one, found in zip(asked, pool.map(nearest_in, asked)):
                    assert_same(found, one.nearest(FEW))

    def test_what_another_version_pickled_is_refused(self):
        for what in (MESH, touchmark.AabbTree(MESH), self.scene_of(MESH)):
            with mock.patch.object(touchmark, "__version__", "0.0.1"):
                pickled = pickle.dumps(what)
            with self.assertRaisesRegex(ValueError, f"by touchmark 0.0.1, and this is touchmark {touchmark.__version__}: .* anew"):
                pickle.loads(pickled)

    def test_a_proxy_is_refused(self):
        proxy = touchmark.Proxy(touchmark.AabbTree(CUBE), (0, 0, 3))
        for make in (pickle.dumps, copy.copy, copy.deepcopy):
            with self.assertRaisesRegex(TypeError, "Proxy can be neither pickled nor copied"):
                make(proxy)


if __name__ == "__main__":
    unittest.main()
