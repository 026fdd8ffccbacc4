# SPDX-License-Identifier: BSD-3-Clause
"""Kinds of coordinates by flbc compare, from its table."""

import functools
import json

MODELS = ("horse", "armadillo")
VERTICES = 4000
COLUMNS = ("influences", "max_influences", "reach", "min_weight", "total_variation", "distortion", "volume_change",
           "flipped", "setup_seconds", "solve_seconds")


def rows_of(context, name):
    folder = context.out / "compare" / name
    context.succeed([context.flbc, "compare", context.models / "3d" / f"{name}_cage.obj",
                     context.models / "3d" / f"{name}.obj", "--vertices", VERTICES, "-o", folder, "--force", "-q"])
    table = json.loads((folder / "table.json").read_text())
    return [{"model": name, "vertices": table["vertices"], "coordinates": kind,
             **{column: facts[column] for column in COLUMNS}} for kind, facts in table["columns"].items()]


def cases(context):
    for name in MODELS:
        if context.wants(name) and not (context.quick and name != MODELS[0]):
            yield name, functools.partial(rows_of, context, name)


COMPARE = ("flbc compare on 4,000 vertices; distortion, volume change, and flipped cells: means over poses that bend, "
           "stretch, and twist the cage", cases)
