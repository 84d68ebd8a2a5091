#!/usr/bin/python3
"""The files of scripts/packaging: their versions, what they depend on and the options that they set are the project's."""
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "scripts" / "packaging"
RELEASE = ROOT / ".github" / "workflows" / "release.yml"
OPTIONS = set(re.findall(r"^option\((TOUCHMARK_\w+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M))

# What a port may call, made to write down with what it was called; and a folder to install into.
VCPKG = """
set(PORT touchmark)
set(CURRENT_PACKAGES_DIR {folder})
foreach(name check_linkage cmake_configure cmake_install cmake_config_fixup fixup_pkgconfig install_copyright)
  cmake_language(EVAL CODE "function(vcpkg_${{name}})\\n message(\\"vcpkg_${{name}} \\${{ARGN}}\\")\\nendfunction()")
endforeach()
function(vcpkg_check_features)
  set(FEATURE_OPTIONS -DTOUCHMARK_BUILD_MESH_IO=OFF PARENT_SCOPE)
endfunction()
include({port})
"""


class Packaging(unittest.TestCase):
    def expect_options_of_the_project(self, text):
        options = set(re.findall(r"-D(TOUCHMARK_\w+)=", text))
        self.assertGreater(len(options), 2)
        self.assertLessEqual(options, OPTIONS)

    def test_all_have_the_version_of_the_project(self):
        done = subprocess.run([PACKAGING / "version", "check"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_a_file_with_another_version_is_named(self):
        names = 'eval "$(sed -n "/^files=/,/)$/p" "$0")"; echo "${files[@]}"'
        files = set(subprocess.run(["bash", "-c", names, PACKAGING / "version"], capture_output=True, text=True, check=True).stdout.split())
        self.assertGreater(len(files), 7)
        with tempfile.TemporaryDirectory() as folder:
            for name in [*files, "scripts/packaging/version"]:
                pathlib.Path(folder, name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, pathlib.Path(folder, name))
            command = pathlib.Path(folder, "scripts", "packaging", "version")
            for name in files - {"CMakeLists.txt"}:
                subprocess.run([command, "9.8.7"], check=True)
                subprocess.run([command, "check"], check=True)
                shutil.copy(ROOT / name, pathlib.Path(folder, name))
                done = subprocess.run([command, "check"], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"version: {name} has not 9.8.7", done.stderr)

    def test_the_manifest_of_vcpkg_is_one(self):
        port = json.loads((PACKAGING / "vcpkg" / "vcpkg.json").read_text(encoding="utf-8"))
        named = [port["name"], *port["features"]]
        for entry in port["dependencies"] + [entry for feature in port["features"].values() for entry in feature["dependencies"]]:
            named.append(entry if isinstance(entry, str) else entry["name"])
        for name in named:
            self.assertRegex(name, r"^[a-z0-9]+(-[a-z0-9]+)*$")
        self.assertLess({"eigen3", "assimp", "pugixml", "vcpkg-cmake"}, set(named))

    def test_the_port_calls_what_vcpkg_has_with_options_that_the_project_has(self):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder, "run.cmake")
            script.write_text(VCPKG.format(folder=folder, port=PACKAGING / "vcpkg" / "portfile.cmake"), encoding="utf-8")
            done = subprocess.run(["cmake", "-P", script], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(pathlib.Path(folder, "share", "touchmark", "usage").exists())
        called = dict(line.split(" ", 1) for line in done.stderr.splitlines() if line.startswith("vcpkg_") and " " in line)
        configured = called["vcpkg_cmake_configure"].split(";")
        self.assertEqual(pathlib.Path(configured[configured.index("SOURCE_PATH") + 1]), ROOT)
        self.expect_options_of_the_project(called["vcpkg_cmake_configure"])

    def test_the_recipe_builds_with_options_that_the_project_has(self):
        recipe = yaml.safe_load((PACKAGING / "conda" / "recipe.yaml").read_text(encoding="utf-8"))
        library, module = recipe["outputs"]
        self.expect_options_of_the_project(" ".join(library["build"]["script"]))
        pyproject = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
        for needed in re.findall(r'"(\w+>=[\d.]+)"', pyproject):
            name, least = needed.split(">=")
            wanted = module["requirements"]["run" if name == "numpy" else "host"]
            self.assertIn(f"{name} >={least}", wanted)
        self.assertTrue((PACKAGING / "conda" / recipe["source"]["path"] / "pyproject.toml").exists())

    @unittest.skipUnless(shutil.which("yamllint"), "yamllint is not installed: scripts/setup develop")
    def test_yamllint_is_content(self):
        done = subprocess.run(["yamllint", "--strict", "-c", PACKAGING / ".yamllint", PACKAGING, RELEASE],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.stdout, "")

    def test_what_is_not_built_is_not_tried(self):
        for name, *words in (("tarball", "try", "/no/such"), ("wheel", "try", "trixie", "/no/such")):
            done = subprocess.run([PACKAGING / name, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, f"^{name}: .*/no/such.*: run scripts/packaging/{name} build\n$")

    def test_the_release_runs_commands_that_are_there_and_in_the_checklist(self):
        release = yaml.safe_load(RELEASE.read_text(encoding="utf-8"))
        steps = "\n".join(step.get("run", "") for job in release["jobs"].values() for step in job["steps"])
        commands = set(re.findall(r"scripts/[\w/]+ \w+", steps))
        self.assertEqual(len(commands), 8)
        checklist = (ROOT / "docs" / "releasing.md").read_text(encoding="utf-8")
        self.assertEqual([command for command in commands if command not in checklist or not (ROOT / command.split()[0]).exists()], [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
