# SPDX-License-Identifier: BSD-3-Clause
"""Measures of weights, cages, and binding in one call."""
import flbc
import numpy as np
import pytest
import scipy.sparse
from conftest import MESHES


@pytest.fixture(scope="module")
def model(limb, solid):
    cage, vertices, faces = limb
    return cage, vertices, faces, solid.at(vertices)


def test_outside_points(flat):
    beyond = [[1.5, 0.5]]
    assert np.allclose(flat.at(beyond, outside="nearest") @ flat.cage.points, [1, 0.5])
    extended = flat.at(beyond, outside="extend")
    assert extended.min() < 0 and np.allclose(extended @ flat.cage.points, beyond)


def test_given_weights_in_any_form(model):
    cage, vertices, _, weights = model
    # Entries in any order.
    bound = [flbc.Binding(given, cage, vertices) for given in (weights, scipy.sparse.coo_matrix(weights))]
    assert abs(bound[0].weights - bound[1].weights).nnz == 0
    # Without faces, each point is reduced alone.
    assert bound[0].reduced(5).weights.getnnz(axis=1).max() <= 5
    assert bound[0].reduced(None, threshold=1e-3).weights.nnz < np.count_nonzero(weights)


def test_mean_value_coordinates(square):
    points = [[0.5, 0.5], [2, 0.5]]
    weights = flbc.mean_value(square, points)
    assert np.allclose(weights[0], 0.25) and np.allclose(weights @ square.points, points)


def test_measures(model):
    cage, vertices, _, weights = model
    found = flbc.measure(weights, cage, vertices)
    assert found["violations"] == [] and found["min_weight"]["value"] >= 0
    wrong = weights.copy()
    wrong[7] *= 2
    found = flbc.measure(wrong, cage, vertices)
    assert found["partition"]["point"] == 7 and found["violations"]


# ---- cages --------------------------------------------------------------------------------------
def test_defects_are_found_and_repaired(limb):
    cage, vertices, _ = limb
    assert flbc.check(cage, vertices) == []
    opened = flbc.Cage(cage.points, cage.facets[1:])
    defects = flbc.check(opened)
    assert [defect.kind for defect in defects] == ["open"] * 3
    hole = set(cage.facets[0].tolist())
    for defect in defects:
        assert set(defect.elements["vertices"]) < hole and defect.places.shape == (3, 3)
        assert np.array_equal(defect.places[0], cage.points[defect.elements["vertices"][0]])
    with pytest.raises(flbc.InputError, match="open"):
        flbc.mesh(opened)
    repaired = flbc.repair(opened)
    assert flbc.check(repaired.cage) == [] and repaired.changes
    assert np.array_equal(repaired.new_numbers, np.arange(len(cage)))
    crossed = flbc.Cage([[0, 0], [1, 1], [1, 0], [0, 1]])
    assert [defect.kind for defect in flbc.check(crossed)] == ["self-intersection"]
    far = flbc.check(cage, vertices + [100, 0, 0])
    assert far[0].kind == "outside" and far[0].places.shape == vertices.shape


SQUARE = [[0.0, 0], [1, 0], [1, 1], [0, 1]]
TETRAHEDRON = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
OTHER_FACES = [[0, 4, 1], [0, 1, 5], [1, 4, 5], [4, 0, 5]]  # with the edge 0-1


@pytest.mark.parametrize(
    "kind, points, facets",
    [
        ("count", SQUARE[:2], [[0, 1]]),
        ("non-finite", [*SQUARE, [0.5, np.nan]], None),
        ("extent", np.multiply(SQUARE, 1e-40), None),
        ("index", SQUARE, [[0, 0], [1, 2], [2, 3], [3, 0]]),
        ("coincident", [*SQUARE, SQUARE[3]], None),
        ("unreferenced", [*SQUARE, [0.5, 0.5]], [[0, 1, 2, 3]]),
        ("flat", [[0, 0], [1, 1], [2, 2], [3, 3]], None),
        ("degenerate", [*TETRAHEDRON, [0.5, 0, 0]], [*FACES[1:], [0, 2, 4], [4, 2, 1], [0, 4, 1]]),
        ("duplicate", TETRAHEDRON, [*FACES, FACES[0]]),
        ("open", [*TETRAHEDRON, [0.3, 0.3, 0]], [*FACES[1:], [0, 2, 4], [2, 1, 4]]),
        ("non-manifold", [*TETRAHEDRON, [0, -1, 0], [0, 0, -1]], [*FACES, *OTHER_FACES]),
        ("orientation", TETRAHEDRON, [FACES[0][::-1], *FACES[1:]]),
        ("self-intersection", np.array(SQUARE)[[0, 2, 1, 3]], None),
    ],
)
def test_kinds_of_defects(kind, points, facets):
    defects = flbc.check(flbc.Cage(points, facets))
    assert kind in {defect.kind for defect in defects}
    assert all(defect.message for defect in defects)


@pytest.mark.parametrize("name", ["2d/letter", "3d/limb"])
def test_cages_around_models(name):
    vertices, faces = flbc.read_model(MESHES / f"{name}_model.obj")
    cage = flbc.make_cage(vertices, faces, control_points=40)
    assert len(cage) <= 40 and flbc.check(cage, vertices) == []
    along = vertices[:, 0] - vertices[:, 0].mean()
    dense = flbc.make_cage(vertices, faces, control_points=40, density=np.where(along > 0, 6, 1))
    shares = np.array([np.mean(made.points[:, 0] > vertices[:, 0].mean()) for made in (cage, dense)])
    odds = shares / (1 - shares)
    assert odds[1] > 1.5 * odds[0] and flbc.check(dense, vertices) == []
    for density, words in (([1, 2], "2 densities"), (-np.ones(len(vertices)), "from 0.01 to 100")):
        with pytest.raises(flbc.InputError, match=words):
            flbc.make_cage(vertices, faces, density=density)


# ---- in one call --------------------------------------------------------------------------------
def test_bind_equals_its_steps(limb, moved):
    cage, vertices, faces = limb
    binding = flbc.bind(vertices, faces, cage.points, cage.facets, mesh_vertices=2000)
    solution = flbc.solve(cage, flbc.mesh(cage, vertices=2000))
    few = flbc.Binding(solution.at(vertices), cage, vertices, faces).reduced(8)
    assert abs(binding.weights - few.weights).max() == 0 and binding.offsets is None
    assert np.array_equal(binding.deform(moved), few.deform(moved))
    assert binding.report["converged"]
    every = flbc.bind(vertices, faces, cage, domain=solution.mesh, max_influences=0)
    assert abs(every.weights - solution.at(vertices)).max() == 0


def test_border_names_control_points_to_hold(square):
    points = np.array([[0.5, 0.4], [0.5, 0.6], [1.25, 0.5]])
    held = flbc.border(points, [[0, 1, 2]], square)
    assert held.tolist() == np.flatnonzero(square.points[:, 0] == 1).tolist()
    assert flbc.border(points[:2], [[0, 1]], square).tolist() == []
    # Whatever the others do, the model does not tear at the edge of the cage.
    points[:, 0] = [0.999, 0.999, 1.001]
    binding = flbc.bind(points, None, square, mesh_vertices=2000, outside="keep", max_influences=0)
    pose = square.points + np.where(np.isin(np.arange(len(square)), held), 0, 0.3)[:, None]
    assert abs(binding.deform(pose) - points).max() < 0.01
