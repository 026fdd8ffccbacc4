# SPDX-License-Identifier: BSD-3-Clause
"""Cages from models, as flbc cage makes them.

For every model: a cage by flbc cage, judged from the two files alone (vertices inside by winding
numbers, edges that cross, mean distance of points drawn from the cage to the model), then flbc check
and flbc solve. Needs NumPy.
"""

import functools
import json

CONTROL_POINTS = 100
VERTICES = 4000
QUICK_VERTICES = 1500
QUICK_CASES = ("arm", "limb", "ring")


def solve(context, words, weights):
    """Iterations and quality of the weights of a solve, or what it said."""
    report = weights.with_suffix(".json")
    vertices = QUICK_VERTICES if context.quick else VERTICES
    done = context.run([context.flbc, "solve", *words, "--vertices", vertices, "-o", weights, "-q",
                        "--report", report])
    if done.status:
        return {"solve": f"exit {done.status}: {done.errors}"}
    results = json.loads(report.read_text())
    return {"solve": "converged" if results["converged"] else "not converged",
            "iterations": results["iterations"], "min_weight": results["min_weight"],
            "reproduction_error": results["max_reproduction_error"]}


def measure_cage(context, model, folder):
    import judge_cages as judge
    import numpy as np
    folder.mkdir(parents=True, exist_ok=True)
    cage = folder / "cage.obj"
    made = context.succeed([context.flbc, "cage", model, "-o", cage,
                            "--control-points", CONTROL_POINTS])
    points, facets = judge.read_obj(model)
    corners, cage_facets = judge.read_obj(cage)
    inside = np.abs(judge.winding_numbers(points, corners, cage_facets)) > 0.5
    crossings = (judge.count_crossings(points, judge.edges_of(facets), corners, cage_facets) +
                 judge.count_crossings(corners, judge.edges_of(cage_facets), points, facets))
    distance = judge.mean_distance(corners, cage_facets, points, facets) / judge.size_of(corners)
    checked = context.run([context.flbc, "check", cage, "--model", model])
    symmetric = made.errors.split("symmetric across ")[-1][0] if "symmetric" in made.errors else ""
    row = {"model": model.stem.removesuffix("_model"), "dim": points.shape[1],
           "vertices": len(points), "control_points": len(corners),
           "outside": int((~inside).sum()), "crossings": crossings,
           "distance": float(distance), "symmetric_across": symmetric,
           "processor_seconds": made.processor_seconds,
           "check": "sound" if checked.status == 0 else checked.errors}
    return [{**row, **solve(context, [cage, "--model", model], folder / "weights.npy")}]


def models_of(context):
    """The papers' models, then the samples, 3D before 2D."""
    found = [path for path in sorted((context.models / "3d").glob("*.obj"))
             if "cage" not in path.stem]
    for folder, dim in ((context.meshes, "3d"), (context.models, "2d"), (context.meshes, "2d")):
        found += sorted((folder / dim).glob("*_model.obj"))
    for path in found:
        name = path.stem.removesuffix("_model")
        if context.wants(name) and (name in QUICK_CASES or not context.quick):
            yield path


def cages(context):
    for model in models_of(context):
        yield model.stem, functools.partial(measure_cage, context, model, context.out / "cages" / model.stem)


CAGES = ("Automatic cages of 100 control points, measured from the files alone, then flbc check and flbc solve; "
         "distance: mean distance of the cage from the model, relative to the cage size; seconds: processor time "
         "of flbc cage", cages)
