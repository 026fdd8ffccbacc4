# SPDX-License-Identifier: BSD-3-Clause
"""Solving and deforming on meshes of OpenMesh's, by the programs in this folder."""

import csv

# Model's name, cage and model: of the samples, or below the models folder.
FRAMES = [("limb (sample)", "limb_cage.obj", "limb_model.obj"),
          ("shark", "shark_cage.obj", "shark.obj"),
          ("armadillo", "armadillo_cage.obj", "armadillo.obj"),
          ("beast", "beast_cage.obj", "beast.obj"),
          ("horse", "horse_cage.obj", "horse.obj")]
PAIRS = 7  # of frames
PROPERTY_PAIRS = 12
REPETITIONS = 5


def rows_of(context, program, *words):
    """Rows that a program of the bindings prints."""
    path = context.build / "benchmarks" / program
    if not path.exists():
        context.failed(f"{program} was not built: OpenMesh is needed")
        return []
    done = context.run([path, *words])
    if done.status:
        context.failed(f"{program}: {done.errors}")
        return []
    return list(csv.DictReader(done.output.splitlines()))


def iterations(context):
    if not context.only_models:
        yield from rows_of(context, "flbc_bench_properties", 1 if context.quick else PROPERTY_PAIRS)


def topology(context):
    if not context.only_models:
        yield from rows_of(context, "flbc_bench_tet_mesh", 1 if context.quick else REPETITIONS)


def frames(context):
    for name, cage, model in FRAMES[:1] if context.quick else FRAMES:
        if not context.wants(name.split()[0]):
            continue
        folder = (context.meshes if "sample" in name else context.models) / "3d"
        for side, program in (("release", "flbc_bench_bind"), ("debug", "flbc_bench_bind_debug")):
            for row in rows_of(context, program, folder / cage, folder / model,
                               1 if context.quick else PAIRS, "--frames"):
                yield {"model": name, "users_side": side, **row}


ITERATIONS = ("the gradient ADMM on the mesh itself and on arrays: seconds of the last pair, "
              f"median ratio of {PROPERTY_PAIRS} pairs", iterations)
TOPOLOGY = (f"finding edges, faces and neighbours of tetrahedra: seconds, the best of {REPETITIONS}",
            topology)
FRAMES_MOVED = ("a frame of deform by the property of 8 influences beside one on arrays: median "
                f"milliseconds of 200 frames, median ratio of {PAIRS} pairs, mean frame with all cores "
                "spinning relative to the quiet one", frames)
