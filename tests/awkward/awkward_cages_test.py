#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Cages nobody tuned for: each is checked and solved, or refused by name.

    awkward_cages_test.py FLBC OUT_FOLDER [--only REGEX] [-v]

Runs `flbc check` and `flbc solve` on each generated cage, and judges exit
status, messages, files and weights. The last line counts what became of them.
"""

import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

import judge
import shapes_2d
import shapes_3d

MESH_SECONDS = 10  # of a run of the mesher
MOST_SECONDS = 20  # of processor time, of a whole command
WAIT = 90           # seconds of a clock, on machines where others work as well


def write_obj(path, cage, dim):
    points, elements = cage
    with path.open("w") as out:
        for p in points:
            out.write("v " + " ".join(repr(x) for x in p) + "\n")
        for element in elements:
            indices = [str(i + 1) for i in element]
            if dim == 2:
                out.write("l " + " ".join(indices + indices[:1]) + "\n")
            else:
                out.write("f " + " ".join(indices) + "\n")


def used_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Command:
    """A command that ended: its status, what it said, and the processor time that it took."""

    def __init__(self, *words):
        before = used_seconds()
        self.hung = False
        process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, preexec_fn=os.setpgrp)
        try:
            self.output, self.message = process.communicate(timeout=WAIT)
        except subprocess.TimeoutExpired:
            self.hung = True
            os.killpg(process.pid, signal.SIGKILL)
            self.output, self.message = process.communicate()
        self.status = process.returncode
        self.seconds = used_seconds() - before

    def faults(self, file):
        """Faults of a command whatever the cage."""
        if self.hung or self.seconds > MOST_SECONDS:
            yield f"took {self.seconds:.1f} s"
        if self.status < 0:
            yield f"ended by signal {-self.status}"
        elif self.status not in (0, 2, 3):
            yield f"status {self.status}: {self.message.strip()}"
        if self.status == 2 and str(file) not in self.message:
            yield f"refused without naming the file: {self.message.strip()}"


def solve_faults(solve, dim, cage, expected, files):
    yield from solve.faults(files["cage"])
    here = {path.name for path in files["folder"].iterdir()} - {files["cage"].name}
    wanted = {files[key].name for key in ("weights", "domain", "report")}
    if solve.status in (0, 3):
        if expected is False:
            yield "was solved, though it is no cage"
        if here != wanted:
            yield f"wrote {sorted(here)} instead of {sorted(wanted)}"
            return
        json.loads(files["report"].read_text())
        yield from judge.weight_faults(files["weights"], files["domain"], dim, cage[0])
    else:
        if expected:
            yield f"was not solved: {solve.message.strip()}"
        if here:
            yield f"left {sorted(here)}"


def judged(flbc, folder, name, dim, expected, cage):
    """Status of check and solve, seconds, the messages, and what is wrong with them."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    files = {"folder": folder, "cage": folder / f"{name}.obj", "weights": folder / "weights.npy",
             "domain": folder / ("domain.obj" if dim == 2 else "domain.mesh"),
             "report": folder / "report.json"}
    write_obj(files["cage"], cage, dim)
    check = Command(flbc, "check", files["cage"])
    faults = [f"check {fault}" for fault in check.faults(files["cage"])]
    solve = Command(flbc, "solve", files["cage"], "--vertices", 300, "--mesh-timeout",
                    MESH_SECONDS, "--max-iterations", 100, "--quiet", "-o", files["weights"],
                    "--save-domain", files["domain"], "--report", files["report"])
    faults += [f"solve {fault}" for fault in solve_faults(solve, dim, cage, expected, files)]
    if check.status == 2 and solve.status != 2:
        faults.append(f"check refuses what solve takes: {check.message.strip()}")
    if check.status == 0 and solve.status == 2 and "thinnest place" not in check.output:
        faults.append("check did not warn")
    shutil.rmtree(folder)
    return check, solve, faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("flbc")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("-v", "--verbose", action="store_true")
    options = parser.parse_args()
    os.environ.update(OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive")

    # Self-test: the checker detects wrong weights.
    judge.test_itself()
    counts, worst, wrong, late = {}, (0.0, "none"), 0, []
    begin = time.monotonic()
    rows = [row for row in [(2, *row) for row in shapes_2d.cages()] + [(3, *row) for row in shapes_3d.cages()]
            if re.search(options.only, f"{row[0]}d_{row[1]}")]
    for dim, name, expected, cage in rows:
        check, solve, faults = judged(options.flbc, options.folder / f"{dim}d_{name}", name, dim,
                                      expected, cage)
        counts[solve.status] = counts.get(solve.status, 0) + 1
        worst = max(worst, (solve.seconds, name))
        if check.status == 0 and solve.status == 2:
            late.append(name)
        wrong += bool(faults)
        if options.verbose or faults:
            print(f"{dim}D {name}: check {check.status}, solve {solve.status}, "
                  f"{solve.seconds:.1f} s: {solve.message.strip()[:300]}", flush=True)
        for fault in faults:
            print(f"  FAULT: {fault}", flush=True)
    print(f"{len(rows)} cages, {sum(len(row[3][0]) for row in rows)} control points, "
          f"{time.monotonic() - begin:.0f} s; solved {counts.get(0, 0)}, not converged "
          f"{counts.get(3, 0)}, refused {counts.get(2, 0)} (of these by the mesher, after check "
          f"found nothing: {len(late)}: {' '.join(late)}); longest: {worst[1]}, {worst[0]:.1f} s")
    sys.exit(f"{wrong} cages with faults" if wrong else 0)


if __name__ == "__main__":
    main()
