# SPDX-License-Identifier: BSD-3-Clause
"""What a binding promises holds after everything that is made of it, in 2D and 3D."""
import copy
import pickle

import flbc
import numpy as np
import pytest
import scipy.sparse
from scipy.spatial import Delaunay

# ---- a model that has it all: masks, an exact mirror, vertices outside that stay -----------------


def box(dim, places=(0, 1, 2)):
    """A box with control points at these places along x, symmetric across x = 1."""
    if dim == 2:
        return flbc.Cage([[x, 0] for x in places] + [[x, 1] for x in places[::-1]])
    points = np.array([[x, y, z] for x in places for y in (0, 1) for z in (0, 1)], float)
    ring, last = [0, 1, 3, 2], 4 * len(places) - 4
    sides = [[4 * s + ring[k], 4 * s + ring[k - 1], 4 * s + 4 + ring[k - 1], 4 * s + 4 + ring[k]]
             for s in range(len(places) - 1) for k in range(4)]
    return flbc.Cage(points, [ring, *sides, [last + k for k in (0, 2, 3, 1)]])


def image(points):
    return points * ([-1] + [1] * (points.shape[-1] - 1)) + ([2] + [0] * (points.shape[-1] - 1))


def images_of(cage):
    return [int(np.flatnonzero((image(point) == cage.points).all(1))[0]) for point in cage.points]


def half(dim, seed, count):
    """Points of the left half on a grid of binary fractions, so that images are exact."""
    points = np.random.default_rng(seed).integers(4, 60, (2 * count, dim)) / 64
    return np.unique(points, axis=0)[:count]


def mirrored(left, dim):
    """These points, one outside, and their images."""
    left = np.concatenate([left, [[-0.25] + [0.5] * (dim - 1)]])
    return np.concatenate([left, image(left)])


def faces_of(points):
    cells = Delaunay(points).simplices
    return cells if points.shape[1] == 2 else np.concatenate([cells[:, :3], cells[:, 1:]])


def mask_of(cage, points):
    """The right end must not move the left part."""
    return (points[:, :1] < 0.6) & (cage.points[:, 0] == 2)


class Case:
    def __init__(self, dim):
        self.dim, self.cage = dim, box(dim)
        self.points = mirrored(half(dim, 1, 60), dim)
        self.faces = faces_of(self.points)
        self.options = {"mesh_vertices": 400 if dim == 2 else 900, "outside": "keep",
                        "symmetric": "x", "mask": mask_of(self.cage, self.points)}
        self.rig = flbc.Rig(self.cage, self.points, self.faces, max_influences=0, **self.options)
        self.full = self.rig.bind()
        few = self.full.reduced(4).weights
        self.given = flbc.Binding(few, self.cage, self.points, self.faces,
                                  mask_of(self.cage, self.points))


@pytest.fixture(scope="module", params=[2, 3], ids=["2D", "3D"])
def case(request):
    return Case(request.param)


# ---- promises after operations that only Python has; tests/matrix has those of every language ----


def moved_ends(cage):
    """A pose that moves both ends apart."""
    return cage.points + 0.5 * (cage.points[:, :1] - 1)


def saved(binding, folder):
    binding.save(folder / "binding.npz")
    weights = scipy.sparse.load_npz(folder / "binding.npz")
    found = flbc.load_binding(folder / "binding.npz")
    assert abs(weights - binding.weights).nnz == 0 == abs(found.weights - binding.weights).nnz
    return found


@pytest.mark.parametrize(
    "operation",
    [
        lambda b, folder: pickle.loads(pickle.dumps(b)),
        lambda b, folder: copy.deepcopy(b).reduced(4),
        lambda b, folder: b.reduced(8).reduced(4),
        lambda b, folder: saved(b, folder).reduced(4),
    ],
    ids=["pickle", "copy, reduced", "reduced twice", "save, reduced"],
)
def test_promises(operation, case, tmp_path):
    for binding in (case.full, case.given):
        found = operation(binding, tmp_path)
        weights, points = found.weights.toarray(), case.points
        outside = (points[:, 0] < 0) | (points[:, 0] > 2)
        assert not weights[mask_of(case.cage, points)].any() and found.masks
        assert abs(weights[~outside].sum(axis=1) - 1).max() < 1e-10 and weights.min() >= 0
        assert not weights[outside].any() and found.outside.tolist() == np.flatnonzero(outside).tolist()
        assert abs(found.deform(found.cage) - points).max() < 1e-9
        pose = moved_ends(found.cage)
        assert np.array_equal(found.deform(pose)[outside], points[outside])
        if binding is case.given:  # it has no more than 4 influences
            assert np.array_equal(weights, binding.weights.toarray())
            with pytest.raises(flbc.InputError, match="no domain mesh"):
                found.transferred(points, outside="keep")
            continue
        count = len(points) // 2
        assert np.array_equal(weights[:count], weights[count:][:, images_of(found.cage)])
        matrix = np.arange(1.0, case.dim**2 + 1).reshape(case.dim, case.dim)
        jacobians = found.jacobians(found.cage.points @ matrix.T)
        assert (jacobians[outside] == np.eye(case.dim)).all()
        assert abs(jacobians[~outside] - matrix).max() < 1e-8


@pytest.mark.parametrize("outside", ["nearest", "extend"])
def test_vertices_outside_follow(outside, case, tmp_path):
    """Nearest places at an offset, which translations move; affine extensions, which all maps do."""
    full = flbc.bind(case.points, case.faces, case.cage, domain=case.full.domain, outside=outside,
                     max_influences=0)
    matrix = np.eye(case.dim)
    if outside == "extend":
        matrix = matrix + np.arange(case.dim**2).reshape(case.dim, -1) / 8
    for found, most in [(full, 99), (full.reduced(4), 4), (saved(full, tmp_path), 99),
                        (pickle.loads(pickle.dumps(full)), 99)]:
        assert np.array_equal(found.outside, case.full.outside)
        pose = found.cage.points @ matrix + 3
        moved = found.deform(pose)
        assert abs(moved - (case.points @ matrix + 3)).max() < 1e-9
        stack = np.full((2, *moved.shape), np.nan)
        assert found.deform(np.array([found.cage.points, pose]), out=stack) is stack
        assert np.array_equal(stack, [found.deform(found.cage), moved])
        inside = np.delete(found.weights.toarray(), found.outside, axis=0)
        assert inside.min() >= 0 and (inside > 0).sum(axis=1).max() <= most
        assert (found.weights[found.outside].min() < 0) == (outside == "extend")
    assert full.view(case.faces).html


def test_bindings_of_other_control_points(case):
    plain = flbc.bind(case.points, case.faces, case.cage, mesh_vertices=case.options["mesh_vertices"],
                      outside="keep", mask=case.options["mask"])
    # The middle control points follow the ends: the outer cage has the ends only.
    ends = case.cage.points[:, 0] != 1
    shares = flbc.mean_value((outer := box(case.dim, (0, 2))), case.cage.points)
    with pytest.raises(flbc.InputError, match="mirrored"):
        case.full.composed(shares, outer)
    found = plain.composed(shares, outer)
    assert found.domain is None and len(found.cage) == ends.sum()
    expected = plain.weights @ shares
    assert abs(found.weights.toarray() - expected).max() < 1e-12
    rest = found.deform(outer)
    assert abs(rest - case.points).max() < 1e-10 and np.array_equal(found.outside, plain.outside)
    # Only the right end follows control points that are all masked.
    mapped = {tuple(outer.points[i]) for cs, _ in found.masks for i in cs}
    assert all(point[0] == 2 for point in mapped)
    for control_points, vertices in found.masks:
        assert abs(found.weights[vertices][:, control_points]).nnz == 0
    alone = plain.composed(shares, outer.points)
    assert abs(alone.weights - found.weights).nnz == 0 and len(alone.cage.facets) == 0


@pytest.mark.parametrize("make", [np.asarray, scipy.sparse.csr_matrix, scipy.sparse.coo_matrix])
def test_skin(make, case):
    """Bones that are control points of an outer cage give its weights; masks stay 0."""
    shares = np.random.default_rng(3).random((len(case.cage), 9))
    shares /= shares.sum(1, keepdims=True)
    outside = case.full.outside
    for binding in (case.full, case.given):
        product = binding.weights @ shares
        skin = binding.skin(make(shares))
        assert scipy.sparse.isspmatrix_csr(skin) and skin.shape == product.shape
        assert abs(skin.toarray() - product).max() < 1e-14
        for influences in (4, 8):
            few = binding.skin(make(shares.astype(np.float32)), influences=influences)
            sums = np.asarray(few.sum(1)).ravel()
            assert few.data.min() > 0 and few.getnnz(1).max() == influences
            assert not sums[outside].any() and abs(np.delete(sums, outside) - 1).max() < 1e-14
    # Bones that are the control points themselves: the binding's own weights.
    assert abs(case.full.skin(scipy.sparse.eye(len(case.cage))) - case.full.weights).max() < 1e-14


def test_skins_that_are_refused(case):
    n = len(case.cage)
    for bones, words in [
        (np.eye(n + 1), f"bones has shape .* each of the {n} control points"),
        (2 * np.eye(n), "control point 0 in the map sum to 2"),
        (np.eye(n) - 1e-3 * np.eye(n, k=1), "the weight -0.001"),
        (np.full((n, 1), np.nan), "bones"),
        (np.ones(n), "bones has shape"),
        (case.full, "bones is a Binding"),
    ]:
        with pytest.raises(flbc.InputError, match=words):
            case.full.skin(bones)
    for influences in (0, -1, 1.5):
        with pytest.raises(flbc.OptionError, match="influences"):
            case.full.skin(np.eye(n), influences=influences)


# ---- the object ----------------------------------------------------------------------------------


def test_attributes(case):
    full = case.full
    assert isinstance(full.weights, scipy.sparse.csr_matrix) and isinstance(full.cage, flbc.Cage)
    assert isinstance(full.domain, flbc.DomainMesh) and full.report["converged"]
    assert full.report["options"] and case.given.solution is None and case.given.domain is None
    solution = full.solution
    assert np.array_equal(solution.mesh.points, full.domain.points)
    assert abs(solution.weights @ full.cage.points - full.domain.points).max() < 1e-10
    again = pickle.loads(pickle.dumps(full))
    assert again.report == full.report and np.array_equal(again.solution.weights, solution.weights)
    with pytest.raises(AttributeError, match="does not change"):
        full.weights = full.weights * 2
    with pytest.raises(ValueError, match="read-only"):
        full.weights.data[0] = 2


def test_stacks_of_poses(case):
    rest, count = case.cage.points, len(case.points)
    for binding in (case.full, case.given):
        stack = binding.deform([rest, moved_ends(case.cage)])
        assert stack.shape == (2, count, case.dim)
        assert np.array_equal(stack[0], binding.deform(case.cage))
        assert binding.deform(rest[None][:0]).shape == (0, count, case.dim)
    with pytest.raises(flbc.InputError, match=rf"control_points.*, {case.dim}\)"):
        case.full.deform(rest[1:])


def test_given_weights_must_obey_their_mask(case):
    mask = np.ones((len(case.points), len(case.cage)), bool)
    with pytest.raises(flbc.InputError, match="although it is masked"):
        flbc.Binding(case.given.weights, case.cage, case.points, mask=mask)


# ---- masks ---------------------------------------------------------------------------------------


def test_masks_of_every_form_are_equal(case):
    mask = case.options["mask"]
    region, acting = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    forms = [mask, scipy.sparse.coo_matrix(mask), scipy.sparse.csr_array(mask), mask.tolist(),
             [(acting, region)], [([i], region.tolist()) for i in acting], case.rig.options["mask"]]
    options = {**case.options, "mesh_vertices": None, "domain": case.full.domain,
               "method": "weights", "max_iterations": 20000}
    found = [flbc.bind(case.points, None, case.cage, **{**options, "mask": m}) for m in forms]
    for other in found[1:]:
        assert abs(other.weights - found[0].weights).nnz == 0
    for wrong, words in [
        (mask[1:], "mask has shape"),
        (mask + 0.0, "float64, but needs"),
        (scipy.sparse.csr_matrix(mask)[1:], "mask has shape"),
        ([[True], [True, False]], "mask is no array; its rows may differ"),
        ([([0], [len(case.points)])], r"mask\[0\]\[1\].* refers to vertex"),
        ([([99], [0])], r"mask\[0\]\[0\].* refers to vertex 99"),
        ([([0.5], [0])], "integers"),
    ]:
        with pytest.raises(flbc.InputError, match=words):
            flbc.bind(case.points, None, case.cage, **{**options, "mask": wrong})


def test_conflicts_have_data_and_can_be_relaxed(case):
    # Nothing may move the left part.
    region = np.flatnonzero((case.points[:, 0] < 0.4) & (case.points[:, 0] > 0))
    mask = [(np.arange(len(case.cage)), region)]
    options = {"mesh_vertices": 300 if case.dim == 2 else 0}
    inside = (case.points[:, 0] > 0) & (case.points[:, 0] < 2)
    assert inside[region].all()
    points = case.points[inside]
    mask = [(mask[0][0], np.flatnonzero(points[:, 0] < 0.4))]
    with pytest.raises(flbc.MaskConflict) as caught:
        flbc.bind(points, None, case.cage, mask=mask, **options)
    error = pickle.loads(pickle.dumps(caught.value))
    assert isinstance(error, flbc.InputError) and error.points == mask[0][1].tolist()
    freed = error.control_points
    assert 0 < len(freed) < len(case.cage) and str(error) == str(caught.value)
    with pytest.warns(UserWarning, match="masks were removed from control points"):
        found = flbc.bind(points, None, case.cage, mask=mask, conflicts="relax", **options)
    assert f"control points {', '.join(map(str, freed))}" in found.report["note"]
    others = np.setdiff1d(mask[0][0], freed)
    assert abs(found.weights[mask[0][1]][:, others]).nnz == 0
    assert abs(found.deform(case.cage) - points).max() < 1e-10
    with pytest.raises(flbc.OptionError, match="conflicts must be one of fail, relax, not 'drop'"):
        flbc.bind(points, None, case.cage, mask=mask, conflicts="drop")


def test_mirrors_that_are_none_are_refused():
    points = [[0.3, 0.4], [1.7, 0.4]]
    with pytest.raises(flbc.OptionError, match="symmetric must be one of x, y, not 'z'"):
        flbc.bind(points, None, box(2), symmetric="z")
    with pytest.raises(flbc.InputError, match="has no mirror image"):
        flbc.bind(points, None, flbc.Cage([[0, 0], [3, 0], [2, 1], [0, 1]]), symmetric="x")


def test_arrays_with_masked_entries_are_refused(case):
    points = np.ma.masked_less(case.cage.points, 0.5)
    for action in (lambda: flbc.Cage(points), lambda: case.full.deform(points),
                   lambda: flbc.bind(points, None, case.cage)):
        with pytest.raises(flbc.InputError, match="masked entries"):
            action()
    whole = np.ma.array(case.cage.points)
    assert np.array_equal(case.full.deform(whole), case.full.deform(case.cage))


# ---- Rig -----------------------------------------------------------------------------------------

CHANGES = {
    "mask": lambda case: {"mask": case.options["mask"]},
    "tolerance": lambda case: {"tolerance": 1e-8},
    "smoothness": lambda case: {"smoothness": 0.01},
    "reach": lambda case: {"reach": np.where(case.cage.points[:, 0] == 1, 2, 1)},
    "falloff": lambda case: {"mask": case.options["mask"], "falloff": 0.1},
    "method": lambda case: {"method": "harmonic", "tolerance": None},
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_rig_that_resumes_equals_a_new_one(change, case):
    common = {"domain": case.full.domain, "outside": "keep", "tolerance": 1e-8}
    changed = {**common, **CHANGES[change](case)}
    rig = flbc.Rig(case.cage, case.points, case.faces, **common)
    assert rig.solution is None and rig.solve().converged
    rig.set_options(**CHANGES[change](case))
    rig.solve()
    cold = flbc.Rig(case.cage, case.points, case.faces, **changed)
    assert abs(rig.binding().weights - cold.bind(0).weights).max() < 2e-3
    assert set(CHANGES[change](case)) <= set(rig.options)


def test_rigs_take_other_models_and_limits(case):
    rig = flbc.Rig(case.cage, case.points, case.faces, domain=case.full.domain, outside="keep")
    seen = []
    rig.solve(callback=lambda p: seen.append(p.iteration))
    bound = flbc.bind(case.points, case.faces, case.cage, domain=case.full.domain, outside="keep")
    assert seen and abs(rig.bind().weights - bound.weights).nnz == 0
    few = rig.bind(4)
    assert few.weights.getnnz(axis=1).max() <= 4
    other = half(case.dim, 3, 20)
    rig.set_model(other)
    assert abs(rig.binding().weights - rig.solution.at(other)).max() == 0
    assert np.array_equal(rig.binding().points, other)
    with pytest.raises(flbc.InputError, match="outside"):
        rig.set_options(outside="fail")
        rig.set_model(case.points)
    with pytest.raises(flbc.Error, match="in use"):
        rig.set_options(tolerance=1e-9)
        rig.solve(callback=lambda p: rig.solution)
    with pytest.warns(flbc.NotConverged, match="3 iterations") as caught:
        flbc.bind(other, None, case.cage, domain=case.full.domain, max_iterations=3)
    assert caught[0].filename == __file__
    with pytest.raises(TypeError, match="flbc.Rig"):
        pickle.dumps(rig)
    with pytest.raises(TypeError, match="Rig.. has no option 'accuracy'"):
        rig.set_options(accuracy=1)


def test_pointwise_coordinates_are_exact_at_the_vertices(case):
    """They are not interpolated in a mesh, with or without one."""
    points = half(case.dim, 4, 30)
    exact = flbc.mean_value(case.cage, points)
    for mesh in ({}, {"domain": case.full.domain}):
        found = flbc.bind(points, None, case.cage, method="meanvalue", max_influences=0, **mesh)
        assert abs(found.weights - exact).max() < 1e-14
        assert found.report["method"] == "meanvalue" and bool(found.domain) == bool(mesh)
    other = found.transferred(points[::2])
    assert abs(other.weights - exact[::2]).max() < 1e-14


# ---- engineers: joint, gradients, and fit --------------------------------------------------------


def column(dim):
    """Points that pass through one side of a box, where they stay."""
    cage = box(dim)
    line = np.linspace(-0.5, 1.9, 25)
    points = np.concatenate([[[x, 0.5 + 0.1 * k] + [0.5] * (dim - 2) for x in line] for k in (-1, 1)])
    faces = [[k, k + 1, k + 26, k + 25] for k in range(24)]
    return flbc.bind(points, faces, cage, mesh_vertices=300, outside="keep", max_influences=0), cage


@pytest.mark.parametrize("dim", [2, 3])
def test_a_joint_slows_what_moves_at_the_border(dim):
    binding, cage = column(dim)
    joined = binding.joined("smooth:0.4")
    assert all(cage.points[joined.held, 0] == 0)
    pose = cage.points + 0.3 * (cage.points[:, :1] > 0) * np.arange(1, dim + 1)
    mass = binding.weights.toarray()[:, cage.points[:, 0] > 0].sum(1)
    t = np.minimum(1, mass / 0.4)
    moves = binding.deform(pose) - binding.points
    assert np.allclose(joined.deform(pose), binding.points + (t * (2 - t))[:, None] * moves, 0, 1e-12)
    assert np.array_equal(binding.deform(pose, joint="smooth:0.4"), joined.deform(pose))
    assert np.array_equal(binding.deform(cage), binding.points)
    again = pickle.loads(pickle.dumps(joined))
    assert np.array_equal(again.held, joined.held)
    with pytest.raises(flbc.InputError, match="control point 0 is held"):
        again.deform(cage.points + 0.1)
    with pytest.raises(flbc.OptionError, match="smooth or curvature"):
        binding.joined("soft")


@pytest.mark.parametrize("dim", [2, 3])
def test_adjoint_is_the_derivative_of_an_objective(dim):
    binding, cage = column(dim)
    joined = binding.joined()
    free = np.setdiff1d(np.arange(len(cage)), joined.held)

    def objective(pose):
        return np.sin(joined.deform(pose)).sum()

    gradient = joined.adjoint(np.cos(joined.deform(cage)))
    assert np.allclose(gradient, binding.adjoint(np.cos(binding.points), joint="smooth"), 1e-9)
    for i in free:
        for d in range(dim):
            pose = np.array([cage.points, cage.points])
            pose[0, i, d] += 1e-5
            pose[1, i, d] -= 1e-5
            slope = (objective(pose[0]) - objective(pose[1])) / 2e-5
            assert abs(slope - gradient[i, d]) < 1e-8 * np.abs(gradient).max()
    assert not gradient[joined.held].any()


@pytest.mark.parametrize("dim", [2, 3])
def test_fit_finds_the_pose_of_the_targets(dim):
    case = Case(dim)
    binding = flbc.bind(case.points[:-1], None, case.cage, outside="nearest", mesh_vertices=300)
    random = np.random.default_rng(3)
    pose = case.cage.points + 0.1 * random.normal(size=case.cage.points.shape)
    found, facts = binding.fit(binding.deform(pose), stiffness=0)
    assert np.abs(found.points - pose).max() < 1e-12 * facts["condition"]
    assert facts["rms"] <= facts["largest"] < 1e-9
    rows = binding.deform(pose)[10:90]
    held, _ = binding.fit(rows, points=np.arange(10, 90), hold=[2])
    assert np.array_equal(held.points[2], case.cage.points[2])
    with pytest.raises(flbc.InputError, match="targets"):
        binding.fit(rows)


# Positively oriented cells of unit edges, in the order of VTK, with their Jacobians at the corners.
CELLS = {
    (2, 3): [[0, 0], [1, 0], [0, 1]],
    (2, 4): [[0, 0], [1, 0], [1, 1], [0, 1]],
    (3, 4): [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    (3, 5): [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]],
    (3, 6): [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
    (3, 8): [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
             [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
}


@pytest.mark.parametrize("kind", CELLS)
def test_cell_quality_follows_affine_maps_and_finds_folds(kind):
    dim, count = kind
    points = np.array(CELLS[kind], float)
    whole = np.arange(count)[None]
    turned = np.linalg.qr(np.random.default_rng(1).normal(size=(dim, dim)))[0]
    turned[0] *= np.linalg.det(turned)
    for cells in (whole, whole[:, ::-1] if count != 5 and count != 6 else whole):
        at_rest = flbc.cell_quality(points, cells, points)
        assert np.allclose(at_rest["jacobian"], 1) and (at_rest["orthogonality"] > 0.3).all()
        spun = flbc.cell_quality(points, cells, 3 * points @ turned)
        assert np.allclose(spun["jacobian"], 3 ** dim)
        assert np.allclose(spun["orthogonality"], at_rest["orthogonality"])
        assert (flbc.cell_quality(points, cells, points * ([-1] + [1] * (dim - 1)))["jacobian"] < 0).all()
    folded = points.copy()
    folded[0] += 3 * (points.mean(0) - points[0])  # beyond the opposite side
    assert flbc.cell_quality(points, whole, folded)["jacobian"][0] < 0
    with pytest.raises(flbc.InputError, match="cell 0 has no volume"):
        flbc.cell_quality(points * ([0] + [1] * (dim - 1)), whole, points)


@pytest.mark.parametrize("dim", [2, 3])
def test_the_largest_step_keeps_every_cell(dim):
    case = Case(dim)
    inside = case.points[:60]
    cells = Delaunay(inside).simplices
    shape = flbc.cell_quality(inside, cells, inside)
    cells = cells[shape["orthogonality"] > 0.02]
    binding = flbc.bind(inside, None, case.cage, mesh_vertices=300, max_influences=0)
    pose = case.cage.points * ([0.2] + [1] * (dim - 1)) + np.arange(dim)
    step = binding.largest_step(pose, cells, at_least=0.3)
    assert 0 < step < 1

    def least(t):
        moved = binding.deform(case.cage.points + t * (pose - case.cage.points))
        return flbc.cell_quality(inside, cells, moved)["jacobian"].min()

    assert least(step) >= 0.3 > least(step + 1e-4)
    assert binding.largest_step(case.cage, cells) == 1
