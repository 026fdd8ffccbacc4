# SPDX-License-Identifier: BSD-3-Clause
"""Lets CMake build and install the module into the wheel.

FLBC_BUILD_DIR names a finished build to use, so that nothing is compiled twice. CMAKE_ARGS has
further arguments, such as -DFLBC_WITH_CGAL=OFF.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"FLBC_VERSION (\S+)\)", (HERE.parent / "cmake/version.cmake").read_text())


def license_of_wheel():
    """The strictest license of the libraries in it (docs/install.md)."""
    build = os.environ.get("FLBC_BUILD_DIR")
    options = (pathlib.Path(build) / "CMakeCache.txt").read_text() if build else os.environ.get("CMAKE_ARGS", "")
    for library, license in (("TETGEN", "AGPL-3.0-or-later"), ("CGAL", "GPL-3.0-or-later"),
                             ("CHOLMOD", "GPL-2.0-or-later")):
        if not re.search(rf"FLBC_WITH_{library}(:BOOL)?=OFF", options):
            return license
    return "BSD-3-Clause"


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = os.environ.get("FLBC_BUILD_DIR")
        if build is None:
            build = str(pathlib.Path(self.build_temp).resolve())
            subprocess.run(
                ["cmake", "-S", HERE.parent, "-B", build, "-DCMAKE_BUILD_TYPE=Release"]
                + [f"-DFLBC_BUILD_{part}=OFF" for part in ("APPS", "TESTS", "BENCHMARKS")]
                + ["-DFLBC_BUILD_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"]
                + shlex.split(os.environ.get("CMAKE_ARGS", "")),
                check=True,
            )
            subprocess.run(
                ["cmake", "--build", build, "--target", "flbc_python", "--parallel"], check=True
            )
        prefix = pathlib.Path(self.build_temp).resolve() / "prefix"
        subprocess.run(
            ["cmake", "--install", build, "--component", "python", "--strip", "--prefix", prefix],
            check=True,
        )
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next(prefix.rglob("_core.*.so")), target)


setup(
    version=VERSION.group(1),
    license=license_of_wheel(),
    ext_modules=[Extension("flbc._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    package_data={"flbc": ["_core.pyi", "py.typed"]},
)
