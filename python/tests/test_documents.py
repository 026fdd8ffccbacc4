# SPDX-License-Identifier: BSD-3-Clause
"""The Python code of the README and of the tutorial runs as printed."""
import importlib.util
import os
import re
import subprocess
import sys

import pytest
from conftest import MESHES, SOURCE

pytest.importorskip("matplotlib", reason="python3-matplotlib is missing")


@pytest.mark.parametrize(
    "page, files",
    [
        ("README.md", ["function.png"]),
        ("docs/tutorials/python.md",
         ["function.png", "moved.ply", "model.html", "model.glb"]),
    ],
)
def test_code_runs(tmp_path, page, files):
    (tmp_path / "meshes").symlink_to(MESHES)
    kinds = "python( torch)?" if importlib.util.find_spec("torch") else "python()"
    text = (SOURCE / page).read_text()
    blocks = [code for _, code in re.findall(rf"^```{kinds}\n(.*?)^```$", text, re.M | re.S)]
    assert blocks
    environment = {**os.environ, "MPLBACKEND": "agg"}
    found = subprocess.run(
        [sys.executable, "-c", "".join(blocks)],
        cwd=tmp_path, env=environment, capture_output=True, text=True,
    )
    assert found.returncode == 0, found.stderr
    for file in files:
        assert (tmp_path / file).stat().st_size > 1000
