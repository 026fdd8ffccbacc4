# SPDX-License-Identifier: BSD-3-Clause
"""Drawings that flbc deform moves, judged by librsvg: drawing_test.py PROGRAM

At rest the picture of a document is that of before. A cage that is moved as a whole moves it as a
transform of its root does. The page of flbc run shows the drawing.
"""
import base64
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
    from matplotlib.image import imread
except ImportError:
    sys.exit(77)
if not shutil.which("rsvg-convert"):
    print("skipped: rsvg-convert is missing (Debian: librsvg2-bin)")
    sys.exit(77)

PROGRAM = sys.argv[1]
CORNERS = [(5, 5), (60, 5), (115, 5), (115, 60), (115, 115), (60, 115), (5, 115), (5, 60)]

SHAPES = {
    "path": '<path {} d="M30 30C50 10 70 50 90 30S95 80 60 90 10 60 30 30z"/>',
    "arcs": '<path {} d="M30 50a20 12 30 1 0 50 5q5 30-20 35t-25-10H30V50z"/>',
    "rect": '<rect {} x="25" y="30" width="60" height="45"/>',
    "round": '<rect {} x="25" y="30" width="60" height="45" rx="12" ry="8"/>',
    "circle": '<circle {} cx="50%" cy="60" r="30"/>',
    "ellipse": '<ellipse {} cx="60" cy="60" rx="8mm" ry="20"/>',
    "line": '<line {} x1="30" y1="40" x2="80" y2="85" stroke="#036" stroke-width="6"/>',
    "polyline": '<polyline {} points="30,40 80,35 75,80 50,60"/>',
    "polygon": '<polygon {} points="30,40 80,35 75,80 50,60"/>',
}
WRAPPERS = {
    "plain": '<g fill="#c50">{}</g>',
    "style": '<g style="fill:#26c; stroke: #000; stroke-width:3">{}</g>',
    "turned": '<g fill="#383" transform="translate(8 -6) rotate(10 60 60) scale(.9 1.05)">{}</g>',
    "matrix": '<g fill="#838" transform="matrix(.9 .1 -.1 1 10 -2)"><g transform="skewX(5)">{}</g></g>',
    "nested": '<svg x="10" y="5" width="100" height="110" viewBox="0 0 120 120">{}</svg>',
    "use": '<defs><g id="u" fill="#a33">{}</g></defs><use href="#u" x="3" y="-2"/>',
    "twice": '<defs><g id="u" fill="#a33">{}</g></defs><use href="#u" transform="scale(.5)" x="20" y="20"/>'
             '<use href="#u" transform="translate(45 40) scale(.5)"/>',
    "clip": '<clipPath id="k"><circle cx="60" cy="55" r="28"/></clipPath><g clip-path="url(#k)">{}</g>',
    "mask": '<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="120" height="120">'
            '<rect x="40" y="20" width="40" height="80" fill="#fff"/></mask><g mask="url(#m)">{}</g>',
    "gradient": '<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="30" y1="30" x2="90" y2="80">'
                '<stop offset="0" stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
                '<g fill="url(#g)">{}</g>',
    "opacity": '<a><switch><g opacity=".5" fill-rule="evenodd" stroke="#000" stroke-linejoin="round">{}</g></switch></a>',
}


def cage(path, move):
    lines = ["v {:.12g} {:.12g} 0".format(*move(x, 120 - y)) for x, y in CORNERS]
    path.write_text("\n".join(lines + ["l 1 2 3 4 5 6 7 8 1", ""]))


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stderr=subprocess.PIPE)


def picture(path):
    image = path.with_suffix(".png")
    run("rsvg-convert", "-w", "240", path, "-o", image)
    return imread(image)


def differ(one, other, most=8):
    """The share of pixels that differ by more than 8 of 255, or another number."""
    return np.mean(np.abs(one - other).max(axis=-1) > most / 255)


def numbers(text):
    return np.frombuffer(base64.b64decode(text), np.float32).reshape(-1, 2)


def check_page(folder, document, content, rest):
    """The picture covers the mesh, which fills the cage."""
    path = folder / "my drawing.svg"
    path.write_text(document.format(content))
    run(PROGRAM, "run", rest, path, "--vertices", 300, "-q", "-o", folder / "page")
    page = (folder / "page/model.html").read_text()
    shown = json.loads(re.search('<script[^>]*id="content">(.*?)</script>', page, re.S).group(1))
    assert shown["title"] == "my drawing"
    corners = np.array(CORNERS)
    low, size = corners.min(0), np.ptp(corners, 0)
    at = shown["surface"]["textureCoordinates"], shown["points"]["offsets"]
    places, points = numbers(at[0]), numbers(at[1]) + shown["points"]["center"]
    assert np.allclose(places, ((points - (low[0], 120 - low[1] - size[1])) / size - (0, 1)) * (1, -1), atol=1e-5)
    picture_file, part = folder / "picture.svg", folder / "part.svg"
    picture_file.write_bytes(base64.b64decode(shown["picture"].split(",")[1]))
    part.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{low[0]} {low[1]} {size[0]} {size[1]}">'
                    f'<svg width="120" height="120" viewBox="0 0 120 120">{content}</svg></svg>')
    shares = [differ(picture(picture_file), picture(part), 64), differ(picture(path), picture(part), 64)]
    assert shares[0] < 0.001 < 0.01 < shares[1], shares


def main():
    folder = Path(tempfile.mkdtemp())
    rest, moved = folder / "rest.obj", folder / "moved.obj"
    cage(rest, lambda x, y: (x, y))
    angle = math.radians(12)
    # In the file the y axis points down, so that it turns the other way.
    cage(moved, lambda x, y: (60 + math.cos(angle) * (x - 60) + math.sin(angle) * (y - 60) + 4,
                              60 - math.sin(angle) * (x - 60) + math.cos(angle) * (y - 60) + 3))
    root = "translate(4 -3) rotate(12 60 60)"
    run(PROGRAM, "run", rest, "--vertices", 300, "-q", "-o", folder / "out")
    count = 0
    for kind, wrapper in WRAPPERS.items():
        for name, shape in SHAPES.items():
            document = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 120 120">{}</svg>'
            content = wrapper.format(shape.format('id="shape"'))
            path = folder / "drawing.svg"
            path.write_text(document.format(content))
            turned = folder / "turned.svg"
            turned.write_text(document.format(f'<g transform="{root}">{content}</g>'))
            for pose, expected in ((rest, path), (moved, turned)):
                result = folder / "result.svg"
                run(PROGRAM, "deform", path, "--weights", folder / "out/binding.npz", "--pose", pose,
                    "-q", "-o", result)
                share = differ(picture(result), picture(expected))
                assert share < 0.01, f"{name} in {kind}, {pose.stem}: {share:.1%} differ; {folder}"
            count += 1
    check_page(folder, document, content, rest)
    shutil.rmtree(folder)
    print(f"{count} drawings are as they should be")


main()
