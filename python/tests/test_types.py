# SPDX-License-Identifier: BSD-3-Clause
"""Types: mypy accepts the module and right uses of it, and finds wrong ones."""
import inspect
import os
import pathlib
import subprocess
import sys

import flbc
import pytest

RIGHT = """
import flbc, numpy as np
cage = flbc.Cage([[0, 0], [1, 0], [0, 1]])
mesh = flbc.mesh(cage, 100)
solution = flbc.solve(cage, mesh, tolerance=1e-5, callback=lambda p: p.iteration < 9)
gap: float = solution.certificate.relative_gap if solution.certificate else 0
rows: int = solution.at(np.zeros((1, 2))).shape[0]
vertices, faces = flbc.read_model("model.obj")
binding = flbc.bind(vertices, faces, cage, threads=2)
html: str = flbc.Binding(binding.weights, cage, vertices).view(faces).html
control_points, points = binding.masks[0]
first: int = int(points[0]) + binding.outside.shape[0]
if binding.solution and binding.domain:
    corners: int = binding.domain.cells.shape[1] + binding.solution.weights.shape[0]
few: flbc.Binding = binding.reduced(4).transferred(vertices[:2])
bends = few.jacobians(cage).sum() + few.deform([cage.points]).sum()
rig = flbc.Rig(cage, vertices, faces, max_influences=4, mask=[([0], [1])], conflicts="relax")
iterations = rig.reshape(cage.points).report["iterations"]
try:
    flbc.load_binding("b.npz").save("c.npz")
except flbc.MaskConflict as conflict:
    freed: int = conflict.control_points[0]
"""
WRONG = [
    "flbc.Cage([[0, 0]]).facetz",
    "flbc.solve(cage, callback=3)",
    "flbc.solve(cage, tolerance='small')",
    "flbc.solve(cage, accuracy=1e-5)",
    "flbc.mesh(cage, vertices='many')",
    "flbc.bind([[0, 0]], None, cage).domain.cells",
    "flbc.bind([[0, 0]], None, cage).weight",
    "flbc.Rig(cage, [[0, 0]], conflicts=3)",
]


def mypy(*arguments):
    program = pathlib.Path("/usr/bin/mypy")
    if not program.exists():
        pytest.skip("mypy is missing")
    command = [program, "--enable-incomplete-feature=Unpack", "--cache-dir", os.devnull, *arguments]
    environment = {**os.environ, "MYPYPATH": str(pathlib.Path(flbc.__file__).parent.parent)}
    found = subprocess.run(command, capture_output=True, text=True, env=environment)
    return found.returncode, found.stdout + found.stderr


def test_module_is_typed():
    status, text = mypy("--strict", "--ignore-missing-imports", "-p", "flbc")
    assert status == 0, text


def test_uses_are_checked(tmp_path):
    (tmp_path / "right.py").write_text(RIGHT)
    lines = "".join(f"{line}\n" for line in WRONG)
    (tmp_path / "wrong.py").write_text(f"import flbc\ncage = flbc.Cage([[0, 0]])\n{lines}")
    status, text = mypy("--ignore-missing-imports", tmp_path / "right.py")
    assert status == 0, text
    _, text = mypy("--ignore-missing-imports", tmp_path / "wrong.py")
    for line in range(3, 3 + len(WRONG)):
        assert f"wrong.py:{line}: error" in text, text


def test_stubs_have_every_function():
    stubs = (pathlib.Path(flbc.__file__).parent / "_core.pyi").read_text()
    for name, value in vars(flbc._core).items():
        if inspect.isclass(value):
            assert f"class {name}:" in stubs
        elif callable(value):
            assert f"def {name}(" in stubs


def test_everything_public_is_documented():
    for name in flbc.__all__:
        value = getattr(flbc, name)
        assert value.__doc__ and len(value.__doc__) > 20, name
        if inspect.isfunction(value):
            for parameter in inspect.signature(value).parameters:
                assert parameter == "options" or parameter in value.__doc__, (name, parameter)
            if name.startswith(("write", "export")):
                continue
            assert "Returns\n" in value.__doc__ or name.startswith("read"), name
    found = subprocess.run(
        [sys.executable, "-c", "import flbc; help(flbc.solve)"], capture_output=True, text=True
    )
    assert "max_iterations : int, default 20000" in found.stdout
