#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables, measurements, and comparisons of the docs follow from their stored results, and docs.py would notice if one did not."""

import contextlib
import io
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "paper"))
import docs  # noqa: E402
import measured  # noqa: E402

CSV = """# a race
# a machine; single runs
# commit 0123abc
model,control_points,vertices,cells,method,converged,iterations,total_seconds,coarse_levels,error
logo,6,1000,1900,paper,0,10000,1.25,0,2e-05
logo,6,1000,1900,value,1,20,0.125,1,9e-06
cup,6,1000,1900,paper,1,100,1.5,0,2e-05
cup,6,1000,1900,value,1,20,0.5,1,9e-06
"""
PAGE = """before, <!--n:race.ratio.paper-->by hand<!--/n--> times
<!-- results: race -->
| by hand |
<!-- end of results -->
after
"""


RANDOM = random.Random(7)


def quietly(action):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return action()


def notices_changes():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        docs.STORED, docs.PAGES = folder / "stored", [folder / "page.md"]
        page_file = docs.PAGES[0]
        page_file.write_text(PAGE)
        assert quietly(docs.check) == 0, "nothing is stored, so nothing can differ"
        (folder / "race.csv").write_text(CSV)
        assert quietly(lambda: docs.take_over(folder)) == 0
        page = page_file.read_text()
        for part in ("before", "after", "| 1.25 (not reached) |", "| 0.12 |", "| 6 | 1,000 |", "commit 0123abc"):
            assert part in page, part
        for old, new in (("1.25", "1.24"), ("| 0.12 |", "| 0.13 |"), ("0123abc", "0123abd")):
            page_file.write_text(page.replace(old, new))
            assert quietly(docs.check) == 1, f"{new} for {old} went unnoticed"
        page_file.write_text(page)
        assert quietly(docs.check) == 0
        (docs.STORED / "SHA256SUMS").unlink()
        (docs.STORED / "table9.csv").write_text(CSV)
        assert quietly(docs.check) == 1, "a result without a table went unnoticed"
        (docs.STORED / "table9.csv").unlink()
        page_file.write_text(page.replace("<!--n:race.ratio.paper-->3.0 to 3.0", "<!--n:race.ratio.paper-->3.1 to 3.0"))
        assert quietly(docs.check) == 1, "another measurement in a sentence went unnoticed"
        page_file.write_text(page)
        for unfit in ("quick run: small", "only models that were asked for", "incomplete: some"):
            (folder / "race.csv").write_text(f"# {unfit}\n" + CSV)
            try:
                quietly(lambda: docs.take_over(folder))
            except SystemExit:
                continue
            raise AssertionError(f"taken over: {unfit}")


def with_another_digit(text, spans):
    """The text with a digit of one of the spans replaced."""
    at = RANDOM.choice([k for start, end in spans for k in range(start, end) if text[k].isdigit()])
    digit = RANDOM.choice([c for c in "0123456789" if c != text[at]])
    return text[:at] + digit + text[at + 1:]


def notices_any_digit():
    """In measurements, tables, and stored results."""
    pages, stored = docs.PAGES, docs.STORED
    with tempfile.TemporaryDirectory() as name:
        docs.STORED = pathlib.Path(name) / "results"
        shutil.copytree(stored, docs.STORED)
        docs.PAGES = [pathlib.Path(name) / f"{k}.md" for k in range(len(pages))]
        for page, copy in zip(pages, docs.PAGES):
            copy.write_text(page.read_text())
        shown = [page for page in docs.PAGES if docs.MARKED.search(page.read_text())]
        for _ in range(10):
            page = RANDOM.choice(shown)
            text = page.read_text()
            numbers = [m.span(3) for m in docs.NUMBER.finditer(text) if re.search(r"\d", m[3])]
            rows = [m.span(3) for m in docs.MARKED.finditer(text)]
            page.write_text(with_another_digit(text, RANDOM.choice([numbers or rows, rows])))
            assert quietly(docs.check) == 1, f"another digit of {page.name} went unnoticed"
            page.write_text(text)
        results = sorted(docs.STORED.glob("*.csv"))
        for _ in range(10):
            path = RANDOM.choice(results)
            text = path.read_text()
            path.write_text(with_another_digit(text, [(0, len(text))]))
            assert quietly(docs.check) == 1, f"another digit of {path.name} went unnoticed"
            path.write_text(text)
        assert quietly(docs.check) == 0
    docs.PAGES, docs.STORED = pages, stored


def with_another_cell(text):
    """The text of a stored result with one number multiplied by up to 1e8."""
    lines = text.splitlines()
    at = RANDOM.choice([k for k, line in enumerate(lines) if not line.startswith("#")][1:])
    cells = lines[at].split(",")
    column = RANDOM.choice([k for k, cell in enumerate(cells) if re.fullmatch(r"-?[\d.]+(e-?\d+)?", cell)])
    lines[at] = ",".join([*cells[:column], repr(float(cells[column]) * 10 ** RANDOM.uniform(-8, 8)), *cells[column + 1:]])
    return "\n".join(lines) + "\n"


def finds_false_statements():
    """Two random changes of a result that make a statement false are found, for each statement."""
    stored = docs.STORED
    with tempfile.TemporaryDirectory() as name:
        docs.STORED = pathlib.Path(name)
        for path in stored.glob("*.csv"):
            shutil.copy(path, docs.STORED)
        for claim in 2 * list(measured.CLAIMS):
            path = docs.STORED / f"{measured.source_of(claim)}.csv"
            text = path.read_text()
            for _ in range(2000):
                path.write_text(with_another_cell(text))
                with contextlib.suppress(KeyError):  # the cell is what rows are found by
                    if measured.text(docs.STORED, claim).startswith(measured.FALSE):
                        break
            else:
                raise AssertionError(f"no change of {path.name} makes {claim} false")
            printed = io.StringIO()
            with contextlib.redirect_stderr(printed):
                assert docs.check() == 1
            assert f"{claim} is {measured.FALSE}" in printed.getvalue(), f"{claim} is false and went unnoticed"
            path.write_text(text)
    docs.STORED = stored


def shows_all_measurements():
    """Each number and statement that measured.py computes is on a page."""
    shown = {m[2] for page in docs.PAGES for m in docs.NUMBER.finditer(page.read_text())}
    assert shown == set(measured.NUMBERS), shown ^ set(measured.NUMBERS)


def finds_other_behavior():
    here = docs.behavior_of("figure 320/0.69511, limb smooth 57/0.72545")
    assert here == {"figure": (320, 0.69511), "limb smooth": (57, 0.72545)}, here
    for text, names in (("figure 322/0.69512, limb smooth 57/0.72545", []),
                        ("figure 340/0.69511, limb smooth 57/0.72545", ["figure"]),
                        ("figure 320/0.69511, limb smooth 57/0.72548", ["limb smooth"]),
                        ("figure 320/0.69511", ["limb smooth"])):
        assert docs.differences(docs.behavior_of(text), here) == names, text


def refuses_folders_without_cages():
    script = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "paper" / "run.sh"
    with tempfile.TemporaryDirectory() as name:
        ended = subprocess.run([script, name, f"{name}/out"], capture_output=True, text=True, timeout=20)
        assert ended.returncode == 1 and "has no cages in 2d/ or 3d/" in ended.stderr, ended
        assert not ended.stdout, "something was built"


if __name__ == "__main__":
    result = docs.check()
    shows_all_measurements()
    notices_any_digit()
    finds_false_statements()
    finds_other_behavior()
    refuses_folders_without_cages()
    notices_changes()
    sys.exit(result)
