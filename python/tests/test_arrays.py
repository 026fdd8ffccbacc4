# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of every layout and type give the same results, or an error that names them."""
import flbc
import numpy as np
import pytest


def layouts(array):
    """The same values in other layouts."""
    yield np.asfortranarray(array)
    yield np.repeat(array, 2, axis=0)[::2]
    yield np.concatenate([array, array], axis=1)[:, : array.shape[1]]
    yield array[::-1].copy()[::-1]
    yield array.astype(array.dtype.newbyteorder())
    read_only = array.copy()
    read_only.setflags(write=False)
    yield read_only
    yield array.tolist()
    unaligned = np.zeros(array.nbytes + 1, np.uint8)[1:].view(array.dtype).reshape(array.shape)
    unaligned[:] = array
    yield unaligned


def bound(solution):
    return flbc.Binding(solution.weights, solution.cage, solution.mesh.points)


def test_layouts_of_points_and_weights_change_nothing(flat):
    points = np.random.default_rng(0).uniform(0.01, 0.99, (40, 2))
    expected = flat.at(points)
    for other in layouts(points):
        assert np.array_equal(flat.at(other), expected)
    for other in layouts(expected):
        bound = flbc.Binding(other, flat.cage, points)
        assert np.array_equal(bound.weights.toarray(), expected)
        assert np.allclose(bound.deform(flat.cage), points, atol=1e-14)


def test_layouts_and_types_of_indices_change_nothing(limb):
    cage = limb[0]
    for kind in (np.int8, np.uint8, np.int64, np.uint64, np.int32):
        same = flbc.Cage(cage.points, cage.facets.astype(kind))
        assert np.array_equal(same.facets, cage.facets)
    for other in layouts(cage.facets):
        assert np.array_equal(flbc.Cage(cage.points, other).facets, cage.facets)
    for other in layouts(cage.points):
        assert np.array_equal(flbc.Cage(other, cage.facets).points, cage.points)


def test_other_real_types_are_converted(flat):
    points = np.array([[0.25, 0.5], [0.75, 0.125]])
    for kind in (np.float16, np.float32, np.longdouble):
        assert np.array_equal(flat.at(points.astype(kind)), flat.at(points))
    assert np.array_equal(flbc.Cage(np.array([[0, 0], [2, 0], [0, 2]])).points[1], [2.0, 0.0])
    assert len(flbc.mesh(flat.cage, vertices=np.int64(300))) > 200


def test_cages_keep_their_own_arrays():
    points = np.array([[0.0, 0], [1, 0], [0, 1]])
    cage = flbc.Cage(points)
    points[0] = 5
    assert cage.points[0, 0] == 0
    with pytest.raises(ValueError):
        cage.points[0, 0] = 5


def test_polygons_are_cut_and_loops_joined():
    box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    cage = flbc.Cage(box, quads)
    assert cage.facets.shape == (12, 3) and flbc.check(cage) == []
    ragged = [*quads[:5], [1, 5, 7], [1, 7, 3]]
    assert flbc.Cage(box, ragged).facets.shape == (12, 3)
    square = [[0, 0], [9, 0], [9, 9], [0, 9], [3, 3], [5, 3], [3, 5]]
    ring = flbc.Cage(square, [[0, 1, 2, 3], [4, 5, 6]])
    assert ring.facets.tolist() == [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
    assert np.array_equal(flbc.Cage(square, ring.facets).facets, ring.facets)


def test_meshes_of_other_libraries_are_cages(limb):
    class Trimesh:
        vertices, faces = limb[0].points, limb[0].facets

    class Meshio:
        points, cells_dict = limb[0].points, {"vertex": [[0]], "triangle": limb[0].facets}

    for mesh in Trimesh(), Meshio():
        assert np.array_equal(flbc.Cage(mesh).facets, limb[0].facets)
    assert flbc.check(Trimesh()) == []
    assert flbc.check((limb[0].points, limb[0].facets)) == []
    assert flbc.check((limb[0].points.tolist(), limb[0].facets.tolist())) == []


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda s: flbc.Cage(np.zeros((4, 4))), ["points", "(4, 4)", "(N, 2 or 3)"]),
        (lambda s: flbc.Cage(np.zeros(6)), ["points", "(6,)"]),
        (lambda s: flbc.Cage(np.zeros((4, 3))), ["facets"]),
        (lambda s: flbc.Cage([["a", "b"]]), ["points", "real numbers"]),
        (lambda s: flbc.Cage([[1j, 2]]), ["points", "complex128"]),
        (lambda s: flbc.Cage([[0, 0], [1]]), ["points"]),
        (lambda s: flbc.Cage(s.cage.points, [[0.5, 1]]), ["facets", "integers", "float64"]),
        (lambda s: flbc.Cage(s.cage.points, [[0, 1], [1, 4]]), ["facets: row 1", "vertex 4"]),
        (lambda s: flbc.Cage(s.cage.points, [[0, 1, -1]]), ["facets: row 0", "vertex -1"]),
        (lambda s: flbc.Cage(s.cage.points, [[0, 1, 2], [1, 2**32 + 2]]),
         ["facets: row 1", str(2**32 + 2)]),
        (lambda s: flbc.Cage(s.cage.points, [[0, 1, 2], [1, 2.0]]), ["facets", "integers"]),
        (lambda s: flbc.Cage(s.cage.points, [[0]]), ["facets: row 0", "at least 2"]),
        (lambda s: flbc.DomainMesh(s.mesh.points, s.mesh.cells[:, :2]), ["cells", "(F, 3)"]),
        (lambda s: flbc.solve(s.cage, (np.eye(4, 3), [[0, 1, 2, 3]])),
         ["mesh", "(4, 3)", "(4, 2)"]),
        (lambda s: s.at(np.zeros((5, 3))), ["points", "(5, 3)", "(N, 2)"]),
        (lambda s: s.at([[0.5, np.nan]]), ["points: row 0", "finite"]),
        (lambda s: bound(s).deform(np.zeros((5, 2))), ["control_points", "(5, 2)", "(4, 2)"]),
        (lambda s: bound(s).deform(s.cage, out=np.zeros((2, 2))), ["out", "float64"]),
        (lambda s: bound(s).deform(s.cage, out=np.zeros((2, len(s.mesh.points))).T), ["out", "C-contig"]),
        (lambda s: bound(s).deform(s.cage, out=np.zeros((len(s.mesh.points), 2), "f")), ["out", "float64"]),
        (lambda s: flbc.Binding(s.weights, s.cage, s.mesh.points[1:]),
         ["weights", ", 4), but needs (", "control points"]),
        (lambda s: bound(s).reduced(2), ["influences"]),
        (lambda s: bound(s).reduced(threshold=2), ["threshold"]),
        (lambda s: flbc.solve(s.cage, s.mesh, phi=np.ones((4, 4))), ["phi", "(4, 4)", ", 4)"]),
        (lambda s: flbc.solve(s.cage, s.mesh, phi=-np.ones((len(s.mesh.cells), 4))),
         ["phi", "control point 0", "not negative"]),
        (lambda s: flbc.Solver(s.cage, s.mesh, phi=[[1.0], [1.0, 2.0]]), ["phi", "rows may differ"]),
        (lambda s: flbc.solve(s.cage, s.mesh, tolerance=-1), ["tolerance"]),
        (lambda s: flbc.solve(s.cage, s.mesh, tolerance="small"), ["tolerance", "'small'"]),
        (lambda s: flbc.solve(s.cage, s.mesh, method="fast"), ["method", "weights", "fast"]),
        (lambda s: flbc.solve(s.cage, s.mesh, max_iterations=1.5), ["max_iterations", "integer"]),
        (lambda s: s.at([[2.0, 2.0]]), ["outside"]),
        (lambda s: s.at([[2.0, 2.0]], outside="near"), ["outside", "nearest", "near"]),
        (lambda s: flbc.write_mesh("x.vtu", s.mesh, {"w": [1.0]}), ["fields['w']", "(1,)"]),
        (lambda s: flbc.write_mesh("m.mesh", s.mesh), ["the format is for other data", ".vtu"]),
        (lambda s: flbc.write_weights("x.mtx", bound(s)), ["weights is a Binding; use its methods"]),
        (lambda s: flbc.measure(s.cage, s.mesh.points, s.weights), ["the first argument is weights"]),
        (lambda s: flbc.Binding(s.cage, s.mesh.points, s.weights), ["the first argument is weights"]),
        (lambda s: flbc.bind([[1.25, 0.5]], None, s.cage, mesh_vertices=200),
         ["choose outside='nearest', 'keep'", "make_cage"]),
        (lambda s: s.at([[1.25, 0.5]]), ["choose outside='nearest', 'keep'", "make_cage"]),
        (lambda s: flbc.solve(s.cage, s.mesh, method="green"), ["normals of facets"]),
        (lambda s: flbc.bind(s.mesh.points, None, s.cage, method="bbw"), ["reproduce the model"]),
        (lambda s: flbc.mesh(s.cage, vertices=3e3), ["vertices must be an integer, not 3000.0"]),
        (lambda s: bound(s).reduced(8.0), ["k must be an integer"]),
        (lambda s: flbc.make_cage(s.mesh.points, control_points=60.0),
         ["control_points must be an integer"]),
        (lambda s: s.at(s.mesh.points, outside=3), ["outside must be a name, not 3"]),
    ],
)
def test_what_is_wrong_is_named(make, words, flat):
    with pytest.raises(flbc.Error) as caught:
        make(flat)
    assert isinstance(caught.value, ValueError)
    for word in words:
        assert word in str(caught.value)


def test_unknown_options_are_named(flat):
    for call in (flbc.solve, flbc.Solver):
        with pytest.raises(TypeError, match="accuracy.*choose from.*tolerance"):
            call(flat.cage, flat.mesh, accuracy=1e-3)
    for name in flbc.SolverOptions.__annotations__:
        with pytest.raises(flbc.Error, match=name):
            flbc.solve(flat.cage, flat.mesh, **{name: object()})
    for function in (flbc.solve, flbc.Solver, flbc.bind, flbc.Rig):
        for name in flbc.SolverOptions.__annotations__:
            assert f"\n{name} : " in function.__doc__


def test_file_errors_are_os_errors(tmp_path):
    with pytest.raises(OSError, match="absent.obj"):
        flbc.read_cage(tmp_path / "absent.obj")
    (tmp_path / "bad.obj").write_text("v 1 2 x\n")
    with pytest.raises(flbc.InputError, match="bad.obj.*1"):
        flbc.read_model(tmp_path / "bad.obj")
