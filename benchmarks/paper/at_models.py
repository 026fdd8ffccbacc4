#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes influences.csv and gaps.csv by the program, in the order of the README. Needs no quiet machine.

    at_models.py FLBC MODELS OUT_FOLDER

influences: control points with a weight above 1e-4 at the vertices of the models that a user deforms.
gaps: what --certify proves at which --tolerance.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "meshes"
# name, cage, model, vertices of the mesh as in models.csv
MODELS = [("woody", "2d/woody-control-edgeset.obj", "2d/woody_model.obj", 10800),
          *((name, f"3d/{name}_cage.obj", f"3d/{name}.obj", vertices)
            for name, vertices in (("horse", 5850), ("armadillo", 6640), ("shark", 6000), ("beast", 6000)))]
LIMB = ("limb", SAMPLES / "3d/limb_cage.obj", SAMPLES / "3d/limb_model.obj", 10000)
TOLERANCES = ("1e-6", "1e-7", "1e-8", "1e-9")


def main(flbc, models, out):
    models, out = pathlib.Path(models), pathlib.Path(out)
    bench = pathlib.Path(flbc).resolve().parent / "benchmarks" / "flbc_bench_paper"
    commit, behavior = (subprocess.run(command, cwd=SAMPLES, check=True, capture_output=True, text=True).stdout.strip()
                        for command in (["git", "rev-parse", "--short", "HEAD"], [bench, "--behavior"]))
    origin = f"# commit {commit}; {behavior}"
    work = pathlib.Path(tempfile.mkdtemp())

    def run(*arguments, report):
        """The report of a command, which may end with 3: not converged."""
        subprocess.run([flbc, *map(str, arguments), report, work / "report.json"], capture_output=True)
        return json.loads((work / "report.json").read_text())

    def influences(cage, model, weights):
        facts = run("check", cage, "--model", model, "--weights", weights, report="--json")["weights"]
        return [f"{facts['mean_influences']:.4f}", int(facts["max_influences"])]

    with (out / "influences.csv").open("w") as file:
        print("# influences at model vertices: control points with a weight above 1e-4, mean and largest; local: all, "
              "and after the reduction to 8; independent of the machine", origin,
              "model,control_points,points,local,local_max,reduced,reduced_max,harmonic,harmonic_max", sep="\n", file=file)
        for name, cage, model, vertices in (*MODELS, LIMB):
            cage, model, row = models / cage, models / model, []
            for method in ("weights", "harmonic"):
                facts = run("solve", cage, "--model", model, "--vertices", vertices, "--method", method,
                            "-o", work / "all.npz", report="--report")
                row += influences(cage, model, work / "all.npz")
                if method == "weights":
                    few = run("sparsify", work / "all.npz", "-k", 8, "-o", work / "few.npz", report="--report")
                    row += influences(cage, model, work / "few.npz")
            print(name, facts["control_points"], few["points"], *row, sep=",", file=file, flush=True)
    with (out / "gaps.csv").open("w") as file:
        print("# flbc solve --certify with 10,000 mesh vertices: gap proven at the tolerance, in percent of the objective; "
              "independent of the machine", origin,
              "model,tolerance,iterations,gap", sep="\n", file=file)
        for name, cage, _, _ in (*MODELS, LIMB):
            for tolerance in TOLERANCES:
                facts = run("solve", models / cage, "--certify", "--tolerance", tolerance, "-o", work / "w.mtx",
                            report="--report")
                print(name, tolerance, facts["iterations"], f"{100 * facts['relative_gap']:.4g}", sep=",", file=file,
                      flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 4 else sys.exit(__doc__.strip())
