# SPDX-License-Identifier: BSD-3-Clause
"""Seconds of every stage of `flbc run`, from files to files."""

import functools
import json
import statistics
import tempfile

NAMES = ("horse", "armadillo")
RUNS = 3  # the median of each stage is written
STAGES = ("cage", "mesh", "solve", "check", "sparsify", "export", "pictures", "total")


def stages(context, words):
    with tempfile.TemporaryDirectory() as folder:
        context.succeed([context.flbc, "run", *words, "-k", 8, "-o", f"{folder}/out", "--quiet"])
        with open(f"{folder}/out/report.json") as report:
            return json.load(report)["seconds"]


def row_of(context, name, cage_of, words):
    runs = [stages(context, words) for _ in range(1 if context.quick else RUNS)]
    return [{"model": name, "cage_of": cage_of,
             **{stage: statistics.median(run[stage] for run in runs) for stage in STAGES}}]


def cases(context):
    for makes_cage in (False, True):
        for name in NAMES:
            folder = context.models / "3d"
            model = folder / f"{name}.obj"
            if not context.wants(name) or not model.exists():
                continue
            words = [model, "--auto-cage"] if makes_cage else [folder / f"{name}_cage.obj", model]
            cage_of = "flbc" if makes_cage else "the paper"
            yield f"{name}, cage of {cage_of}", functools.partial(row_of, context, name, cage_of, words)


PIPELINE = ("flbc run with 8 influences: seconds of each stage, medians of 3 runs; check, pictures, and page run at "
            "the same time as sparsify and export, on one thread", cases)
