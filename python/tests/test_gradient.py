# SPDX-License-Identifier: BSD-3-Clause
"""The example for PyTorch moves the model to the pose."""
import subprocess
import sys

import pytest
from conftest import MESHES, SOURCE

pytest.importorskip("torch", reason="python3-torch is missing")


def test_loss_vanishes():
    names = ("limb_cage", "limb_model", "limb_cage_pose")
    found = subprocess.run(
        [sys.executable, SOURCE / "examples/gradient_of_loss.py", *(MESHES / f"3d/{name}.obj" for name in names)],
        capture_output=True, text=True, timeout=280,
    )
    assert found.returncode == 0, found.stderr
    losses = [float(line.split()[1]) for line in found.stdout.splitlines()]
    assert losses[-1] < 1e-3 * losses[0], losses
