#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs an example and checks what it writes.

    example_files_test.py EXAMPLE PROGRAM FLBC MESHES OUT_FOLDER
"""

import math
import pathlib
import subprocess
import sys


def run(*command):
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)


def read_obj(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    return [[float(x) for x in words[1:4]] for words in lines if words and words[0] == "v"]


def read_off(path):
    """Rows of numbers of the vertices: coordinates, then colours if there are; and the faces."""
    words = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    lines = [w for w in words if w]
    vertices, faces = int(lines[1][0]), int(lines[1][1])
    rows = [[float(x) for x in line] for line in lines[2:2 + vertices]]
    return rows, [[int(x) for x in line[1:]] for line in lines[2 + vertices:2 + vertices + faces]]


def size(points):
    return math.dist([max(c) for c in zip(*points)], [min(c) for c in zip(*points)])


def check(holds, what):
    if not holds:
        sys.exit(f"the file is wrong: {what}")


def farthest(rows, points):
    """The largest distance of vertices from where they should be."""
    check(len(rows) == len(points), "another number of vertices")
    return max(math.dist(row[:3], point) for row, point in zip(rows, points))


def nearest(point, others):
    return min(math.dist(point, other) for other in others)


def moved_by_program(flbc, cage, pose, model, out):
    """The model as `flbc deform` moves it."""
    weights, moved = out / "judge.npy", out / "judge.off"
    run(flbc, "solve", cage, "--model", model, "--vertices", 8000, "-o", weights)
    run(flbc, "deform", model, "--weights", weights, "--pose", pose, "-o", moved)
    return [row[:3] for row in read_off(moved)[0]]


def color_a_weight(program, flbc, meshes, out):
    """White where the weight is 0, red where it is 1: at the control points and along the cage."""
    cage, number = meshes / "2d/figure_cage.obj", 3
    domain, result = out / "figure_domain.obj", out / "figure_weight.off"
    run(flbc, "mesh", cage, "-o", domain, "--vertices", 2000)
    run(program, cage, domain, number, result)
    points, shape = read_obj(cage), read_obj(domain)
    rows, _ = read_off(result)
    check(farthest(rows, shape) < 1e-4 * size(points), "vertices have moved")
    for i, point in enumerate(points):
        at = min(rows, key=lambda row: math.dist(row[:3], point))
        check([round(c) for c in at[3:6]] == ([255, 0, 0] if i == number else [255, 255, 255]),
              f"the colour {at[3:]} at control point {i}")
    check(all(row[3] == 255 and row[4] == row[5] for row in rows), "a colour between white and red")
    check(len({row[4] for row in rows}) > 20, "hardly any shades")


def decimate_and_deform(program, flbc, meshes, out):
    """Half of the vertices, each where the program moves one of the model's."""
    cage, model = meshes / "3d/star_cage.obj", meshes / "3d/star_model.obj"
    result, pose = out / "star_decimated.off", out / "star_twisted.obj"
    run(program, cage, model, result)
    lines = []
    for line in cage.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            x, y, z = (float(w) for w in words[1:4])
            cos, sin = math.cos(z / 2), math.sin(z / 2)
            line = f"v {cos * x - sin * y!r} {sin * x + cos * y!r} {z!r}"
        lines.append(line)
    pose.write_text("\n".join(lines) + "\n")
    before = read_obj(model)
    moved = moved_by_program(flbc, cage, pose, model, out)
    rows, faces = read_off(result)
    check(len(rows) == len(before) // 2, f"{len(rows)} of {len(before)} vertices")
    check(max(max(face) for face in faces) < len(rows), "a face without its vertices")
    limit = 0.01 * size(before)
    check(max(nearest(row[:3], moved) for row in rows) < limit, "a vertex away from all moved ones")
    check(max(nearest(row[:3], before) for row in rows) > limit, "nothing has moved")


def embedded_surface(program, flbc, meshes, out):
    """The cage is stretched by an affine map, which coordinates reproduce to the last digit."""
    model, result = meshes / "3d/limb_model.obj", out / "limb_stretched.off"
    run(program, meshes / "3d/limb_cage.obj", model, result)
    before, (rows, _) = read_obj(model), read_off(result)
    far = farthest(rows, [(x, y, 1.5 * z) for x, y, z in before])
    check(far < 1e-5 * size(before), f"a vertex is off by {far}")


def bind_and_deform(program, flbc, meshes, out):
    """Every vertex near where the program moves it."""
    cage, pose = meshes / "3d/limb_cage.obj", meshes / "3d/limb_cage_pose.obj"
    model, result = meshes / "3d/limb_model.obj", out / "limb_posed.off"
    run(program, cage, model, pose, result)
    before, (rows, _) = read_obj(model), read_off(result)
    far = farthest(rows, moved_by_program(flbc, cage, pose, model, out))
    check(far < 0.01 * size(before), f"a vertex is off by {far / size(before):.1e} of the size")
    check(farthest(rows, before) > 0.05 * size(before), "nothing has moved")


def printed(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def core_2d(program, flbc, meshes, out):
    """The corner (1, 1) moves by (0.5, 0.5), and every vertex by a part of that; far edges are at rest."""
    rows = [[float(x) for x in line.split()] for line in printed(program).splitlines()]
    check(len(rows) > 300, f"{len(rows)} vertices")
    for x, y, new_x, new_y in rows:
        part = (new_x - x) / 0.5
        check(abs(new_y - y - 0.5 * part) < 1e-4 and -1e-4 < part < 1 + 1e-4, f"({x}, {y}) moves by {part}")
        if min(x, y) == 0 or x == y == 1:
            check(abs(part - (x == y == 1)) < 1e-4, f"({x}, {y}) on the cage moves by {part}")


def move_and_resume(program, flbc, meshes, out):
    """Each solve iterates, and the last weights are coordinates of the moved cage."""
    first, resumed, moved, error = printed(program, meshes / "2d/letter_cage.obj").split()
    check(min(int(first), int(resumed), int(moved)) > 0, "a solve without iterations")
    check(float(error) < 1e-10, f"reproduction to {error}")


def protect_a_region(program, flbc, meshes, out):
    """One end of the limb is posed; not one vertex of the half at the other end moves."""
    model, result = meshes / "3d/limb_model.obj", out / "limb_protected.off"
    moved, _, protected, *_ = printed(program, meshes / "3d/limb_cage.obj", model,
                                      meshes / "3d/limb_cage_pose.obj", result).split()
    check(int(moved) == 0 and int(protected) > 500, f"{moved} of {protected} protected vertices have moved")
    before, (rows, _) = read_obj(model), read_off(result)
    check(farthest(rows, before) > 0.02 * size(before), "nothing has moved")


EXAMPLES = {function.__name__: function
            for function in (color_a_weight, core_2d, decimate_and_deform, embedded_surface, bind_and_deform,
                             move_and_resume, protect_a_region)}
EXAMPLES["iterate_on_mesh"] = color_a_weight  # solves in another way

if __name__ == "__main__":
    if len(sys.argv) != 6 or sys.argv[1] not in EXAMPLES:
        sys.exit(__doc__.strip())
    folder = pathlib.Path(sys.argv[5]) / sys.argv[1]
    folder.mkdir(parents=True, exist_ok=True)
    EXAMPLES[sys.argv[1]](*(pathlib.Path(p) for p in sys.argv[2:5]), folder)
