# SPDX-License-Identifier: BSD-3-Clause
"""An airfoil in a cage of two rings (docs/how-to/engineers.md): smallest ratio of Jacobians, slope of the
displacement at the border, and distance of the wall from where it should be. RBF: thin plate splines.

    PYTHONPATH=build/release/python /usr/bin/python3 benchmarks/airfoil.py
"""
import flbc
import numpy as np
from scipy.interpolate import RBFInterpolator

AROUND, LAYERS = 100, 100
FIRST = 1e-5  # height of the cells at the wall, in chords
CENTER = np.array([0.5, 0.0])
RADIUS = 1.5
RING = 1.0    # of the control points that are fixed


def thickness(x):
    return 0.6 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)


def circle(radius, count):
    turns = 2 * np.pi * np.arange(count) / count
    return CENTER + radius * np.stack([np.cos(turns), np.sin(turns)], 1)


def section(turns, part=1):
    """NACA 0012 from the trailing edge around, a part of its thickness."""
    x = (1 + np.cos(turns)) / 2
    if part < 1:
        x = 0.02 + 0.95 * x
    return np.stack([x, np.sign(np.sin(turns)) * part * thickness(x)], 1)


def o_grid():
    """Rows of points around the airfoil, from the wall to a circle, and quads."""
    turns = 2 * np.pi * np.arange(AROUND) / AROUND
    wall = section(turns)
    far = circle(RADIUS, AROUND)
    low, high = 1.01, 2.0  # growth of the layers
    for _ in range(60):
        growth = (low + high) / 2
        height = FIRST * (growth**LAYERS - 1) / (growth - 1)
        low, high = (growth, high) if height < RADIUS else (low, growth)
    heights = (growth**np.arange(LAYERS + 1) - 1) / (growth**LAYERS - 1)
    points = wall + heights[:, None, None] * (far - wall)
    number = np.arange(points.size // 2).reshape(LAYERS + 1, AROUND)
    following = np.roll(number, -1, 1)
    quads = np.stack([number[:-1], number[1:], following[1:], following[:-1]], -1).reshape(-1, 4)
    return points.reshape(-1, 2), quads, number[0]


def cage():
    """A ring in the flow, which rests, and one in the body."""
    outer = circle(RING, 16)
    inner = section(2 * np.pi * np.arange(17) / 17 + 1e-9, 0.85)[::-1]
    edges = [[k, (k + 1) % 16] for k in range(16)] + [[16 + k, 16 + (k + 1) % 17] for k in range(17)]
    return flbc.Cage(np.concatenate([outer, inner]), edges)


def turned(points, degrees):
    c, s = np.cos(np.radians(-degrees)), np.sin(np.radians(-degrees))
    return (points - [0.25, 0]) @ np.array([[c, s], [-s, c]]) + [0.25, 0]


MOVES = {
    "pitch 10": lambda p: turned(p, 10),
    "pitch 20": lambda p: turned(p, 20),
    "up 0.2": lambda p: p + [0, 0.2],
    "up 0.3": lambda p: p + [0, 0.3],
    "camber 0.1": lambda p: p + np.stack([0 * p[:, 0], 0.4 * p[:, 0] * (1 - p[:, 0])], 1),
    "thicker": lambda p: p * [1, 2],
}


def slope_at_border(points, moved):
    distance = RING - np.linalg.norm(points - CENTER, axis=1)
    near = (distance > 0) & (distance < 0.06)
    return (np.linalg.norm(moved - points, axis=1)[near] / distance[near]).max()


def continued(points, wall, moves):
    """The displacement of the wall, continued by radial basis functions."""
    at = np.concatenate([points[wall], circle(RING, 32)])
    known = np.concatenate([moves, np.zeros((32, 2))])
    spread = RBFInterpolator(at, known, kernel="thin_plate_spline")(points)
    is_inside = np.linalg.norm(points - CENTER, axis=1) < RING
    return points + spread * is_inside[:, None]


def main():
    points, quads, wall = o_grid()
    rest = cage()
    binding = flbc.bind(points, quads, rest, mesh_vertices=8000, outside="keep", max_influences=0)
    print(f"{'':10} {'by':10} {'smallest':>8} {'inverted':>8} {'slope':>6} {'distance':>8}")
    for name, move in MOVES.items():
        pose = rest.points.copy()
        pose[16:] = move(pose[16:])
        results = {joint or "no joint": (binding.joined(joint) if joint else binding).deform(pose)
                   for joint in ("", "smooth", "smooth:1")}
        results["RBF"] = continued(points, wall, move(points[wall]) - points[wall])
        for by, moved in results.items():
            ratio = flbc.cell_quality(points, quads, moved)["jacobian"]
            distance = np.linalg.norm(moved[wall] - move(points[wall]), axis=1).max()
            print(f"{name:10} {by:10} {ratio.min():8.2f} {(ratio <= 0).sum():8d} "
                  f"{slope_at_border(points, moved):6.3f} {distance:8.3f}")


if __name__ == "__main__":
    main()
