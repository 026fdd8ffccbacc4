#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Keeps the tables and measurements of README.md and docs/ equal to stored results.

    docs.py OUT_FOLDER    copies the results of OUT_FOLDER (a full run of all models), writes tables and
                          measurements, and draws the chart of the race
    docs.py --stored      writes tables and measurements of the stored results again
    docs.py --check       fails if a table or a measurement differs from the stored results it is made of, or
                          a stored result from docs/results/SHA256SUMS
    docs.py --behavior PROGRAM
                          names the results of another behavior than that of flbc_bench_paper (README.md), and
                          then exits with 77

A table is on a page between <!-- results: NAME --> and <!-- end of results -->. Its results are in
docs/results/NAME.csv, as flbc_bench_paper wrote them, or in the file that tables.SOURCES names. Its
last line has the commit that made it. A measurement, or a statement that compares, is between
<!--n:NAME--> and <!--/n-->; measured.NUMBERS computes it from its result, a statement as "no longer true" if the result
contradicts it. FROZEN results are not measured again: the program that measured is in their commit. Every stored result is
in a table or in a measurement, or a page links to it.
"""

import hashlib
import math
import pathlib
import re
import shutil
import subprocess
import sys

import measured
import results
import tables

ROOT = pathlib.Path(__file__).resolve().parents[2]
STORED = ROOT / "docs" / "results"
MARKED = re.compile(r"(<!-- results: (\w+) -->\n)(.*?)(<!-- end of results -->\n)", re.DOTALL)
NUMBER = re.compile(r"(<!--n:([\w.-]+)-->)(.*?)(<!--/n-->)")
LINK = re.compile(r"\(\S*results/(\w+)\.csv\)")
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FROZEN = {"cages", "compare", "figure3", "figure5", "figure6", "many", "pipeline", "smoothness", "sparsify", "tolerance"}
UNFIT = ("quick run", "incomplete", "only models")  # comments of results not to be taken over


def table(name, present):
    return tables.markdown(STORED, name) if (STORED / f"{tables.source_of(name)}.csv").exists() else present


def number(name, present):
    return measured.text(STORED, name) if (STORED / f"{measured.source_of(name)}.csv").exists() else present


def with_results(page):
    page = MARKED.sub(lambda m: m[1] + table(m[2], m[3]) + m[4], page)
    return NUMBER.sub(lambda m: m[1] + number(m[2], m[3]) + m[4], page)


def sources(page):
    """The stored results that a page shows, or is to show."""
    return ({tables.source_of(m[2]) for m in MARKED.finditer(page)} |
            {measured.source_of(m[2]) for m in NUMBER.finditer(page)} | {m[1] for m in LINK.finditer(page)})


def sums():
    """Of the stored results, as sha256sum prints them."""
    return "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n"
                   for path in sorted(STORED.glob("*.csv")))


def check():
    if (STORED / "SHA256SUMS").exists() and (STORED / "SHA256SUMS").read_text() != sums():
        print("docs/results/SHA256SUMS: a stored result was changed by hand", file=sys.stderr)
        return 1
    pages = {page: page.read_text() for page in PAGES}
    stored = {path.stem for path in STORED.glob("*.csv")}
    shown = set().union(*map(sources, pages.values()))
    for source in sorted(shown - stored):
        print(f"{source}: nothing stored yet, so not checked")
    problems = [f"docs/results/{name}.csv is on no page" for name in sorted(stored - shown)]
    for page, text in pages.items():
        problems += [f"{page.name}: the table {m[2]} differs from docs/results/{tables.source_of(m[2])}.csv"
                     for m in MARKED.finditer(text) if m[3] != table(m[2], m[3])]
        problems += [f"{page.name}: {m[2]} is {number(m[2], m[3])}, not {m[3]}"
                     for m in NUMBER.finditer(text) if m[3] != number(m[2], m[3])]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def rewrite():
    (STORED / "SHA256SUMS").write_text(sums())
    for page in PAGES:
        page.write_text(with_results(page.read_text()))


def behavior_of(text):
    """Name of each entry to its iterations and its weights."""
    return {name: (int(iterations), float(weights))
            for name, iterations, weights in re.findall(r"(\w[\w ]*) (\d+)/([\d.]+)", text)}


def differences(before, now):
    """Names of the present entries that differ by more than vector width and compiler explain."""
    return [name for name in now
            if name not in before
            or not math.isclose(before[name][0], now[name][0], rel_tol=0.02)
            or not math.isclose(before[name][1], now[name][1], rel_tol=0, abs_tol=1.5e-5)]


SKIPPED = 77  # as CMake knows it


def check_behavior(program):
    printed = subprocess.run([program, "--behavior"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    now = behavior_of(printed)
    stale = []
    for path in sorted(STORED.glob("*.csv")):
        if path.stem in FROZEN:
            continue
        _, comments = results.read(STORED, path.stem)
        commit = next((comment for comment in comments if comment.startswith("commit ")), "")
        if differences(behavior_of(commit.partition(";")[2]), now):
            stale.append(path.name)
    if not stale:
        return 0
    print("skipped: measured with another behavior of the program, to be measured again before a release: "
          + ", ".join(stale))
    return SKIPPED


def take_over(out):
    STORED.mkdir(exist_ok=True)
    for name in sorted(set().union(*(sources(page.read_text()) for page in PAGES)) - FROZEN):
        _, comments = results.read(out, name)
        if any(c.startswith(UNFIT) for c in comments):
            sys.exit(f"docs.py: {name}.csv is of a quick, partial or incomplete run; nothing was taken over")
        if comments:
            shutil.copy(out / f"{name}.csv", STORED)
    rewrite()
    return check()


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--behavior":
        sys.exit(check_behavior(sys.argv[2]))
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    if sys.argv[1] == "--check":
        sys.exit(check())
    if sys.argv[1] == "--stored":
        rewrite()
        sys.exit(check())
    status = take_over(pathlib.Path(sys.argv[1]))
    import plots
    for draw in (plots.draw_race, plots.draw_errors):
        print(draw(STORED, ROOT / "docs" / "images"))
    sys.exit(status)
