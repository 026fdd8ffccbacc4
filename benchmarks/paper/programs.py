#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Experiments that run flbc and other built programs, beside those of flbc_bench_paper.

    programs.py MODELS_FOLDER OUT_FOLDER BUILD_FOLDER [--commit C] [--quick] [--busy] [--only NAME,...]
                [--models A,B,...] [--threads T]

Arguments are those of flbc_bench_paper; names that are not of experiments here are left alone. Each
experiment writes OUT/NAME.csv with the same comment lines as flbc_bench_paper.
"""

import argparse
import csv
import dataclasses
import os
import pathlib
import subprocess
import sys
import time

import cages
import pipeline
import reductions

# Name to (what it is, function of the context that yields rows as dictionaries).
EXPERIMENTS = {"cages": cages.CAGES, "sparsify": reductions.SPARSIFY, "pipeline": pipeline.PIPELINE}


class Context:
    """Settings of all experiments, and how they run programs."""

    def __init__(self, arguments):
        self.models, self.out = arguments.models_folder.resolve(), arguments.out.resolve()
        self.flbc = arguments.build.resolve() / "flbc"
        self.meshes = pathlib.Path(__file__).resolve().parents[2] / "meshes"
        self.quick, self.busy, self.threads = arguments.quick, arguments.busy, arguments.threads
        self.commit, self.only_models = arguments.commit, arguments.models
        self.complete = True

    def wants(self, name):
        return not self.only_models or name in self.only_models

    def failed(self, what):
        """A case that failed does not keep the others from being measured."""
        print(what, file=sys.stderr)
        self.complete = False

    def run(self, words):
        """Exit status, seconds of the clock and of the processor, standard output and error."""
        environment = dict(os.environ, OMP_NUM_THREADS=str(self.threads))
        before, start = os.times(), time.monotonic()
        done = subprocess.run([str(word) for word in words], env=environment, text=True,
                              capture_output=True)
        after = os.times()
        processor = (after.children_user + after.children_system -
                     before.children_user - before.children_system)
        return Done(done.returncode, time.monotonic() - start, processor, done.stdout, done.stderr.strip())


@dataclasses.dataclass
class Done:
    status: int
    seconds: float
    processor_seconds: float
    output: str
    errors: str


def machine(context):
    """Processor, cores, threads and program, as flbc_bench_paper describes them."""
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    processor = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")),
                     "unknown processor")
    version = context.run([context.flbc, "--version"]).output.split("\n")[0]
    return f"{processor}, {os.cpu_count()} cores; {context.threads} threads; {version}"


def comments(context, about):
    said = {"commit " + context.commit: context.commit, "busy machine: seconds are too long": context.busy,
            "quick run: small meshes, few cases": context.quick,
            "only models that were asked for": context.only_models,
            "incomplete: some cases failed": not context.complete}
    return [about, machine(context)] + [comment for comment, holds in said.items() if holds]


def text(cell):
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def write(context, name, about, rows):
    """Whole or not at all."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    path = context.out / f"{name}.csv"
    part = path.with_suffix(".part")
    with part.open("w", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments(context, about))
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({column: text(cell) for column, cell in row.items()} for row in rows)
    part.replace(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models_folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--commit", default="")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--busy", action="store_true")
    parser.add_argument("--only", type=lambda words: words.split(","), default=[])
    parser.add_argument("--models", type=lambda words: words.split(","), default=[])
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    complete = True
    for name, (about, experiment) in EXPERIMENTS.items():
        if arguments.only and name not in arguments.only:
            continue
        context = Context(arguments)
        start = time.monotonic()
        rows = []
        for row in experiment(context):
            print(", ".join(text(cell) for cell in row.values()), flush=True)
            rows.append(row)
        if rows:
            write(context, name, about, rows)
        complete = complete and context.complete
        print(f"{name}: {time.monotonic() - start:.1f} s\n", flush=True)
    return 0 if complete else 1


if __name__ == "__main__":
    sys.exit(main())
