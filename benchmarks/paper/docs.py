#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Keeps the tables in docs/results.md equal to stored results.

    docs.py OUT_FOLDER    takes over OUT_FOLDER's results (a full run of all models) and writes the tables
    docs.py --check       fails if a table differs from the stored results it is made of

A table stands in docs/results.md between <!-- results: NAME --> and <!-- end of results -->, its results
in docs/results/NAME.csv as flbc_bench_paper wrote them. Its last line names the commit that made it.
"""

import pathlib
import re
import shutil
import sys

import results
import tables

ROOT = pathlib.Path(__file__).resolve().parents[2]
STORED = ROOT / "docs" / "results"
PAGE = ROOT / "docs" / "results.md"
MARKED = re.compile(r"(<!-- results: (\w+) -->\n)(.*?)(<!-- end of results -->\n)", re.DOTALL)
SHORT = {"lbc2014": "lbc2014", "lbc2014-tuned": "tuned", "paper": "paper", "gradient": "gradient",
         "gradient-local": "gradient, no linear system", "value": "**value**"}


def race(rows):
    """Seconds to the error, in brackets iterations; a line per model."""
    names = [name for name, _, _, _ in results.METHODS if any(r["method"] == name for r in rows)]
    body = []
    for model in results.in_order(r["model"] for r in rows):
        cells = []
        for name in names:
            found = [r for r in rows if r["model"] == model and r["method"] == name]
            if not found:
                cells.append("-")
                continue
            row = found[0]
            reached = "" if row["converged"] == "1" else "not within "
            cells.append(f"{results.value(row, 'total_seconds'):.2f} "
                         f"({reached}{results.thousands(row['iterations'])})")
        body.append([model] + cells)
    return ["model"] + [SHORT[name].strip("*") for name in names], body


def table2(rows):
    header = ["model", "method", "iterations", "s", "error", "gap", "min", "infl"]
    body = []
    for row in rows:
        title = f"{row['model']}, n = {row['control_points']}, {results.thousands(row['vertices'])} V"
        if row["paper_lbc_error"]:
            title += (f" ({results.value(row, 'paper_lbc_error'):.1e} / "
                      f"{results.value(row, 'paper_flbc_error'):.1e})")
        first = not body or row["model"] != last_model
        last_model = row["model"]
        limit = "" if row["converged"] == "1" else " (limit)"
        body.append([title if first else "", SHORT[row["method"]], row["iterations"] + limit] +
                    [tables.text(results.value(row, c), form) for c, form in
                     (("total_seconds", ".2f"), ("error", ".1e"), ("relative_gap", ".1e"),
                      ("min_weight", ".1e"), ("mean_influences", ".1f"))])
    return header, body


def plain(rows):
    """Every column of the file, numbers in three digits."""
    columns = [c for c in rows[0] if any(r[c] for r in rows)]
    return [c.replace("_", " ") for c in columns], [[brief(r[c]) for c in columns] for r in rows]


def brief(cell):
    try:
        number = float(cell)
    except ValueError:
        return cell
    return f"{int(number):,}" if number == int(number) and abs(number) < 1e9 else f"{number:.3g}"


TABLES = {"race": race, "table2": table2, "table1": tables.table1_rows, "figure3": tables.growth_rows}


def written(name):
    """The table of a stored result, with the commit that made it."""
    rows, comments = results.read(STORED, name)
    header, body = TABLES.get(name, plain)(rows)
    lines = ["| " + " | ".join(header) + " |", "|---" * len(header) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in body]
    commit = next((c for c in comments if c.startswith("commit ")), "commit unknown")
    return "\n".join(lines) + f"\n\n(docs/results/{name}.csv, {commit})\n"


def with_tables(page):
    return MARKED.sub(lambda m: m[1] + (written(m[2]) if (STORED / f"{m[2]}.csv").exists() else m[3])
                      + m[4], page)


def check():
    page = PAGE.read_text()
    marked = {m[2] for m in MARKED.finditer(page)}
    stored = {path.stem for path in STORED.glob("*.csv")}
    problems = [f"docs/results/{name}.csv has no table in docs/results.md" for name in stored - marked]
    for match in MARKED.finditer(page):
        if match[2] not in stored:
            print(f"{match[2]}: nothing stored yet, so not checked")
        elif match[3] != written(match[2]):
            problems.append(f"the table {match[2]} differs from docs/results/{match[2]}.csv")
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def take_over(out):
    STORED.mkdir(exist_ok=True)
    for name in {m[2] for m in MARKED.finditer(PAGE.read_text())}:
        _, comments = results.read(out, name)
        if any("quick" in c or "incomplete" in c for c in comments):
            sys.exit(f"docs.py: {name}.csv is of a quick or incomplete run; nothing was taken over")
        if comments:
            shutil.copy(out / f"{name}.csv", STORED)
    PAGE.write_text(with_tables(PAGE.read_text()))
    return check()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    sys.exit(check() if sys.argv[1] == "--check" else take_over(pathlib.Path(sys.argv[1])))
