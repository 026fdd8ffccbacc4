#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/images/hero.png: a character that bends, and one drag by harmonic and by local coordinates."""
import numpy as np
from common import MESHES, Image, flbc, page, read_obj, save, working_folder, write, write_moved

WIDTH, HEIGHT, TITLE, FINER = 520, 540, 96, 3
CAGE, HELD, MOVED, GHOST = (37, 99, 235), (214, 16, 28), np.array((240, 128, 24)), (150, 156, 166)
SKIN = np.array([(214, 190, 168), (188, 160, 136)])  # of the squares of the lizard
HEAD, DRAG, SHOWN = [0, 1, 2, 39], (3.2, 2.2), 0.02
LIGHT = np.array((-0.35, 0.55, 0.76))


def turn(points, which, center, degrees):
    """Rotates points about an axis that looks at you."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    points[which, :2] = center + (points[which, :2] - center) @ np.array([[cos, sin], [-sin, cos]])


def posed_character(rest):
    points = rest.copy()
    x, y = rest[:, 0], rest[:, 1]
    turn(points, x > 1.75, (1.75, 2.4), 50)
    turn(points, x > 1.1, (0.9, 2.5), 35)
    turn(points, x < -1.1, (-0.9, 2.5), 35)
    turn(points, x < -1.75, (-1.6, 2.0), -75)
    turn(points, y > 3.3, (0, 3.2), -16)
    turn(points, (x > 0.1) & (y < 0.6), (0.4, 0.9), 24)
    return points


def paint(panel, cage, facets, points, polygons, colors, held=(), ghost=None):
    """The triangles from back to front, then the cage, in the window of `panel`: center and pixels per unit."""
    center, scale = panel
    triangles = np.array([(p[0], b, c) for p in polygons for b, c in zip(p[1:], p[2:])])
    tint = np.array([color for p, color in zip(polygons, colors) for _ in p[2:]])
    place = lambda x: FINER * (np.array((WIDTH / 2, HEIGHT / 2)) + scale * (x[:, :2] - center) * (1, -1))  # noqa: E731
    picture, draw = page(FINER * WIDTH, FINER * HEIGHT, (0, 0, 0, 0))
    corners = points[triangles]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    smooth = np.zeros_like(points)
    for k in range(3):
        np.add.at(smooth, triangles[:, k], flat)
    normals = smooth[triangles].sum(1)
    shade = 0.55 + 0.45 * np.clip(normals @ LIGHT / np.linalg.norm(normals, axis=1), 0, 1)
    at = place(points)
    for k in np.argsort(corners[:, :, 2].mean(1)):
        if flat[k, 2] > 0:
            color = tuple((tint[k] * shade[k]).astype(int))
            draw.polygon([tuple(at[v]) for v in triangles[k]], fill=color, outline=color)
    if ghost is not None:
        edges = [tuple(edge) for p in polygons for edge in zip(p, p[1:] + p[:1])]
        before = place(ghost)
        for a, b in set(edges) - {(b, a) for a, b in edges}:
            draw.line((*before[a], *before[b]), fill=GHOST, width=FINER)
    knots = place(cage)
    for a, b in {tuple(sorted(edge)) for f in facets for edge in zip(f, f[1:] + f[:1])}:
        draw.line((*knots[a], *knots[b]), fill=CAGE, width=FINER)
    for k, (x, y) in enumerate(knots):
        r = FINER * (6 if k in held else 3)
        draw.ellipse((x - r, y - r, x + r, y + r), fill=HELD if k in held else CAGE)
    return picture.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)


def bent_character(work):
    model, cage = MESHES / "3d/character_model.obj", work / "cage.obj"
    flbc("cage", model, "-o", cage)
    flbc("solve", cage, "--model", model, "-q", "-o", work / "character.npz")
    corners, facets = read_obj(cage)
    corners = posed_character(corners)
    write_moved(cage, corners, work / "pose.obj")
    flbc("deform", model, "--weights", work / "character.npz", "--pose", work / "pose.obj", "-q", "-o", work / "bent.obj")
    points, polygons = read_obj(work / "bent.obj")
    colors = [255 * points[p, 3:6].mean(0) for p in polygons]
    return paint(((0, 2.55), 82), corners, facets, points[:, :3], polygons, colors)


def dragged_lizard(work, method):
    model, cage = (MESHES / f"2d/figure_{part}.obj" for part in ("model", "cage"))
    flbc("solve", cage, "--model", model, *method, "-q", "-o", work / "lizard.npz")
    corners = read_obj(cage)[0]
    corners[HEAD, :2] += DRAG
    write_moved(cage, corners, work / "pose.obj")
    flbc("deform", model, "--weights", work / "lizard.npz", "--pose", work / "pose.obj", "-q", "-o", work / "moved.obj")
    (rest, polygons), (points, _) = read_obj(model), read_obj(work / "moved.obj")
    share = np.linalg.norm(points - rest, axis=1) / np.linalg.norm(DRAG)
    squares = [int(np.floor(rest[p, :2].mean(0) / 0.5).sum()) % 2 for p in polygons]
    colors = [MOVED - 30 * dark if share[p].mean() > SHOWN else SKIN[dark] for p, dark in zip(polygons, squares)]
    loop = [list(range(len(corners)))]
    return paint(((1, 0.85), 40), corners, loop, points, polygons, colors, HEAD, rest), 100 * (share > SHOWN).mean()


def main():
    with working_folder() as work:
        far, far_share = dragged_lizard(work, ("--method", "harmonic"))
        near, near_share = dragged_lizard(work, ())
        panels = [("A character bends with its cage", "local coordinates", bent_character(work)),
                  ("Drag the head: harmonic", f"{far_share:.0f}% moves by over 2% of the drag", far),
                  ("Drag the head: local", f"{near_share:.0f}% moves by over 2% of the drag", near)]
    picture, draw = page(3 * WIDTH, TITLE + HEIGHT, (0, 0, 0, 0))
    for k, (title, text, panel) in enumerate(panels):
        picture.paste(panel, (k * WIDTH, TITLE))
        write(draw, ((k + 0.5) * WIDTH, 32), title, 30, "Bold")
        write(draw, ((k + 0.5) * WIDTH, 72), text, 26)
    save(picture, "hero.png", 256)


if __name__ == "__main__":
    main()
