# SPDX-License-Identifier: BSD-3-Clause
"""Seconds of every stage of `flbc run`, from files to files."""

import json
import statistics
import tempfile

NAMES = ("horse", "armadillo")
RUNS = 3  # the median of each stage is written
STAGES = ("cage", "mesh", "solve", "check", "sparsify", "export", "pictures", "total")


def stages(context, words):
    with tempfile.TemporaryDirectory() as folder:
        done = context.run([context.flbc, "run", *words, "-k", 8, "-o", f"{folder}/out", "--quiet"])
        if done.status != 0:
            context.failed(f"flbc run {' '.join(map(str, words))}: {done.errors}")
            return None
        with open(f"{folder}/out/report.json") as report:
            return json.load(report)["seconds"]


def rows(context):
    for makes_cage in (False, True):
        for name in NAMES:
            folder = context.models / "3d"
            model = folder / f"{name}.obj"
            if not context.wants(name) or not model.exists():
                continue
            words = [model, "--auto-cage"] if makes_cage else [folder / f"{name}_cage.obj", model]
            runs = [stages(context, words) for _ in range(1 if context.quick else RUNS)]
            if None in runs:
                continue
            yield {"model": name, "cage_of": "flbc" if makes_cage else "the paper",
                   **{stage: statistics.median(run[stage] for run in runs) for stage in STAGES}}


PIPELINE = ("flbc run with 8 influences: seconds of each stage, medians of 3 runs; check, pictures and page are "
            "made at the same time as sparsify and export, with one thread", rows)
