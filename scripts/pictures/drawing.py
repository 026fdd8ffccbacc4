#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: scripts/pictures/drawing.py [FLBC]
Makes docs/images/drawing.svg: the sample drawing, its cage, and the drawing in the pose of the cage.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "meshes/drawings"
WIDTH, HEIGHT, GAP = 400, 300, 20


def content_of(drawing: str, prefix: str) -> str:
    """What is in a drawing, with other ids."""
    inside = re.search(r"<svg[^>]*>(.*)</svg>", drawing, re.DOTALL).group(1)
    inside = re.sub(r"<title>.*?</title>", "", inside)
    return inside.replace('id="', f'id="{prefix}').replace("url(#", f"url(#{prefix}")


def outline_of(cage: pathlib.Path) -> str:
    words = [line.split() for line in cage.read_text().splitlines()]
    points = [f"{float(x):g},{HEIGHT - float(y):g}" for key, x, y, _ in (w for w in words if w[0] == "v")]
    lines = "".join(f'<polyline points="{" ".join(points[int(v) - 1] for v in loop)}"/>'
                    for _, *loop in (w for w in words if w[0] == "l"))
    dots = "".join('<circle cx="{}" cy="{}" r="4" fill="#2563eb"/>'.format(*point.split(",")) for point in points)
    return f'<g fill="none" stroke="#2563eb" stroke-width="2">{lines}</g>{dots}'


def main() -> None:
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/flbc"
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split("\n")[0]
    cage, pose = SAMPLES / "cat_cage.obj", SAMPLES / "cat_cage_pose.obj"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", cage, SAMPLES / "cat.svg", "--pose", pose, "-q", "-o", folder], check=True)
        bent = (pathlib.Path(folder) / "deformed.svg").read_text()
    drawing = (SAMPLES / "cat.svg").read_text()
    panels = [content_of(drawing, "a-"), content_of(drawing, "b-") + outline_of(cage),
              content_of(bent, "c-") + outline_of(pose)]
    step = WIDTH + GAP
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -8 {3 * step - GAP} {HEIGHT + 8}">\n<desc>{version}</desc>\n'
    for k, panel in enumerate(panels):
        text += f'<g transform="translate({k * step})">{panel}</g>\n'
    (ROOT / "docs/images/drawing.svg").write_text(text + "</svg>\n")


if __name__ == "__main__":
    main()
