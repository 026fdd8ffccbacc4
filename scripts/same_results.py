#!/usr/bin/env python3
"""Whether two builds of the program write the same files, bit by bit: same_results.py OLD_FLBC NEW_FLBC

Runs both on the samples in meshes/ and compares all files that they write: weights, meshes, models,
skins, and pictures byte by byte, reports except for times, paths, and versions. Exit status 1 if
anything differs.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

MESHES = pathlib.Path(__file__).resolve().parent.parent / "meshes"
VARYING = {"seconds", "threads", "version", "build", "output", "path", "generator", "arguments"}


def commands():
    """Pairs of a folder for results, and what to run there."""
    for cage in sorted(MESHES.glob("*/*_cage.obj")):
        name, domain = cage.stem, "d.obj" if cage.parent.name == "2d" else "d.mesh"
        model = cage.with_name(cage.name.replace("_cage", "_model"))
        pose = cage.with_name(f"{name}_pose.obj")
        limits = f"--vertices {1500 if domain == 'd.obj' else 2500}"
        for options in ("--method weights", "--method gradient", "--method paper", "--method lbc2014",
                        "--method harmonic", "--method meanvalue", "--precision double --certify",
                        "--method gradient --precision double"):
            if options not in ("--method harmonic", "--method meanvalue"):
                options += " --max-iterations 60"
            yield f"{name} {options}", [
                f"solve {cage} {options} {limits} -o w.npy --save-domain {domain} --report r.json"]
        yield f"{name} run", [
            f"run {cage} {model} --pose {pose if pose.exists() else cage} -k 8 {limits} --max-iterations 60 -o .",
            f"check {cage} --model {model} --weights weights.npy --json check.json",
            f"sparsify weights.npy --cage {cage} --points {model} -k 4 -o few.mtx --report few.json",
            f"deform {model} --weights few.mtx --pose {cage} -o posed.obj",
            f"export {model} --weights weights.npy --cage {cage} -o m.glb"]


def comparable(value):
    if isinstance(value, dict):
        return {k: comparable(v) for k, v in value.items()
                if k not in VARYING and "seconds" not in k and "time" not in k}
    return [comparable(v) for v in value] if isinstance(value, list) else value


def results(program, lines):
    """Exit statuses, and the content of all files."""
    with tempfile.TemporaryDirectory() as folder:
        statuses = [subprocess.run([program, *line.split()], cwd=folder, capture_output=True,
                                   check=False).returncode for line in lines]
        assert 0 in statuses or 3 in statuses, f"{program} refuses {lines}"
        files = {str(path.relative_to(folder)): path for path in pathlib.Path(folder).rglob("*.*")}
        return {"exit statuses": statuses} | {
            name: comparable(json.loads(path.read_text())) if path.suffix == ".json"
            else path.read_bytes() for name, path in files.items()}


differs = False
for case, lines in commands():
    old, new = (results(pathlib.Path(program).resolve(), lines) for program in sys.argv[1:3])
    names = sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))
    differs = differs or bool(names)
    print(f"{case}: " + (", ".join(names) if names else f"the same {len(new) - 1} files"), flush=True)
sys.exit(differs)
