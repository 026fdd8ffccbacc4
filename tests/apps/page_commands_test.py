#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Types the commands of a page in an empty folder with the samples, and checks the files that they make.

    page_commands_test.py FLBC REPOSITORY WORK PAGE
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

# What needs a build, a desktop, or a server; other tests have these.
LEFT_OUT = re.compile(r"(scripts/|cmake|export |xdg-open|PATH=|python3 -m http|cp engines/).*")


def points(path):
    return [tuple(map(float, line.split()[1:4])) for line in path.read_text().splitlines() if line.startswith("v ")]


def moves(path, model):
    """By more than a tenth of a unit, the sizes of the samples being several."""
    before, after = points(model), points(path)
    assert len(before) == len(after), (path, len(before), len(after))
    far = max(max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(before, after))
    assert far > 0.1, f"{path.name} is where it was"


def is_as_large_as(path, size):
    assert path.stat().st_size >= size, (path, path.stat().st_size)


LIMB = pathlib.Path("meshes/3d/limb_model.obj")
RESULTS = {
    "README.md": {"out/auto/model.glb": 10_000, "meshes/3d/model.glb": 10_000, "meshes/3d/compared/index.html": 1_000},
    "docs/tutorials/first_deformation.md": {"limb/model.html": 10_000, "limb60/model.glb": 10_000,
                                            "out/deformation.png": 10_000},
    "docs/tutorials/2d_cage.md": {"out/deformation.png": 5_000, "functions.pdf": 5_000,
                                  "lizard/function.png": 5_000},
    "docs/how-to/cages.md": {"cage.obj": 500, "repaired.obj": 500},
    "docs/how-to/weights.md": {"few.npz": 10_000, "exact.npz": 10_000, "nearest.npy": 10_000, "weights.csv": 10_000},
    "docs/how-to/engines.md": {"model.glb": 10_000, "moving.glb": 10_000},
    "docs/tutorials/blender.md": {"limb/model_8.glb": 10_000},
    "docs/explanation/compared_to_other_coordinates.md": {"out/compared/index.html": 1_000},
}
MOVED = {"README.md": "meshes/3d/moved.obj", "docs/tutorials/first_deformation.md": "moved.obj"}


def main():
    flbc, repository, work, page = (pathlib.Path(argument) for argument in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    shutil.copytree(repository / "meshes", work / "meshes")
    environment = {**os.environ, "PATH": f"{flbc.parent}:{os.environ['PATH']}"}
    blocks = re.findall(r"^( *)```(sh|python)\n(.*?)^ *```$", (repository / page).read_text(), re.M | re.S)
    typed = ""
    for _, language, block in blocks:
        if language == "sh":
            typed += "".join(line + "\n" for line in block.splitlines() if not LEFT_OUT.match(line.strip()))
        elif "import" not in block:
            typed += f"{sys.executable} - <<'END'\n{block}END\n"
    assert "flbc " in typed, f"{page} has no commands"
    subprocess.run(["sh", "-eu"], input=typed, cwd=work, env=environment, check=True, text=True,
                   stdout=subprocess.DEVNULL)
    for name, size in RESULTS[str(page)].items():
        is_as_large_as(work / name, size)
    if str(page) in MOVED:
        moves(work / MOVED[str(page)], work / LIMB)


if __name__ == "__main__":
    main() if len(sys.argv) == 5 else sys.exit(__doc__.strip())
