# SPDX-License-Identifier: BSD-3-Clause
"""Few influences per point by flbc sparsify, from its report."""

import functools
import json
import pathlib
import tempfile

# Weights, cage and model below the models folder, numbers of influences; no weights: solved for.
CASES = [("armadillo", "armadillo_cage.obj", "armadillo.obj", None, (4, 6, 8)),
         ("arm", "arm_cage.obj", "arm.obj", None, (4, 8)),
         ("arm, another scheme's", "arm_cage.obj", "arm.obj", "arm_other_weights.txt", (4, 8))]
ANIMATION = "arm_cageAnim.txt"  # of the arm's cage


def as_mtx(triplets, path):
    """Lines CONTROL_POINT POINT WEIGHT as a Matrix Market file."""
    entries = [line.split() for line in triplets.read_text().splitlines()]
    controls, points = (max(int(entry[k]) for entry in entries) + 1 for k in (0, 1))
    lines = ["%%MatrixMarket matrix coordinate real general", f"{points} {controls} {len(entries)}"]
    lines += [f"{int(point) + 1} {int(control) + 1} {weight}" for control, point, weight in entries]
    path.write_text("\n".join(lines) + "\n")
    return path


def moved(cage, displacements, path):
    """The cage with its control points displaced."""
    rows = iter(displacements)
    lines = []
    for line in cage.read_text().splitlines():
        if line.startswith("v "):
            point = zip(line.split()[1:4], next(rows))
            line = "v " + " ".join(f"{float(x) + dx:.17g}" for x, dx in point)
        lines.append(line)
    path.write_text("\n".join(lines) + "\n")


def poses(cage, animation, folder):
    """A file per keyframe in which the cage has moved."""
    keyframes = {}
    for line in animation.read_text().splitlines():
        words = line.split()
        if words and words[0] == "c":
            keyframes.setdefault(words[1], []).append([float(word) for word in words[2:5]])
    paths = []
    for name, displacements in keyframes.items():
        if any(any(row) for row in displacements):
            paths.append(folder / f"pose_{name}.obj")
            moved(cage, displacements, paths[-1])
    return paths


def row_of(name, method, k, reported):
    row = {"weights": name, "points": reported["points"], "control_points": reported["control_points"],
           "influences_before": reported["before"]["mean_nonzeros"], "k": k, "method": method,
           "min_weight": reported["after"]["min_weight"],
           "reproduction_error": reported["after"]["max_reproduction_error"],
           "seconds": reported["seconds"]}
    for kind, column in (("edge", "edges"), ("deformation", "positions")):
        error = reported["error"][kind]
        for random in ("independent", "smooth"):
            row[f"{column}_{random}"] = error[random]["rms"]
            row[f"{column}_{random}_max"] = error[random]["max"]
        if error["poses"]:
            count = len(error["poses"])
            row[f"{column}_animation"] = (sum(p["rms"] ** 2 for p in error["poses"]) / count) ** 0.5
    return row


def sparsify(context):
    folder_3d = context.models / "3d"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, cage, model, weights, counts in CASES:
            if not context.wants(cage.removesuffix("_cage.obj")):
                continue
            if context.quick and title == "armadillo":
                continue
            cage, model = folder_3d / cage, folder_3d / model
            yield title, functools.partial(reduce, context, title, cage, model,
                                           weights and as_mtx(folder_3d / weights, folder / "weights.mtx"), counts,
                                           folder)


def reduce(context, title, cage, model, weights, counts, folder):
    if weights is None:
        weights = folder / "weights.npy"
        context.succeed([context.flbc, "solve", cage, "--model", model, "-o", weights, "-q"])
    animated = []
    if cage.stem == "arm_cage":
        for path in poses(cage, cage.with_name(ANIMATION), folder):
            animated += ["--pose", path]
    # Poses count in the objective of poisson, so that it runs without them as well.
    runs = [("quadratic", animated), ("poisson", [])]
    if animated:
        runs.append(("poisson, for the animation", animated))
    for k in counts[:1] if context.quick else counts:
        for method, words in runs:
            report = folder / "report.json"
            context.succeed([context.flbc, "sparsify", weights, "--cage", cage, "--points", model,
                             "-k", k, "--reduction", method.split(",")[0], "-o", folder / "few.mtx",
                             "-q", "--report", report, *words])
            yield row_of(title, method, k, json.loads(report.read_text()))


SPARSIFY = ("flbc sparsify: root mean square and largest errors over 20 poses with independent random displacements "
            "of a tenth of the cage size and over 20 poses with smooth ones; edges: change of edge vectors relative "
            "to edge lengths; positions: relative to the model size", sparsify)
