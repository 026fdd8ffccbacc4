# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts of pictures share: the program, the sample models, text, and the version in a picture."""
import contextlib
import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np
from PIL import Image, ImageDraw, ImageFont, PngImagePlugin

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES, MESHES = ROOT / "docs/images", ROOT / "meshes"
FLBC = os.environ.get("FLBC", str(ROOT / "build/release/flbc"))
GRAY = (117, 123, 132)  # readable on white and on black


def flbc(*words):
    """Runs the program. Returns its standard output."""
    return subprocess.run([FLBC, *map(str, words)], check=True, capture_output=True, text=True).stdout


@contextlib.contextmanager
def working_folder():
    with tempfile.TemporaryDirectory() as name:
        yield pathlib.Path(name)


def read_obj(path):
    """Points, with colors if the file has them, and polygons."""
    lines = [line.split() for line in pathlib.Path(path).read_text().splitlines()]
    return (np.array([words[1:] for words in lines if words[:1] == ["v"]], float),
            [[int(word.split("/")[0]) - 1 for word in words[1:]] for words in lines if words[:1] == ["f"]])


def write_moved(source, points, path):
    """Writes the OBJ file with other points."""
    rows = iter(points)
    pathlib.Path(path).write_text("".join(
        "v " + " ".join(f"{x:.17g}" for x in next(rows)) + "\n" if line.startswith("v ") else line
        for line in pathlib.Path(source).read_text().splitlines(True)))


def findings(*words):
    """What flbc check finds. Its exit status says only whether weights have defects."""
    command = [FLBC, "check", *map(str, words), "--json", "-"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)


def page(width, height, color="white"):
    """A picture, and what draws on it."""
    picture = Image.new("RGBA", (width, height), color)
    return picture, ImageDraw.Draw(picture)


def write(draw, place, text, size=24, weight="Regular", anchor="mm", color=GRAY):
    font = ImageFont.truetype(f"/usr/share/fonts/truetype/lato/Lato-{weight}.ttf", size)
    draw.text(place, text, font=font, fill=color, anchor=anchor)


def save(picture, name, colors=96):
    """Saves a picture of at most this many colors in docs/images, with the version of the program."""
    info = PngImagePlugin.PngInfo()
    info.add_text("Software", flbc("--version").split("\n")[0])
    method = Image.Quantize.FASTOCTREE if picture.mode == "RGBA" else Image.Quantize.MEDIANCUT
    picture.quantize(colors, method=method, dither=Image.Dither.NONE).save(IMAGES / name, optimize=True, pnginfo=info)
