# SPDX-License-Identifier: BSD-3-Clause
"""Meshes by the meshers that this build has. The preset `permissive` has only Netgen, for 3D."""
import flbc
import numpy as np
import pytest
from conftest import MESHES


def mesh_or_skip(cage, dim):
    try:
        return flbc.mesh(cage, vertices=800)
    except flbc.OptionError as error:
        assert f"there is no mesher for {dim}D cages" in str(error)
        pytest.skip(str(error))


@pytest.mark.parametrize("dim, name", [(2, "figure"), (3, "limb")])
def test_weights_on_the_mesh_of_a_cage_are_coordinates(dim, name):
    cage = flbc.read_cage(MESHES / f"{dim}d" / f"{name}_cage.obj")
    mesh = mesh_or_skip(cage, dim)
    assert 600 < len(mesh.points) < 1000
    solution = flbc.solve(cage, mesh)
    assert solution.converged
    np.testing.assert_allclose(solution.weights.sum(axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(solution.weights @ cage.points, mesh.points, atol=1e-12)


def test_models_are_bound_in_3d():
    cage = flbc.read_cage(MESHES / "3d/limb_cage.obj")
    mesh_or_skip(cage, 3)
    points = np.linspace(cage.points.mean(axis=0), cage.points.mean(axis=0) + 1e-3, 5)
    binding = flbc.bind(points, None, cage)
    np.testing.assert_allclose(binding.deform(cage.points), points, atol=1e-9)
