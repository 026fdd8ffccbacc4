# SPDX-License-Identifier: BSD-3-Clause
"""Solves: equal to those of the program, without copies, interrupted, in threads and processes."""
import gc
import multiprocessing
import os
import pathlib
import resource
import signal
import subprocess
import sys
import threading
import time

import flbc
import numpy as np
import pytest
import scipy.sparse
from conftest import MESHES


@pytest.mark.parametrize("name, vertices", [("2d/figure", 800), ("3d/limb", 800)])
@pytest.mark.parametrize(
    "options", [{}, {"distances": "exact"}, {"smoothness": 0}, {"method": "gradient"}]
)
def test_weights_equal_those_of_the_program(program, tmp_path, name, vertices, options):
    cage_file, model_file = MESHES / f"{name}_cage.obj", MESHES / f"{name}_model.obj"
    cage = flbc.read_cage(cage_file)
    mesh = flbc.mesh(cage, vertices=vertices)
    flags = []
    for option, value in options.items():
        flags += [f"--{option}", value]
    common = [cage_file, "--vertices", vertices, "-q", *flags]
    program("solve", *common, "-o", tmp_path / "mesh.npy")
    program("solve", *common, "--model", model_file, "-o", tmp_path / "model.npy")
    solution = flbc.solve(cage, mesh, **options)
    assert np.array_equal(solution.weights, np.load(tmp_path / "mesh.npy"))
    vertices, _ = flbc.read_model(model_file, dim=cage.dim)
    assert np.array_equal(solution.at(vertices), np.load(tmp_path / "model.npy"))
    assert solution.converged and solution.report["status"] == "converged"
    assert np.array_equal(solution.sparse_weights.toarray(), solution.weights)


def test_weights_are_not_copied(square, flat):
    weights = flat.weights
    assert weights is flat.weights and weights.flags.c_contiguous
    # The memory belongs to the solver's weights, and the matrix keeps it.
    base = flat.sparse_weights.data
    while isinstance(base, np.ndarray):
        base = base.base
    assert type(base).__name__ == "PyCapsule"
    solution = flbc.solve(square, flat.mesh)
    address, column = solution.weights.ctypes.data, solution.weights[:, 1]
    expected = column.copy()
    del solution
    gc.collect()
    assert column.ctypes.data == address + column.itemsize
    assert np.array_equal(column, expected)


OTHERS = ["harmonic", "meanvalue", "maxentropy", "maxlikelihood", "blended"]


@pytest.mark.parametrize("method", ["weights", "gradient", "paper", "lbc2014"] + OTHERS)
def test_every_method(flat, method):
    options = {} if method in OTHERS else {"tolerance": 1e-4}
    solution = flbc.solve(flat.cage, flat.mesh, method=method, **options)
    assert solution.report["method"] == method
    assert abs(solution.weights @ flat.cage.points - flat.mesh.points).max() < 1e-6


@pytest.mark.parametrize("method", OTHERS)
def test_other_coordinates_refuse_what_they_do_not_use(flat, method):
    for option in {"tolerance": 1e-4}, {"certify": True}:
        with pytest.raises(flbc.OptionError, match=f"{[*option][0]}: the method {method}"):
            flbc.solve(flat.cage, flat.mesh, method=method, **option)
    with pytest.raises(flbc.OptionError, match="non_negative constraint is for"):
        flbc.solve(flat.cage, flat.mesh, method=method, non_negative="constraint")
    solver = flbc.Solver(flat.cage, flat.mesh, method=method)
    same = flbc.solve(flat.cage, flat.mesh, method=method)
    assert np.array_equal(solver.solve().weights, same.weights)
    bound = flbc.bind(flat.mesh.points, None, flat.cage, domain=flat.mesh, method=method)
    assert bound.report["method"] == method


def test_bounded_biharmonic_weights_are_bounded(flat):
    weights = flbc.solve(flat.cage, flat.mesh, method="bbw").weights
    assert weights.min() >= 0 and weights.max() <= 1


def test_not_converged_is_a_warning(flat):
    with pytest.warns(flbc.NotConverged, match="3 iterations") as caught:
        solution = flbc.solve(flat.cage, flat.mesh, max_iterations=3)
    assert caught[0].filename == __file__
    assert not solution.converged and solution.report["iterations"] == 3


def test_embedded_points_are_vertices(limb):
    cage, vertices = limb[0], limb[1][::20]
    mesh = flbc.mesh(cage, vertices=4000, points=vertices)
    assert np.array_equal(mesh.points[: len(cage)], cage.points)
    assert np.array_equal(mesh.points[len(cage) :][: len(vertices)], vertices)
    with pytest.warns(UserWarning, match="instead of 10"):
        assert len(flbc.mesh(cage, vertices=10).points) > 20


# ---- callbacks ----------------------------------------------------------------------------------
def test_callbacks_follow_stop_and_raise(flat):
    seen = []

    def follow(progress):
        seen.append((progress.iteration, progress.relative_primal_residual, progress.objective()))

    solution = flbc.solve(flat.cage, flat.mesh, callback=follow)
    assert np.array_equal(solution.weights, flbc.solve(flat.cage, flat.mesh).weights)
    assert seen[0][0] == 10 and all(objective > 0 for _, _, objective in seen)

    stopped = flbc.solve(flat.cage, flat.mesh, callback=lambda p: p.finer_levels > 0 or p.iteration < 20)
    assert stopped.report["status"] == "stopped" and stopped.report["iterations"] == 20

    def fail(progress):
        raise LookupError(f"iteration {progress.iteration}")

    with pytest.raises(LookupError, match="iteration 10"):
        flbc.solve(flat.cage, flat.mesh, callback=fail)
    kept = []
    flbc.solve(flat.cage, flat.mesh, callback=kept.append)
    with pytest.raises(flbc.Error, match="during the callback"):
        kept[0].objective()


# Each prints the seconds of processor time of the work that it begins then.
SLOW = """
import flbc
cage = flbc.read_cage({cage!r})
mesh = flbc.mesh(cage, vertices=8000)
print(10, flush=True)  # hours, in fact
flbc.solve(cage, mesh, tolerance=1e-30, max_iterations=10**6)
"""


REDUCTION = """
import flbc, numpy, scipy.sparse, time
cage = flbc.read_cage({cage!r})
points, faces = flbc.read_model({model!r})
count = 200
many = numpy.concatenate([points] * count)
polygons = numpy.concatenate([faces + k * len(points) for k in range(count)])
weights = scipy.sparse.csr_array(numpy.concatenate([flbc.mean_value(cage, points)] * count))
binding = flbc.Binding(weights, cage, many, polygons)
start = time.process_time()
binding.reduced(6)
print(time.process_time() - start, flush=True)
while True:
    binding.reduced(6)
"""


EVALUATION = """
import flbc, numpy, time
cage = flbc.read_cage({cage!r})
solution = flbc.solve(cage, flbc.mesh(cage, vertices=1000), tolerance=1)
points = numpy.tile(solution.mesh.points, (5000, 1))
start = time.process_time()
solution.at(points, sparse=True)
print(time.process_time() - start, flush=True)
while True:
    solution.at(points, sparse=True)
"""


def time_of_processor(process=None):
    """Of a child that runs, or of all that have ended; unlike a clock, the same on a busy machine."""
    if process is None:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("code", [SLOW, REDUCTION, EVALUATION],
                         ids=["solve", "reduction", "evaluation"])
def test_ctrl_c_stops_work(code):
    code = code.format(cage=str(MESHES / "3d/limb_cage.obj"),
                       model=str(MESHES / "3d/limb_model.obj"))
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env=dict(os.environ, OMP_NUM_THREADS="1"),
    )
    whole = float(process.stdout.readline())
    time.sleep(0.2)
    start = time_of_processor(process) + time_of_processor()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert "KeyboardInterrupt" in errors and process.returncode == -signal.SIGINT
    assert time_of_processor() - start < whole / 2


def test_other_threads_run_meanwhile(solid):
    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.perf_counter()
    with pytest.warns(flbc.NotConverged):
        flbc.solve(solid.cage, solid.mesh, threads=1, tolerance=1e-30, max_iterations=300)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(begin < tick < end for tick in ticks) > 20


def test_two_threads_solve_at_once(flat, solid):
    found = {}

    def solve(key, solution):
        found[key] = flbc.solve(solution.cage, solution.mesh)

    threads = [
        threading.Thread(target=solve, args=(k, solution))
        for k, solution in enumerate([solid, solid, flat, flat])
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k, solution in enumerate([solid, solid, flat, flat]):
        assert np.array_equal(found[k].weights, solution.weights)


def _solve_again(pipe, solution):
    pipe.send(flbc.solve(solution.cage, solution.mesh, threads=2).weights)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes_solve(solid, method):
    flbc.solve(solid.cage, solid.mesh, threads=2)  # starts threads, which a fork does not copy
    context = multiprocessing.get_context(method)
    here, there = context.Pipe()
    process = context.Process(target=_solve_again, args=(there, solid))
    process.start()
    try:
        assert here.poll(120), "the process hangs"
        assert np.array_equal(here.recv(), solid.weights)
    finally:
        process.kill()
        process.join()


# ---- Solver -------------------------------------------------------------------------------------
def test_solver_resumes(flat):
    solver = flbc.Solver(flat.cage, flat.mesh, penalty=1.0)
    first = solver.solve(iterations=3)
    assert not first.converged and first.report["iterations"] == 3
    kept = first.weights.copy()
    more = solver.solve(iterations=20)
    assert np.array_equal(first.weights, kept)
    whole = flbc.Solver(flat.cage, flat.mesh, penalty=1.0).solve(iterations=23)
    assert np.array_equal(more.weights, whole.weights)
    assert solver.solve().converged
    solver.set_options(tolerance=1e-9)
    assert solver.options["tolerance"] == 1e-9 and solver.options["penalty"] == 1.0
    assert solver.solve().converged
    solver.restart()
    assert solver.solve(seconds=1e-9).report["iterations"] >= 1


@pytest.mark.parametrize("which", ["flat", "solid"])
def test_solver_reshapes_the_rest_cage(which, request):
    solution = request.getfixturevalue(which)
    solver = flbc.Solver(solution.cage, solution.mesh)
    moved = solution.cage.points * ([1.1] + [1.0] * (solution.cage.dim - 1))
    after = solver.reshape(moved)
    assert np.array_equal(solver.cage.points, moved)
    assert np.array_equal(after.mesh.points, solver.mesh.points)
    assert abs(after.weights @ moved - after.mesh.points).max() < 1e-12
    with pytest.raises(flbc.InputError, match="control_points"):
        solver.reshape(moved[1:])


def geodesic_phi(solution):
    """phi "square" of a convex cage, where geodesics are straight."""
    cage, mesh = solution.cage, solution.mesh
    distances = np.linalg.norm(mesh.points[:, None] - cage.points, axis=2)
    return np.square(distances[mesh.cells].mean(axis=1) / distances.max())


def test_own_phi_is_used(flat):
    options = {"tolerance": 1e-7}
    named = flbc.solve(flat.cage, flat.mesh, **options)
    own = flbc.solve(flat.cage, flat.mesh, phi=geodesic_phi(flat), **options)
    assert own.converged and own.report["objective"] == pytest.approx(named.report["objective"], rel=1e-3)
    assert abs(own.weights - named.weights).max() < 5e-3
    constant = np.ones((len(flat.mesh.cells), len(flat.cage)))
    other = flbc.solve(flat.cage, flat.mesh, phi=constant, **options)
    same = flbc.solve(flat.cage, flat.mesh, phi="constant", **options)
    assert other.report["objective"] == pytest.approx(same.report["objective"], rel=1e-3)
    bound = flbc.bind(flat.mesh.points, None, flat.cage, domain=flat.mesh, phi=constant,
                      max_influences=0, **options)
    assert abs(bound.weights.toarray() - other.weights).max() < 1e-6


def test_gradients_are_those_of_the_weights(flat, solid):
    for solution in flat, solid:
        cage, mesh = solution.cage, solution.mesh
        points = mesh.points[mesh.cells[::7]].mean(axis=1)
        gradients = solution.gradients(points)
        assert gradients.shape == (len(points), len(cage), cage.dim)
        assert abs(gradients.sum(axis=1)).max() < 1e-9
        # Reproduction: an affine pose has its matrix as the Jacobian.
        matrix = np.arange(1.0, cage.dim**2 + 1).reshape(cage.dim, cage.dim)
        jacobians = np.einsum("nk,pnd->pkd", cage.points @ matrix.T, gradients)
        assert abs(jacobians - matrix).max() < 1e-8
        with pytest.raises(flbc.InputError, match="outside"):
            solution.gradients(points + 1e3)
        exact, step = solution.gradients(points, exact=True), 1e-6 * np.ptp(cage.points)
        for k, direction in enumerate(step * np.eye(cage.dim)):
            change = solution.at(points + direction) - solution.at(points - direction)
            assert abs(change / (2 * step) - exact[:, :, k]).max() < 1e-6


def test_many_points_are_evaluated_in_batches(flat):
    points = np.random.default_rng(1).uniform(0.1, 0.9, (250_000, 2))
    few = np.arange(0, len(points), 9999)
    sparse = flat.at(points, sparse=True)
    assert (sparse != scipy.sparse.csr_matrix(flat.at(points))).nnz == 0
    assert (sparse[few].toarray() == flat.at(points[few])).all()
    assert (flat.gradients(points)[few] == flat.gradients(points[few])).all()
    points[[7, 222_222]] = [[2, 0], [3, 0]]
    with pytest.raises(flbc.InputError, match="^2 .*222222"):
        flat.at(points)


def test_import_is_fast():
    """Little more than NumPy, and nothing else."""
    code = "import sys, time; import numpy; t = time.process_time(); import flbc; " \
        "print(time.process_time() - t, 'scipy' in sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    seconds, has_scipy = found.stdout.split()
    assert float(seconds) < 0.2 and has_scipy == "False"
    assert os.environ["FLBC_BUILD_DIR"] in flbc.__file__
