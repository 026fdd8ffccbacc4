"""Joints at the end of a pipe (docs/how-to/engineers.md): slope of the displacement at the border,
largest slope, and the amplitudes of a shift and a compression that invert the first cell.

    PYTHONPATH=build/release/python /usr/bin/python3 benchmarks/joint.py
"""
import flbc
import numpy as np

CORNERS = 8
SHIFTS = np.array([0, 0.15, 0.4, 0.6, 0.75])  # of the rings; the first is at the border


def pipe(radius, heights):
    """A closed pipe with rings of corners at these heights."""
    turns = 2 * np.pi * np.arange(CORNERS) / CORNERS
    points = [[radius * np.cos(t), radius * np.sin(t), z] for z in heights for t in turns]
    last = CORNERS * (len(heights) - 1)
    faces = [list(range(CORNERS))[::-1], list(range(last, last + CORNERS))]
    for start in range(0, last, CORNERS):
        for k in range(CORNERS):
            a, b = start + k, start + (k + 1) % CORNERS
            faces.append([a, b, b + CORNERS, a + CORNERS])
    return flbc.Cage(np.array(points), faces)


def volumes(points, cells):
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)


def moves_of(cage, direction):
    return np.repeat(SHIFTS, CORNERS)[:, None] * direction


def first_inversion(binding, cells, direction):
    """The largest amplitude at which no cell is inverted, by bisection."""
    at_rest = np.sign(volumes(binding.points, cells))
    low, high = 0.0, 16.0
    for _ in range(24):
        middle = (low + high) / 2
        moved = binding.deform(binding.cage.points + middle * moves_of(binding.cage, direction))
        is_sound = (np.sign(volumes(moved, cells)) == at_rest).all()
        low, high = (middle, high) if is_sound else (low, middle)
    return low


def slopes(binding, joint):
    """For a shift, along lines through the border: at a distance of 0.002, and the largest."""
    line = np.concatenate([[-0.1], np.arange(0.002, 3.9, 0.004)])
    # Through all triangles of the end.
    turns = np.pi * np.arange(16) / 8 + 0.1
    starts = [(r * np.cos(t), r * np.sin(t)) for r in (0.2, 0.5, 0.8) for t in turns]
    points = np.array([[x, y, z] for x, y in starts for z in line])
    n = len(line)
    edges = [[s * n + k, s * n + k + 1] for s in range(len(starts)) for k in range(n - 1)]
    lines = binding.transferred(points, edges, outside="keep")
    if joint:
        lines = lines.joined(joint)
    moved = lines.deform(binding.cage.points + moves_of(binding.cage, [1, 0, 0]))
    u = (moved - points)[:, 0].reshape(-1, n)
    return u[:, 1].max() / 0.002, np.abs(np.diff(u[:, 1:], axis=1)).max() / 0.004


def main():
    mesh = flbc.mesh(pipe(0.9, [-1, 0, 1, 2, 3, 3.9]), vertices=8000)
    cells = mesh.cells
    faces = np.concatenate([cells[:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])])
    binding = flbc.bind(mesh.points, faces, pipe(1, range(5)), mesh_vertices=10000,
                        outside="keep", max_influences=0)
    print(f"{len(cells)} cells\n{'joint':>12} {'border':>8} {'largest':>8} {'shift':>7} {'compression':>12}")
    for joint in ("", "smooth", "smooth:1", "curvature"):
        joined = binding.joined(joint) if joint else binding
        border, largest = slopes(binding, joint)
        shift, compression = (first_inversion(joined, cells, d) for d in ([1, 0, 0], [0, 0, -1]))
        print(f"{joint or 'none':>12} {border:8.4f} {largest:8.3f} {shift:7.3f} {compression:12.3f}")


if __name__ == "__main__":
    main()
