#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes pictures of the samples from pictures of the program, all or those that are named:
    samples.py [smoothness|coordinates|deformation|before_after|automatic_cages ...]
"""
import sys

import numpy as np
from common import MESHES, Image, findings, flbc, page, read_obj, save, working_folder, write, write_moved

INK = (33, 38, 48)
LIZARD = MESHES / "2d/figure_cage.obj"
CONTROL_POINT = 32


def sheet(panels, columns, width=450, height=512):
    """Panels in rows, each a picture, a title above it, and perhaps a text below it."""
    rows = -(-len(panels) // columns)
    picture, draw = page(columns * width, rows * height)
    for k, (panel, title, *texts) in enumerate(panels):
        left, top = k % columns * width, k // columns * height
        panel.thumbnail((width - 8, height - 48 - 40 * len(texts)), Image.Resampling.LANCZOS)
        picture.paste(panel, (left + (width - panel.width) // 2, top + 48))
        write(draw, (left + width // 2, top + 28), title, 26, "Bold", color=INK)
        for text in texts:
            write(draw, (left + width // 2, top + height - 24), text, 22, color=INK)
    return picture.convert("RGB")


def drawn(model, *words, picture):
    flbc("draw", model, *words, "--width", 640, "-o", picture)
    return Image.open(picture).convert("RGB")


def without_legend(picture):
    """The part left of the color bar."""
    return picture.crop((0, 0, round(0.87 * picture.width), picture.height))


def smoothness(work):
    domain = work / "domain.obj"
    flbc("mesh", LIZARD, "--vertices", 10000, "-q", "-o", domain)
    panels = []
    for value in ("0", "0.003", "0.01", "0.03", "harmonic"):
        weights, how = work / f"{value}.npy", ("--method" if value == "harmonic" else "--smoothness", value)
        flbc("solve", LIZARD, "--domain", domain, *how, "-q", "-o", weights)
        picture = drawn(domain, "--weights", weights, "--cage", LIZARD, "--control-point", CONTROL_POINT,
                        picture=work / f"{value}.png")
        found = findings(LIZARD, "--domain", domain, "--weights", weights)["weights"]
        panels.append((without_legend(picture), value if value == "harmonic" else f"smoothness {value}",
                       f"{found['mean_influences']:.1f} influences per vertex"))
    return sheet(panels, 5, 364, 555)


def coordinates(work):
    flbc("compare", LIZARD, "--control-point", CONTROL_POINT, "--force", "-q", "-o", work)
    return Image.open(work / "functions.png").convert("RGB")


def run(work, sample, control_point, width):
    flbc("run", f"{sample}_cage.obj", f"{sample}_model.obj", "--pose", f"{sample}_cage_pose.obj",
         "--control-point", control_point, "-q", "-o", work)
    picture = Image.open(work / "deformation.png").convert("RGB")
    return picture.resize((width, round(picture.height * width / picture.width)), Image.Resampling.LANCZOS)


def deformation(work):
    return run(work, MESHES / "2d/figure", CONTROL_POINT, 1200)


def before_after(work):
    return run(work, MESHES / "3d/limb", 20, 600)


def automatic_cages(work):
    """Samples in cages that flbc makes, bent about an axis of their bounding box."""
    panels = []
    for name, axis, along, degrees in (("character", 2, 1, 60), ("limb", 2, 0, -70), ("star", 2, 1, 110), ("knot", 1, 0, 80)):
        model, cage, weights, pose = MESHES / f"3d/{name}_model.obj", *(work / f"{name}{end}" for end in
                                                                       ("_cage.obj", ".npz", "_pose.obj"))
        flbc("cage", model, "-o", cage)
        flbc("solve", cage, "--model", model, "-q", "-o", weights)
        points = read_obj(cage)[0]
        center = (points.min(0) + points.max(0)) / 2
        angles = np.radians(degrees) * np.clip((points[:, along] - center[along]) / np.ptp(points[:, along]), 0, 1)
        a, b = [d for d in range(3) if d != axis]
        x, y = points[:, a] - center[a], points[:, b] - center[b]
        points[:, a] = center[a] + np.cos(angles) * x - np.sin(angles) * y
        points[:, b] = center[b] + np.sin(angles) * x + np.cos(angles) * y
        write_moved(cage, points, pose)
        picture = drawn(model, "--weights", weights, "--pose", pose, picture=work / f"{name}.png")
        panels.append((picture, f"{name.capitalize()}, {len(points)} control points"))
    return sheet(panels, 2, 660, 540)


if __name__ == "__main__":
    for wanted in sys.argv[1:] or ("smoothness", "coordinates", "deformation", "before_after", "automatic_cages"):
        with working_folder() as folder:
            save(globals()[wanted](folder), f"{wanted}.png")
