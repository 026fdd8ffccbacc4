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
import os
import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cages"))
import measure  # noqa: E402
import reductions  # noqa: E402

# Name to (what it is, function of the context that yields rows as dictionaries).
EXPERIMENTS = {"cages": measure.CAGES, "sparsify": reductions.SPARSIFY}


class Context:
    """Settings of all experiments, and how they run programs."""

    def __init__(self, arguments):
        self.models = arguments.models_folder.resolve()
        self.out = arguments.out.resolve()
        self.build = arguments.build.resolve()
        self.flbc = self.build / "flbc"
        self.meshes = HERE.parents[1] / "meshes"
        self.quick = arguments.quick
        self.threads = arguments.threads
        self.commit = arguments.commit
        self.busy = arguments.busy
        self.only_models = arguments.models
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


class Done:
    def __init__(self, status, seconds, processor_seconds, output, errors):
        self.status, self.seconds, self.processor_seconds = status, seconds, processor_seconds
        self.output, self.errors = output, errors


def machine(context):
    """Processor, cores, threads and program, as flbc_bench_paper describes them."""
    processor = "unknown processor"
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            processor = line.split(":", 1)[1].strip()
            break
    version = context.run([context.flbc, "--version"]).output.split("\n")[0]
    return f"{processor}, {os.cpu_count()} cores; {context.threads} threads; {version}"


def comments(context, about):
    lines = [about, machine(context)]
    if context.commit:
        lines.append("commit " + context.commit)
    if context.busy:
        lines.append("busy machine: seconds are too long")
    if context.quick:
        lines.append("quick run: small meshes, few cases")
    if context.only_models:
        lines.append("only models that were asked for")
    if not context.complete:
        lines.append("incomplete: some cases failed")
    return lines


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


def names(words):
    return words.split(",")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models_folder", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--commit", default="")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--busy", action="store_true")
    parser.add_argument("--only", type=names, default=[])
    parser.add_argument("--models", type=names, default=[])
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
