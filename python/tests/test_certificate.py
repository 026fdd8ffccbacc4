# SPDX-License-Identifier: BSD-3-Clause
"""Certificates are proved by scripts/check_certificate.py, and damaged ones are not."""
import subprocess
import sys

import flbc
import numpy as np
import pytest
from conftest import MESHES, SOURCE, module_at

SCRIPT = SOURCE / "scripts/check_certificate.py"
CASES = [(2, 0), (2, 0.003), (3, 0), (3, 0.003)]
MUTATIONS = 1000


@pytest.fixture(scope="module")
def checker():
    return module_at(SCRIPT)


@pytest.fixture(scope="module", params=CASES, ids=lambda case: f"{case[0]}D-{case[1]}")
def certified(request):
    dim, smoothness = request.param
    cage = flbc.read_cage(MESHES / ("2d/figure_cage.obj" if dim == 2 else "3d/limb_cage.obj"))
    mesh = flbc.mesh(cage, vertices=400 if dim == 2 else 0)
    return flbc.solve(cage, mesh, smoothness=smoothness, certify=True)


@pytest.fixture(scope="module")
def file(certified, tmp_path_factory):
    path = tmp_path_factory.mktemp("certificate") / "proof.npz"
    certified.save_certificate(path)
    return path


@pytest.fixture(scope="module")
def arrays(file):
    with np.load(file) as data:
        return {name: data[name] for name in data.files}


@pytest.fixture(scope="module")
def worse(certified):
    """Feasible weights far from the optimum."""
    return flbc.solve(certified.cage, certified.mesh, method="harmonic",
                      non_negative="project").weights


def objective(data):
    """By one cell after the other, and gradients by linear systems."""
    total = 0
    for cell, phi in zip(data["cells"], data["phi"]):
        x, w = data["points"][cell], data["weights"][cell]
        edges = x[1:] - x[0]
        slopes = np.linalg.norm(np.linalg.solve(edges, w[1:] - w[0]), axis=0)
        measure = abs(np.linalg.det(edges)) / (2 if len(edges) == 2 else 6)
        total += measure * (phi @ slopes + data["smoothness"] / 2 * (slopes @ slopes))
    return total


def test_a_certificate_is_proved(certified, file, arrays):
    said = subprocess.run([sys.executable, SCRIPT, file], check=True, capture_output=True,
                          text=True).stdout
    gap = float(said.split("at most ")[1].split("%")[0]) / 100
    certificate = certified.certificate
    assert gap == pytest.approx(certificate.relative_gap, rel=0.01, abs=2e-6)
    assert certificate.lower_bound <= certificate.objective
    assert float(said.split()[1].strip(",")) == pytest.approx(objective(arrays), rel=1e-8)
    assert ("mean squared error" in said) == (arrays["smoothness"] > 0)


def test_the_proved_error_of_weights_holds(certified, file, arrays, checker, capsys):
    epsilon = float(arrays["smoothness"])
    if epsilon == 0:
        return
    checker.main(str(file))
    proved = float(capsys.readouterr().out.split("weights at most ")[1].split(",")[0])
    best = flbc.solve(certified.cage, certified.mesh, smoothness=0.003, tolerance=1e-11)
    error = ((certified.weights - best.weights) ** 2).mean()
    assert error <= proved < 0.01


def test_the_program_writes_the_same(program, checker, capsys, tmp_path):
    for name, options in (("2d/figure", ["--vertices", "400", "--smoothness", "0"]),
                          ("3d/limb", ["--vertices", "1500"])):
        path = tmp_path / "proof.npz"
        program("solve", MESHES / f"{name}_cage.obj", *options, "--certificate", path,
                "-o", tmp_path / "w.npy", "-q")
        checker.main(str(path))
        assert "proved" in capsys.readouterr().out
        with np.load(path) as data:
            assert (data["weights"] == np.load(tmp_path / "w.npy")).all()


class Mutator:
    """Changes arrays so that the claim no longer follows from them."""

    def __init__(self, data, worse, is_boundary, seed):
        self.data = {name: np.array(values) for name, values in data.items()}
        self.worse, self.is_boundary = worse, is_boundary
        self.random = np.random.default_rng(seed)
        kinds = [name for name in dir(self) if name.startswith("change_")]
        self.kind = kinds[seed % len(kinds)]
        getattr(self, self.kind)()

    def small(self, least=-5):
        return 10.0 ** self.random.uniform(least, -1)

    def one_of(self, choices):
        return choices[self.random.integers(len(choices))]

    def vertex(self, on_boundary=False):
        return self.one_of(np.flatnonzero(self.is_boundary == on_boundary))

    def some(self, count):
        return self.random.choice(count, max(1, count // 5), replace=False)

    def change_claimed_objective(self):
        self.data["claimed"][0] *= 1 - self.small()

    def change_claimed_bound(self):
        self.data["claimed"][1] *= 1 + self.small()

    def change_to_negative(self):
        self.data["weights"][self.vertex(), self.random.integers(3)] = -self.small(-12)

    def change_sum(self):
        self.data["weights"][self.vertex()] *= 1 + self.small(-8)

    def change_weights(self):
        share = self.random.uniform(0.2, 1)
        self.data["weights"] += share * (self.worse - self.data["weights"])

    def change_boundary_weights(self):
        row = self.data["weights"][self.vertex(on_boundary=True)]
        row[self.one_of(np.flatnonzero(row == 0))] = self.small(-8)
        row /= row.sum()

    def change_point(self):
        self.data["points"][self.vertex(), 0] += self.small() * np.ptp(self.data["points"])

    def change_control_point(self):
        points = self.data["control_points"]
        points[self.random.integers(len(points)), 0] += self.small() * np.ptp(points)

    def change_flux(self):
        flux = self.data["flux"]
        flux[self.some(len(flux))] *= self.one_of([0, -1, 0.5])

    def change_multipliers(self):
        y = self.data["multipliers"]
        y[self.some(len(y))] += self.random.normal(size=y.shape[1]) * (1 + abs(y).max())

    def change_phi(self):
        self.data["phi"] *= 1 - self.small()

    def change_smoothness(self):
        self.data["smoothness"] = self.data["smoothness"] * 0.5 - 1e-3

    def change_to_not_finite(self):
        values = self.data[self.one_of(["points", "control_points", "weights", "phi", "flux",
                                        "multipliers", "claimed"])]
        values.flat[self.random.integers(values.size)] = self.one_of([np.nan, np.inf, -np.inf])

    def change_orientation(self):
        cell = self.one_of(self.data["cells"])
        cell[:2] = cell[1::-1].copy()

    def change_index(self):
        values = self.data[self.one_of(["cells", "facets"])]
        values.flat[self.random.integers(values.size)] = self.one_of([-1, 2**31 - 1])

    def change_count(self):
        name = self.one_of(["points", "weights", "phi", "flux", "multipliers", "claimed"])
        self.data[name] = self.data[name][1:]


def test_damaged_certificates_are_not_proved(certified, arrays, worse, checker, tmp_path):
    is_boundary = np.isin(np.arange(len(arrays["points"])),
                          checker.boundary_vertices(arrays["cells"]))
    path = tmp_path / "damaged.npz"
    for seed in range(MUTATIONS // len(CASES)):
        mutator = Mutator(arrays, worse, is_boundary, seed)
        if mutator.kind == "change_weights":
            assert objective(mutator.data) > arrays["claimed"][0] * (1 + 1e-5)
        np.savez(path, **mutator.data)
        with pytest.raises(ValueError):
            checker.main(str(path))
            print(mutator.kind, seed)


def test_without_a_proof_nothing_is_saved(flat, tmp_path):
    with pytest.raises(flbc.Error, match="certify=True"):
        flat.save_certificate(tmp_path / "proof.npz")
    assert not (tmp_path / "proof.npz").exists()
