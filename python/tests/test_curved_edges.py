# SPDX-License-Identifier: BSD-3-Clause
"""The example of curved edges reproduces the model, and its edges are the curves of de Casteljau's algorithm."""
import subprocess
import sys

import flbc
import numpy as np
import pytest
from conftest import MESHES, SOURCE, module_at

EXAMPLE = SOURCE / "examples/curved_edges.py"


@pytest.fixture(scope="module")
def example():
    return module_at(EXAMPLE)


def on_curve(corners, t):
    """A point by de Casteljau's algorithm, which has no polynomial in common with the example."""
    while len(corners) > 1:
        corners = (1 - t) * corners[:-1] + t * corners[1:]
    return corners[0]


# One loop, and a loop around a hole.
@pytest.mark.parametrize("name", ["figure", "ring"])
def test_edges_are_curves(example, name):
    cage = flbc.read_cage(MESHES / f"2d/{name}_cage.obj")
    controls, fine, weights = example.with_handles(cage)
    assert flbc.check(fine) == []
    moved = controls + np.random.default_rng(1).normal(size=controls.shape)
    found = (weights @ moved).reshape(len(cage.facets), example.PIECES, 2)
    for e, (start, end) in enumerate(cage.facets):
        handle = len(cage) + 2 * e
        for k in range(example.PIECES):
            wanted = on_curve(moved[[start, handle, handle + 1, end]], k / example.PIECES)
            assert np.allclose(found[e, k], wanted, atol=1e-12)


def test_model_is_reproduced(example):
    cage = flbc.read_cage(MESHES / "2d/figure_cage.obj")
    vertices, faces = flbc.read_model(MESHES / "2d/figure_model.obj")
    controls, fine, of_fine = example.with_handles(cage)
    dense = flbc.bind(vertices, faces, fine).composed(of_fine, controls).weights.toarray()
    assert dense.min() >= 0
    assert np.abs(dense.sum(axis=1) - 1).max() < 1e-13
    assert np.abs(dense @ controls - vertices).max() < 1e-13 * np.abs(vertices).max()


def test_program_moves_the_model(tmp_path):
    names = (MESHES / "2d/figure_cage.obj", MESHES / "2d/figure_model.obj", tmp_path / "moved.obj")
    subprocess.run([sys.executable, EXAMPLE, *names], check=True, timeout=120)
    before, _ = flbc.read_model(names[1])
    after, _ = flbc.read_model(names[2])
    area = [np.prod(np.ptp(points, axis=0)) for points in (before, after)]
    assert area[1] > 1.01 * area[0]  # all edges bulge outward
