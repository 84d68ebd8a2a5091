#!/usr/bin/python3
"""Files that assimp reads, in a process of its own: what becomes of the program where that process ends early.

Argument: the program.
"""
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
CRASHES_ASSIMP_5_2 = "<mesh><submeshes><submesh"  # as .mesh.xml: it reads beyond the end
TRIANGLE_RAW = "part\n0 0 0 1 0 0 0 1 0\n"
NOBODY = 65534


class AssimpProcess(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def run_program(self, *arguments, **options):
        return subprocess.run([options.pop("program", PROGRAM), *arguments], capture_output=True, text=True, check=False,
                              timeout=120, **options)

    def test_a_crash_is_one_line_and_status_2(self):
        path = self.file("part.mesh.xml", CRASHES_ASSIMP_5_2)
        probes = self.file("probes.csv", "x,y,z\n0,0,0\n")
        for command in (("mesh", "info", path), ("query", "--scene", path, "--trajectory", probes, "--detector", "brute-force")):
            ended = self.run_program(*command)
            self.assertEqual((ended.returncode, ended.stdout), (2, ""), ended.stderr)
            self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
            self.assertIn("part.mesh.xml: assimp ", ended.stderr)

    def test_a_mesh_comes_whole_and_without_a_remark(self):
        ended = self.run_program("mesh", "info", self.file("part.raw", TRIANGLE_RAW))
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("triangles: 1\n", ended.stdout)
        self.assertNotIn("remark", ended.stdout)

    def test_without_another_process_assimp_runs_inside_and_info_says_so(self):
        if os.geteuid() != 0:
            self.skipTest("only root can become a user who may have no process more")
        program = self.folder / "touchmark"
        shutil.copy(PROGRAM, program)
        path = self.file("part.raw", TRIANGLE_RAW)
        self.folder.chmod(0o755)

        def become_a_user_with_one_process():
            resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
            os.setgroups([])
            os.setgid(NOBODY)
            os.setuid(NOBODY)
        ended = self.run_program("mesh", "info", path, program=program, preexec_fn=become_a_user_with_one_process)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("triangles: 1\n", ended.stdout)
        self.assertIn("remark: assimp read it in the program's own process", ended.stdout)


if __name__ == "__main__":
    unittest.main()
