# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts of pictures share: the program, OBJ files, and text. Needs NumPy and Pillow."""

import json
import os
import pathlib
import subprocess

import numpy as np
from PIL import Image, ImageDraw, ImageFont

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLBC = os.environ.get("FLBC", ROOT / "build" / "release" / "flbc")
MESHES = ROOT / "meshes"
INK = (33, 38, 48)
GRAY = (106, 113, 125)
FONTS = pathlib.Path("/usr/share/fonts/truetype/lato")


def flbc(*words):
    """Runs the program; returns its standard output."""
    return subprocess.run([str(word) for word in (FLBC, *words)], check=True, capture_output=True,
                          text=True).stdout


def check(*words):
    """The findings of flbc check. Its status says only whether weights have defects."""
    command = [str(word) for word in (FLBC, "check", *words, "--json", "-")]
    return json.loads(subprocess.run(command, capture_output=True, text=True).stdout)


def font(size, weight="Regular"):
    return ImageFont.truetype(str(FONTS / f"Lato-{weight}.ttf"), size)


def write(draw, place, text, size, color=INK, weight="Regular", anchor="mm"):
    draw.text(place, text, font=font(size, weight), fill=color, anchor=anchor)


def read_obj(path):
    """Points and polygons."""
    points, polygons = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            polygons.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return np.array(points), polygons


def write_moved(source, points, path):
    """The OBJ file with other points."""
    rows = iter(points)
    lines = ["v " + " ".join(f"{x:.17g}" for x in next(rows)) if line.startswith("v ") else line
             for line in pathlib.Path(source).read_text().splitlines()]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def save(picture, path, colors=None):
    """As PNG, of so many colors."""
    picture = picture.convert("RGB")
    if colors:
        picture = picture.quantize(colors, dither=Image.Dither.NONE)
    picture.save(path, optimize=True)


def page(width, height):
    picture = Image.new("RGB", (width, height), "white")
    return picture, ImageDraw.Draw(picture)
