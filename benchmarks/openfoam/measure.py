# SPDX-License-Identifier: BSD-3-Clause
"""Points per second and memory per rank of cageDeformMesh, and a picture of a morphed mesh.

    measure.py FLBC LIBRARY UTILITY WORK 240x120x120 1 2     a table of runs with 1 and 2 ranks
    measure.py FLBC LIBRARY UTILITY WORK --picture FILE.png  needs Matplotlib

WORK is a new folder.
"""

import pathlib
import re
import shutil
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "tests/openfoam"))
import channel

RUNS = 3


def deform(case, ranks, utility, pose):
    return case.run_ranks(ranks, "/usr/bin/time", "-f", "rss %M", utility, "-cage", "cage.obj",
                          "-domain", "domain.mesh", "-weights", "weights.npy", "-pose", pose)


def forget(case, ranks):
    for folder in [""] + ["processor%d" % rank for rank in range(ranks)]:
        shutil.rmtree(case.path(folder, "0.25"), ignore_errors=True)


def measure(case, utility, ranks):
    case.decompose(ranks)
    placing, moving, memory = [], [], []
    for _ in range(RUNS):
        output = deform(case, ranks, utility, "pose.obj")
        count, seconds = re.search(r"cage: (\d+) points .* placed in (\S+) s", output).groups()
        placing.append(float(seconds))
        moving.append(float(re.search(r"points moved in (\S+) s", output).group(1)))
        memory += [int(kilobytes) / 1024 for kilobytes in re.findall(r"rss (\d+)", output)]
        forget(case, ranks)
    print("| %d | %s | %.3f | %.3f | %.1f | %.0f |" % (
        ranks, count, min(placing), min(moving),
        1e-6 * int(count) / (min(placing) + min(moving)) / ranks, max(memory)), flush=True)


def picture(case, utility, file):
    from matplotlib import pyplot
    from matplotlib.collections import PolyCollection

    ranks = 4
    rest = case.points("constant")
    case.decompose(ranks)
    channel.write_cage(case.path("pose.obj"), channel.control_points(0.35))
    deform(case, ranks, utility, "pose.obj")
    moved = case.points_of_ranks(ranks, "0.25")
    x, y = channel.CELLS[0] + 1, channel.CELLS[1] + 1
    middle = channel.CELLS[2] // 2
    number = np.arange(len(rest)).reshape(-1, y, x)[middle]
    quads = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1)
    quads = quads.reshape(-1, 4)
    center = rest[quads].mean(axis=1)
    rank = (center[:, 0] > 2) + 2 * (center[:, 1] > 0.5)
    colors = np.array(["#dbe9f6", "#fde3c8", "#dff0d8", "#eadcf1"])[rank]
    figure, axes = pyplot.subplots(2, 1, figsize=(9, 5.4), sharex=True)
    outline = [0, 1, 2, 3, 4, 9, 8, 7, 6, 5, 0]
    titles = ("At rest: the colors are four ranks", "Morphed: only points inside the cage move")
    for axis, points, cage, title in zip(
            axes, (rest, moved), (channel.control_points(), channel.control_points(0.35)), titles):
        axis.add_collection(PolyCollection(points[quads][:, :, :2], facecolors=colors,
                                           edgecolors="#555555", linewidths=0.4))
        axis.plot(*cage[outline, :2].T, "o-", color="#c0392b", markersize=4, linewidth=1.2)
        axis.set(title=title, xlim=(-0.05, 4.05), ylim=(-0.28, 1.05), aspect="equal")
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def main():
    flbc, library, utility, work = sys.argv[1:5]
    if sys.argv[5] == "--picture":
        channel.CELLS = (80, 20, 4)
        return picture(channel.Case(work, flbc, library), utility, sys.argv[6])
    channel.CELLS = tuple(map(int, sys.argv[5].split("x")))
    case = channel.Case(work, flbc, library)
    print("| Ranks | Points inside | Placed, s | Moved, s | Million points/s and rank | MiB per rank |")
    print("|---:|---:|---:|---:|---:|---:|")
    for ranks in map(int, sys.argv[6:]):
        measure(case, utility, ranks)
    return None


if __name__ == "__main__":
    main()
