# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of README.md, of the samples: a pose and a coordinate function."""

WIDTH = 640  # of the coordinate function's picture


def samples(context):
    """Writes OUT/samples/before_after.png and figure.png; there are no numbers."""
    folder = context.out / "samples"
    solid, plane = context.meshes / "3d", context.meshes / "2d"
    commands = [
        ("run", solid / "limb_cage.obj", solid / "limb_model.obj", "--pose",
         solid / "limb_cage_pose.obj", "-k", 8, "-o", folder / "limb", "--vertices", 4000, "-q"),
        ("run", plane / "figure_cage.obj", plane / "figure_model.obj", "-o", folder / "figure", "-q"),
        ("draw", folder / "figure" / "domain.obj", "--weights", folder / "figure" / "domain_weights.npy",
         "--cage", plane / "figure_cage.obj", "--control-point", 32, "--width", WIDTH, "-o",
         folder / "figure.png")]
    if context.only_models:
        return []
    folder.mkdir(parents=True, exist_ok=True)
    for words in commands:
        done = context.run([context.flbc, *words])
        if done.status:
            context.failed(f"samples: {done.errors}")
            return []
    (folder / "limb" / "deformation.png").replace(folder / "before_after.png")
    return []


SAMPLES = ("pictures of the samples", samples)
