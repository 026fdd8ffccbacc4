# SPDX-License-Identifier: BSD-3-Clause
"""Masks, their certificates, and reach."""
import flbc
import numpy as np
import pytest
from test_certificate import checker  # noqa: F401


def ends(cage, points, near=0.6, far=0.4):
    """A mask: control points at one end must not move points at the other."""
    low, size = cage.points[:, 0].min(), np.ptp(cage.points[:, 0])
    acting, region = cage.points[:, 0] > low + near * size, points[:, 0] < low + far * size
    return region[:, None] & acting[None]


@pytest.fixture(scope="module", params=[0.003, 0])
def masked(request):
    square = flbc.Cage([[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]])
    mesh = flbc.mesh(square, vertices=300)
    mask = ends(square, mesh.points, near=0.6, far=0.45)
    return flbc.solve(square, mesh, mask=mask, certify=True, smoothness=request.param,
                      tolerance=1e-8 if request.param else None), mask


def test_a_masked_certificate_needs_each_mask(masked, checker, tmp_path, capsys):  # noqa: F811
    solution, mask = masked
    assert solution.certificate.relative_gap < 0.01
    path = tmp_path / "proof.npz"
    solution.save_certificate(path)
    checker.main(str(path))
    assert "are masked" in capsys.readouterr().out
    with np.load(path) as file:
        data = {name: file[name] for name in file.files}
    pairs = data["masked"]
    assert mask[tuple(pairs.T)].all() and (solution.weights[tuple(pairs.T)] == 0).all()
    # An entry matters unless its control point would be too expensive at this vertex anyway.
    refused = 0
    removed = range(0, len(pairs), 10)
    for k in removed:
        np.savez(path, **{**data, "masked": np.delete(pairs, k, 0)})
        try:
            checker.main(str(path))
        except ValueError as problem:
            assert "the bound is" in str(problem)
            refused += 1
    assert refused > 0.7 * len(removed)
    np.savez(path, **{**data, "masked": pairs[:0]})
    with pytest.raises(ValueError, match="the bound is"):
        checker.main(str(path))
    free = flbc.solve(solution.cage, solution.mesh)
    np.savez(path, **{**data, "weights": free.weights})
    with pytest.raises(ValueError, match="a masked weight is not 0"):
        checker.main(str(path))


def test_masks_and_mirrors_take_arrays_of_phi(masked):
    solution = masked[0]
    cage, mesh = solution.cage, solution.mesh
    points = np.array([[0.3, 0.4], [1.7, 0.4]])
    mask = np.array([[False] * 3 + [True] + [False] * 2, [False] * 6])
    found = flbc.bind(points, None, cage, domain=mesh, mask=mask, symmetric="x",
                      phi=np.ones((len(mesh.cells), len(cage))))
    weights = found.weights.toarray()
    assert (weights[0] == weights[1][[2, 1, 0, 5, 4, 3]]).all() and weights[0, 3] == 0
    assert abs(found.deform(cage.points) - points).max() < 1e-12


def test_reach_extends_weights(masked, checker, tmp_path):  # noqa: F811
    cage, mesh = masked[0].cage, masked[0].mesh
    reach = np.array([1, 4, 1, 0.25, 1, 2])
    found = flbc.solve(cage, mesh, reach=reach, certify=True)
    free = flbc.solve(cage, mesh)
    assert (flbc.solve(cage, mesh, reach=[1] * 6).weights == free.weights).all()
    found.save_certificate(tmp_path / "proof.npz")
    checker.main(str(tmp_path / "proof.npz"))
    assert found.certificate.relative_gap < 0.01
    points = np.array([[0.3, 0.4], [1.7, 0.4]])
    bound = [flbc.bind(points, None, cage, domain=mesh, max_influences=0, phi=phi, reach=reach)
             for phi in ("constant", np.ones((len(mesh.cells), len(cage))))]
    assert bound[0].weights.toarray() == pytest.approx(bound[1].weights.toarray(), abs=1e-3)
    assert abs(bound[0].deform(cage.points) - points).max() < 1e-12

    with pytest.raises(flbc.InputError, match=r"reach has shape \(5,\), but needs \(6,\)"):
        flbc.solve(cage, mesh, reach=reach[1:])
    with pytest.raises(flbc.OptionError, match=r"reach of control point 2 must be in \[1/16, 16\]"):
        flbc.solve(cage, mesh, reach=[1, 1, 17, 1, 1, 1])
    with pytest.raises(flbc.OptionError, match="reach: the method harmonic does not use it"):
        flbc.solve(cage, mesh, reach=reach, method="harmonic")


def test_solid_regions_move_by_one_affine_map(tmp_path):
    square = flbc.Cage([[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]])
    points = np.stack(np.meshgrid(np.linspace(0.1, 1.9, 25), np.linspace(0.1, 0.9, 13)), -1)
    points = points.reshape(-1, 2)
    index = np.arange(25 * 13).reshape(13, 25)
    faces = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], -1)
    disc = np.hypot(*(points - [1.2, 0.5]).T) < 0.2
    options = {"mesh_vertices": 300, "max_influences": 0}
    solid = np.flatnonzero(disc)
    for given in (disc, solid.tolist()):
        binding = flbc.bind(points, faces.reshape(-1, 4), square, solid=[given], **options)
        assert [region.tolist() for region in binding.solid] == [solid.tolist()]
    assert "a certificate does not hold" in binding.report["note"]
    binding.save(tmp_path / "b.npz")
    affine = np.c_[points, np.ones(len(points))]
    for some in (binding, binding.reduced(4), flbc.load_binding(tmp_path / "b.npz").reduced(5)):
        moved = some.deform(np.random.default_rng(1).normal(size=square.points.shape))
        left = moved - affine @ np.linalg.lstsq(affine[solid], moved[solid], rcond=None)[0]
        assert np.abs(left[solid]).max() < 1e-12 < 1e-3 < np.abs(left).max()
        assert some.weights.data.min() >= 0
        assert np.abs(some.weights @ square.points - points).max() < 1e-13
    for wrong, words in (([disc[:-1]], "entries"), ([[len(points)]], "solid[0]"),
                         ([[0.5]], "integers"), ([solid, solid[:1]], "already"),
                         ([range(len(points))], "enlarge the cage")):
        with pytest.raises(flbc.InputError, match=words.replace("[", r"\[")):
            flbc.bind(points, faces.reshape(-1, 4), square, solid=wrong, **options)
