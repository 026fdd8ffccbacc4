# SPDX-License-Identifier: BSD-3-Clause
import importlib.util
import os
import pathlib
import subprocess

import flbc
import numpy as np
import pytest

SOURCE = pathlib.Path(os.environ["FLBC_SOURCE_DIR"])
MESHES = SOURCE / "meshes"


def module_at(path):
    """A script as a module, without running it as a program."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def program():
    """Runs the program flbc."""
    if "FLBC_PROGRAM" not in os.environ:
        pytest.skip("the program is not built")

    def run(*arguments):
        command = [os.environ["FLBC_PROGRAM"], *map(str, arguments)]
        subprocess.run(command, check=True, capture_output=True)

    return run


@pytest.fixture(scope="session")
def square():
    return flbc.Cage([[0, 0], [1, 0], [1, 1], [0, 1]])


@pytest.fixture(scope="session")
def flat(square):
    """A solution in 2D."""
    return flbc.solve(square, flbc.mesh(square, vertices=300))


@pytest.fixture(scope="session")
def limb():
    """A cage and a model in it in 3D."""
    cage = flbc.read_cage(MESHES / "3d/limb_cage.obj")
    return cage, *flbc.read_model(MESHES / "3d/limb_model.obj")


@pytest.fixture(scope="session")
def solid(limb):
    """A solution in 3D."""
    return flbc.solve(limb[0], flbc.mesh(limb[0], vertices=1500))


@pytest.fixture()
def moved(limb):
    return limb[0].points + np.array([0.0, 0.5, 0.0]) * (limb[0].points[:, :1] > 5)
