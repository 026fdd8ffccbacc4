# SPDX-License-Identifier: BSD-3-Clause
"""A wheel is built without a network, and works where it is installed."""
import os
import re
import subprocess
import sys
import zipfile
from importlib.util import find_spec

import pytest
from conftest import SOURCE

missing = [name for name in ("pip", "wheel", "setuptools") if find_spec(name) is None]
pytestmark = pytest.mark.skipif(bool(missing), reason=f"missing: {missing}")


def test_wheel(tmp_path):
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    offline = ["--no-deps", "--no-index"]
    source = tmp_path / "python"
    # The build leaves files in the folder.
    for part in ("python", "cmake"):
        subprocess.run(["cp", "-r", SOURCE / part, tmp_path / part], check=True)
    subprocess.run(
        [*pip, "wheel", ".", "--no-build-isolation", *offline, "-w", tmp_path],
        cwd=source, check=True, capture_output=True,
    )
    wheel = next(tmp_path.glob("flbc-*.whl"))
    names = zipfile.ZipFile(wheel).namelist()
    for file in ("__init__.py", "_solve.py", "_binding.py", "_core.pyi", "py.typed"):
        assert f"flbc/{file}" in names
    metadata = next(name for name in names if name.endswith("/METADATA"))
    license = re.search(r"^License: (.*)$", zipfile.ZipFile(wheel).read(metadata).decode(), re.M)[1]
    if "FLBC_PROGRAM" in os.environ:  # has the same libraries
        version = subprocess.run([os.environ["FLBC_PROGRAM"], "--version"], capture_output=True, text=True, check=True)
        assert f"license of this program: {license}" in version.stdout
    target = tmp_path / "target"
    subprocess.run([*pip, "install", *offline, "--target", target, wheel], check=True)
    code = "import flbc; c = flbc.Cage([[0, 0], [1, 0], [0, 1]]); " \
        "print(flbc.__file__, flbc.solve(c, flbc.mesh(c, vertices=100)).converged)"
    environment = {**os.environ, "PYTHONPATH": str(target)}
    found = subprocess.run(
        [sys.executable, "-c", code], env=environment, cwd=tmp_path, capture_output=True, text=True,
        check=True,
    )
    assert found.stdout == f"{target}/flbc/__init__.py True\n"
