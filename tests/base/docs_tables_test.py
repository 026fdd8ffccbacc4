#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and numbers of the docs equal their stored results, and docs.py would notice if one did not."""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "paper"))
import claims  # noqa: E402
import docs  # noqa: E402
import tables  # noqa: E402

CSV = """# a race
# a machine; single runs
# commit 0123abc
model,control_points,vertices,cells,method,converged,iterations,total_seconds,coarse_levels,error
logo,6,1000,1900,paper,0,10000,1.25,0,2e-05
logo,6,1000,1900,value,1,20,0.125,1,9e-06
"""
PAGE = "before\n<!-- results: race -->\n| by hand |\n<!-- end of results -->\nafter\n"


def quietly(action):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return action()


def notices_changes():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        docs.STORED, docs.PAGES = folder / "stored", [folder / "page.md"]
        page_file = docs.PAGES[0]
        docs.claims.CLAIMS = []
        page_file.write_text(PAGE)
        assert quietly(docs.check) == 0, "nothing is stored, so nothing can differ"
        (folder / "race.csv").write_text(CSV)
        assert quietly(lambda: docs.take_over(folder)) == 0
        page = page_file.read_text()
        for part in ("before", "after", "1.25 (not within 10,000)", "0.12 (20 + 1 level)", "| 6 | 1,000 |", "commit 0123abc"):
            assert part in page, part
        for old, new in (("1.25", "1.24"), ("(20 +", "(19 +"), ("0123abc", "0123abd")):
            page_file.write_text(page.replace(old, new))
            assert quietly(docs.check) == 1, f"{new} for {old} went unnoticed"
        page_file.write_text(page)
        assert quietly(docs.check) == 0
        (docs.STORED / "table9.csv").write_text(CSV)
        assert quietly(docs.check) == 1, "a result without a table went unnoticed"
        for unfit in ("quick run: small", "only models that were asked for", "incomplete: some",
                      "commit 0123abc, samples in place of the papers' cages"):
            (folder / "race.csv").write_text(f"# {unfit}\n" + CSV)
            try:
                quietly(lambda: docs.take_over(folder))
            except SystemExit:
                continue
            raise AssertionError(f"taken over: {unfit}")


def notices_numbers_in_sentences():
    def make(rows):
        return claims.where("total_seconds:.2f", model="logo", method="paper")(rows)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        said = [("page.md", "it takes {} s on logo", "race", make)]
        page = folder / "page.md"
        page.write_text("On a mesh it\ntakes 1.2 s on logo, 2 s else.\n")
        assert quietly(lambda: claims.check(folder, folder, said)) == [], "nothing is stored yet"
        (folder / "race.csv").write_text(CSV)
        assert len(claims.check(folder, folder, said)) == 1, "1.2 for 1.25 went unnoticed"
        claims.rewrite(folder, folder, said)
        assert page.read_text() == "On a mesh it\ntakes 1.25 s on logo, 2 s else.\n"
        assert claims.check(folder, folder, said) == []
        (folder / "race.csv").write_text("# busy machine: seconds are too long\n" + CSV)
        page.write_text("it takes 9 s on logo.\n")
        assert quietly(lambda: claims.check(folder, folder, said)) == [], "a busy machine's seconds count"
        worse = [("page.md", "on {} models", "race", lambda rows: [claims.WORDS[len(rows)]])]
        (folder / "race.csv").write_text(CSV)
        page.write_text("It is worse on three models.\n")
        claims.rewrite(folder, folder, worse)
        assert page.read_text() == "It is worse on two models.\n"
        page.write_text("It takes long.\n")
        assert len(claims.check(folder, folder, said)) == 1, "a sentence that is gone went unnoticed"


def table(name, lines):
    """Body of the table of a result, cells as one string per row."""
    columns, *rows = (line.split(",") for line in lines.split())
    header, body = tables.TABLES[name]([dict(zip(columns, row)) for row in rows])
    assert all(len(row) == len(header) for row in body), name
    return [" | ".join(row) for row in body]


def shows_the_numbers():
    growth = table("growth", """
model,control_points,vertices,cells,coarse_levels,iterations,setup_seconds,solve_seconds,total_seconds,peak_mebibytes
horse,51,1000,4000,0,61,0.1,0.9,1,10
horse,51,10000,40000,1,62,1,9,10,100""")
    assert growth[1] == "horse | 51 | 10,000 | 40,000 | 2 | 62 | 1.00 + 9.00 | 100 | 2,621 | 1.00, 1.00"
    speed = table("speed", """
model,control_points,vertices,coarse_levels,iterations,setup_seconds,total_seconds,error,harmonic_seconds
woody,26,1000,2,13,0.3,1.4,,0.35""")
    assert speed == ["woody | 26 | 1,000 | 13 + 2 levels | 0.300 + 1.100 = 1.400 | - | 0.350 | 4.0"]
    models = table("models", """
model,control_points,vertices,cells,coarse_levels,converged,iterations,mesh_seconds,setup_seconds,solve_seconds,harmonic_seconds,peak_mebibytes,mean_influences,harmonic_influences,min_weight,reproduction_error
woody,26,1000,1900,1,1,120,0.04,0.05,0.2,0.03,34.4,4.54,23.3,0,2e-16""")
    assert models == ["woody | 26 | 1,000 | 1,900 | 120 + 1 level | 0.04 | 0.05 | 0.20 | 0.03 | 34 | 4.5 | 23.3 | 0 | 2.0e-16"]
    harmonic = table("harmonic", """
model,control_points,vertices,mean_influences,harmonic_influences,total_seconds,harmonic_seconds
woody,26,1000,4.54,23.3,0.239,0.03
horse,51,2000,4.29,8.5,0.536,0.02""")
    assert harmonic == ["woody (2D) | 26 | 1,000 | **4.5** | 23.3 | 0.24 | 0.03",
                        "horse | 51 | 2,000 | **4.3** | 8.5 | 0.54 | 0.02"]
    solvers = table("solvers", """
model,method,converged,total_seconds
woody,lbc2014-tuned,1,0.081
woody,paper,0,9.5
woody,gradient,1,0.01
woody,value,1,0.079
horse,lbc2014-tuned,1,0.2
horse,paper,1,2.9
horse,value,1,0.3""")
    assert [line.split(" | ", 1)[1] for line in solvers] == ["**0.08** | 0.30", "**0.08** | **0.20**",
                                                             "not reached | 2.90"]
    tolerance = table("tolerance", """
model,control_points,vertices,cells,tolerance,converged,iterations,error
woody,26,1000,1900,1e-05,1,89,0.11
woody,26,1000,1900,1e-07,0,6000,2.3
horse,51,2000,7000,1e-05,1,65,0.31""")
    assert tolerance == ["woody | 1,000 | 89 (0.11) | 6,000 (limit) (2.30)", "horse | 2,000 | 65 (0.31) | -",
                         "worst |  | (0.31) | (2.30)"]
    sparsify = table("sparsify", """
weights,points,control_points,influences_before,k,method,seconds,edges_independent,edges_independent_max,edges_smooth,edges_smooth_max,edges_animation,positions_independent,positions_independent_max,positions_smooth,positions_smooth_max,positions_animation
arm,2000,58,31.8,4,quadratic,0.05,1.5,137,0.05,1.4,0.19,0.02,0.08,0.0006,0.008,0.0024
arm,2000,58,31.8,4,poisson,0.2,1.1,47,0.04,0.9,,0.021,0.08,0.0006,0.008,""")
    assert sparsify[0].endswith("| 4 | quadratic | 150 (13,700) | 5 (140) | 2 (8) | 0.06 (0.8) | 19, 0.24 | 0.050")
    assert sparsify[1].startswith(" | 4 | poisson | 110 (4,700) |")


def refuses_folders_without_cages():
    script = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "paper" / "run.sh"
    with tempfile.TemporaryDirectory() as name:
        ended = subprocess.run([script, name, f"{name}/out"], capture_output=True, text=True, timeout=20)
        assert ended.returncode == 1 and "has no cages in 2d/ or 3d/" in ended.stderr, ended
        assert not ended.stdout, "something was built"


if __name__ == "__main__":
    result = docs.check()
    refuses_folders_without_cages()
    notices_numbers_in_sentences()
    notices_changes()
    shows_the_numbers()
    sys.exit(result)
