"""Builds the wheel: setuptools packs it, and CMake compiles the native part with the flags of the rest of the project."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pybind11
import setuptools
import setuptools.build_meta
from setuptools.command.build_ext import build_ext

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

ROOT = pathlib.Path(__file__).resolve().parents[1]

# For x86-64: the newest symbols of the libraries that a platform of PEP 600 has, as auditwheel's policies list them.
PLATFORMS = {"manylinux_2_36": {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0)},
             "manylinux_2_40": {"GLIBC": (2, 40), "GLIBCXX": (3, 4, 33), "CXXABI": (1, 3, 15), "GCC": (14, 0, 0)}}
LIBRARIES = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "libstdc++.so.6", "libpthread.so.0", "ld-linux-x86-64.so.2"}


def platform_of(headers):
    """The oldest platform that has all that a library needs, by what objdump -p prints of it; None if there is none."""
    if not set(re.findall(r"^ +NEEDED +(\S+)", headers, re.M)) <= LIBRARIES:
        return None
    needed = [name.rpartition("_") for name in re.findall(r"^ +0x\w+ 0x\w+ \d+ (\S+)$", headers, re.M)]
    for platform, newest in PLATFORMS.items():
        if all(re.fullmatch(r"[\d.]+", number) and tuple(map(int, number.split("."))) <= newest.get(kind, ())
               for kind, _, number in needed):
            return platform
    return None


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(touchmark VERSION (\d+\.\d+\.\d+)", text)[1]


class BuildWithCMake(build_ext):
    """Has CMake build the module and put it where setuptools looks for it."""

    def build_extension(self, ext):
        made = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        folder = ROOT / "build" / "python"  # as deep as those of the presets, so that the compiler's cache is shared
        folder.mkdir(parents=True, exist_ok=True)
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DTOUCHMARK_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
                   f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", f"-DTOUCHMARK_PYTHON_FOLDER={made.parent}"]
        options += [f"-DTOUCHMARK_BUILD_{part}=OFF" for part in ("BENCH", "TESTS", "MESH_IO", "C")] + ["-DTOUCHMARK_INSTALL=OFF"]
        if shutil.which("ninja"):
            options += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(folder), *options], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "touchmark_python", "--parallel",
                        os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))], check=True)


class TaggedWheel(bdist_wheel):
    """Names the platform by what the native part needs, once that is built."""

    def get_tag(self):
        python, abi, platform = super().get_tag()
        native, = pathlib.Path(self.bdist_dir).glob("touchmark/_native*.so")
        headers = subprocess.run(["objdump", "-p", str(native)], capture_output=True, text=True, check=True).stdout
        found = platform_of(headers) if platform == "linux_x86_64" else None
        return python, abi, f"{found}_x86_64" if found else platform


class Backend(setuptools.build_meta._BuildMetaBackend):  # as setuptools' own pages have it
    def run_setup(self, setup_script="setup.py"):
        build = ROOT / "build" / "wheel"
        build.mkdir(parents=True, exist_ok=True)
        setuptools.setup(
            version=version(),
            packages=["touchmark"],
            package_dir={"touchmark": "python/touchmark"},
            package_data={"touchmark": ["py.typed", "*.pyi"]},
            ext_modules=[setuptools.Extension("touchmark._native", sources=[])],
            cmdclass={"build_ext": BuildWithCMake, "bdist_wheel": TaggedWheel},
            options={"build": {"build_base": str(build)}, "egg_info": {"egg_base": str(build)}},
        )


_backend = Backend()
build_wheel = _backend.build_wheel
build_sdist = _backend.build_sdist
get_requires_for_build_wheel = _backend.get_requires_for_build_wheel
get_requires_for_build_sdist = _backend.get_requires_for_build_sdist
prepare_metadata_for_build_wheel = _backend.prepare_metadata_for_build_wheel
