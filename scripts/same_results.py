#!/usr/bin/env python3
"""Whether two builds of the program make the same files, bit by bit.

scripts/same_results.py OLD_FLBC NEW_FLBC [--models FOLDER] [--quick]

Runs both on the samples in meshes/ and on a folder of cages and models, and compares every file that
they write: weights, meshes, models, skins and pictures byte by byte, reports but for times, paths
and versions. Ends with status 1 if anything differs.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
VARYING = {"seconds", "threads", "version", "build", "output", "path", "generator", "arguments"}


def cases(models, quick):
    """Pairs of a name and a list of commands; OUT stands for the folder of results."""
    pairs = [(cage, cage.with_name(cage.name.replace("_cage", "_model")))
             for cage in sorted((ROOT / "meshes").glob("*/*_cage.obj"))]
    if models:
        pairs += [(cage, cage.with_name(cage.name.replace("_cage", "")))
                  for cage in sorted(models.glob("3d/*_cage.obj"))]
        pairs += [(cage, None) for cage in sorted(models.glob("2d/*control*.obj"))]
    methods = ["weights", "gradient", "paper", "lbc2014", "harmonic", "meanvalue"]
    for cage, model in pairs:
        name = f"{cage.parent.name}/{cage.stem}"
        flat = cage.parent.name == "2d"
        limits = ["--vertices", "1500" if flat else "2500", "--max-iterations", "60"]
        for method in methods[:2] if quick else methods:
            yield f"{name} {method}", [
                ["solve", cage, "-o", "OUT/w.npy", "--method", method, *limits, "--save-domain",
                 "OUT/d.obj" if flat else "OUT/d.mesh", "--report", "OUT/r.json"]]
        yield f"{name} double", [
            ["solve", cage, "-o", "OUT/w.npy", "--precision", "double", "--certify", *limits,
             "--report", "OUT/r.json"]]
        yield f"{name} gradient double", [
            ["solve", cage, "-o", "OUT/w.npy", "--precision", "double", "--method", "gradient",
             *limits, "--report", "OUT/r.json"]]
        if model is None or not model.exists():
            continue
        pose = cage.with_name(cage.stem + "_pose.obj")
        poses = ["--pose", pose] if pose.exists() else ["--pose", cage]
        yield f"{name} run", [
            ["run", cage, model, *poses, "-k", "8", "-o", "OUT/run", *limits],
            ["check", cage, "--model", model, "--weights", "OUT/run/weights.npy", "--json",
             "OUT/check.json"],
            ["sparsify", "OUT/run/weights.npy", "--cage", cage, "--points", model, "-k", "4",
             "--method", "poisson", "-o", "OUT/poisson.mtx", "--report", "OUT/sparse.json"],
            ["deform", model, "--weights", "OUT/poisson.mtx", "--pose", poses[1], "-o",
             "OUT/posed.obj"],
            ["export", model, "--weights", "OUT/run/weights.npy", "--cage", cage, "-o",
             "OUT/m.glb"]]


def run(program, commands, folder):
    """Runs the commands and returns their exit statuses."""
    return [subprocess.run(
        [program, *(str(a).replace("OUT", str(folder), 1) for a in command)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
        check=False).returncode for command in commands]


def without_varying(value):
    if isinstance(value, dict):
        return {k: without_varying(v) for k, v in value.items()
                if k not in VARYING and "seconds" not in k and "time" not in k}
    if isinstance(value, list):
        return [without_varying(v) for v in value]
    if isinstance(value, str) and "/" in value:
        return pathlib.PurePath(value).name
    return value


def content(path):
    if path.suffix == ".json":
        return without_varying(json.loads(path.read_text()))
    return path.read_bytes()


def differences(old, new):
    names = {p.relative_to(f) for f in (old, new) for p in f.rglob("*") if p.is_file()}
    for name in sorted(names):
        if not (old / name).exists() or not (new / name).exists():
            yield f"{name} is made by one of them only"
        elif content(old / name) != content(new / name):
            yield f"{name} differs"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="two methods only")
    arguments = parser.parse_args()
    files = bad = 0
    for name, commands in cases(arguments.models, arguments.quick):
        with tempfile.TemporaryDirectory() as work:
            old, new = pathlib.Path(work, "a"), pathlib.Path(work, "b")
            old.mkdir(), new.mkdir()
            found = []
            before, after = run(arguments.old, commands, old), run(arguments.new, commands, new)
            if before != after:
                found.append(f"exit statuses {before} and {after}")
            found += differences(old, new)
            files += sum(p.is_file() for p in new.rglob("*"))
            bad += len(found)
            print(f"{name}: " + ("; ".join(found) if found else "the same"), flush=True)
    print(f"{files} files compared, {bad} differences")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
