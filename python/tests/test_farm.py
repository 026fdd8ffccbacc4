# SPDX-License-Identifier: BSD-3-Clause
"""The example for Dask binds a folder of models with two workers, and reports failures."""
import shutil
import subprocess
import sys

import flbc
import pytest
from conftest import MESHES, SOURCE

pytest.importorskip("distributed", reason="python3-distributed is missing")


def test_folder_is_bound(tmp_path):
    for name in ("limb", "torus", "knot"):
        shutil.copy(MESHES / f"3d/{name}_model.obj", tmp_path / f"{name}.obj")
    (tmp_path / "broken.obj").write_text("v 0 0 zero\n")
    found = subprocess.run(
        [sys.executable, SOURCE / "examples/bind_folder.py", tmp_path],
        capture_output=True, text=True, timeout=280,
    )
    assert found.returncode == 0, found.stderr
    lines = dict(line.split(": ", 1) for line in found.stdout.splitlines())
    assert "broken.obj:1" in lines.pop("broken.obj").replace(", line ", ":"), found.stdout
    assert set(lines) == {"limb.obj", "torus.obj", "knot.obj"}
    for name, text in lines.items():
        assert text.endswith("control points"), text
        vertices, _ = flbc.read_model(tmp_path / name)
        binding = flbc.load_binding(tmp_path / name.replace(".obj", ".npz"))
        assert binding.weights.shape == (len(vertices), len(binding.cage))
        assert flbc.check(binding.cage, vertices, binding.weights) == []
