#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Experiments that run flbc, in addition to those of flbc_bench_paper.

    programs.py MODELS_FOLDER OUT_FOLDER BUILD_FOLDER [--origin O] [--quick] [--busy] [--only NAME,...]
                [--models A,B,...] [--threads T]

Arguments are those of flbc_bench_paper; names of its experiments are ignored here. Each experiment
writes OUT/NAME.csv with the same comment lines, after each case, so that a run that was stopped resumes.
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
import comparison
import pipeline
import reductions
import results

# Name to (what it is, function of the context that yields cases: a name and what makes its rows).
EXPERIMENTS = {"cages": cages.CAGES, "sparsify": reductions.SPARSIFY, "pipeline": pipeline.PIPELINE,
               "compare": comparison.COMPARE}
INCOMPLETE = "incomplete: some cases are missing"


class Context:
    """Settings of all experiments, and how they run programs."""

    def __init__(self, arguments):
        self.models, self.out = arguments.models_folder.resolve(), arguments.out.resolve()
        self.flbc = arguments.build.resolve() / "flbc"
        self.meshes = pathlib.Path(__file__).resolve().parents[2] / "meshes"
        self.quick, self.busy, self.threads = arguments.quick, arguments.busy, arguments.threads
        self.origin, self.only_models = arguments.origin, arguments.models

    def wants(self, name):
        return not self.only_models or name in self.only_models

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

    def succeed(self, words):
        """The same for a program that has to succeed."""
        done = self.run(words)
        if done.status:
            raise RuntimeError(done.errors)
        return done


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
    said = {"busy machine: seconds are too long": context.busy,
            "quick run: small meshes, few cases": context.quick,
            "only models that were asked for": context.only_models}
    return [about, machine(context), context.origin] + [comment for comment, holds in said.items() if holds]


def text(cell):
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def write(path, comments, rows):
    """Whole or not at all."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    part = path.with_suffix(".part")
    with part.open("w", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments)
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({column: text(cell) for column, cell in row.items()} for row in rows)
    part.replace(path)


def measure(context, name, about, experiment):
    """Writes OUT/NAME.csv after each case that it does not hold yet. Returns whether none failed."""
    said = comments(context, about)
    rows, before = results.read(context.out, name)
    if "-dirty" in context.origin or [line for line in before if line != INCOMPLETE] != said:
        rows = []
    path = context.out / f"{name}.csv"
    complete = True
    for which, make in experiment(context):
        if any(row["case"] == which for row in rows):
            continue
        try:
            found = list(make())
        except RuntimeError as failure:
            print(f"{name}: {which}: {failure}", file=sys.stderr)
            complete = False
            continue
        for row in found:
            rows.append({"case": which, **row})
            print(", ".join(text(cell) for cell in rows[-1].values()), flush=True)
        write(path, [*said, INCOMPLETE], rows)
    if complete and rows:
        write(path, said, rows)
    return complete


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models_folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--origin", default="")
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
        start = time.monotonic()
        complete = measure(Context(arguments), name, about, experiment) and complete
        print(f"{name}: {time.monotonic() - start:.1f} s\n", flush=True)
    return 0 if complete else 1


if __name__ == "__main__":
    sys.exit(main())
