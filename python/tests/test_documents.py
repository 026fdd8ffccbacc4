# SPDX-License-Identifier: BSD-3-Clause
"""The Python code of the README and of the tutorial, and examples that need other modules, run as printed."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys

import flbc
import numpy as np
import pytest
from conftest import MESHES, SOURCE


def run(*arguments, **options):
    found = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, timeout=280,
                           **options)
    assert found.returncode == 0, found.stderr
    return found.stdout


@pytest.mark.parametrize(
    "page, files",
    [
        ("README.md", ["moved.ply"]),
        ("docs/tutorials/python.md",
         ["function.png", "moved.ply", "model.html", "model.glb"]),
    ],
)
def test_code_runs(tmp_path, page, files):
    pytest.importorskip("matplotlib", reason="python3-matplotlib is missing")
    (tmp_path / "meshes").symlink_to(MESHES)
    kinds = "python( torch)?" if importlib.util.find_spec("torch") else "python()"
    text = (SOURCE / page).read_text()
    blocks = [code for _, code in re.findall(rf"^```{kinds}\n(.*?)^```$", text, re.M | re.S)]
    assert blocks
    run("-c", "".join(blocks), cwd=tmp_path, env={**os.environ, "MPLBACKEND": "agg"})
    for file in files:
        assert (tmp_path / file).stat().st_size > 1000


def test_pytorch_moves_the_model_to_the_pose():
    pytest.importorskip("torch", reason="python3-torch is missing")
    names = ("limb_cage", "limb_model", "limb_cage_pose")
    printed = run(SOURCE / "examples/gradient_of_loss.py", *(MESHES / f"3d/{name}.obj" for name in names))
    losses = [float(line.split()[1]) for line in printed.splitlines()]
    assert losses[-1] < 1e-3 * losses[0], losses


def test_duct_bends_inside_the_cage_alone(tmp_path):
    printed = run(SOURCE / "examples/duct.py", tmp_path / "out")
    rows = [line.split() for line in printed.splitlines()[1:6]]
    assert [row[1] for row in rows[:3]] == ["0", "0", "0"]
    jacobians = [float(row[2]) for row in rows]
    assert jacobians == sorted(jacobians, reverse=True)
    points, wall = flbc.read_model(tmp_path / "out/duct.su2")
    outside = (np.abs(points[:, 0] - 1.5) > 0.75) | (points[:, 2] > 0.7)
    for k in range(1, 6):
        moved, faces = flbc.read_model(tmp_path / f"out/duct_{k}.su2")
        assert (moved[outside] == points[outside]).all()
        assert abs(moved - points).max() > 0.1 * k
        assert np.array_equal(faces, wall)


def test_dask_binds_a_folder_and_reports_failures(tmp_path):
    pytest.importorskip("distributed", reason="python3-distributed is missing")
    for name in ("limb", "torus", "knot"):
        shutil.copy(MESHES / f"3d/{name}_model.obj", tmp_path / f"{name}.obj")
    (tmp_path / "broken.obj").write_text("v 0 0 zero\n")
    printed = run(SOURCE / "examples/bind_folder.py", tmp_path)
    lines = dict(line.split(": ", 1) for line in printed.splitlines())
    assert "broken.obj:1" in lines.pop("broken.obj").replace(", line ", ":"), printed
    assert set(lines) == {"limb.obj", "torus.obj", "knot.obj"}
    for name, text in lines.items():
        assert text.endswith("control points"), text
        vertices, _ = flbc.read_model(tmp_path / name)
        binding = flbc.load_binding(tmp_path / name.replace(".obj", ".npz"))
        assert binding.weights.shape == (len(vertices), len(binding.cage))
        assert flbc.check(binding.cage, vertices, binding.weights) == []
