#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/images/openfoam.png: the near side of the channel of the tests at rest, and morphed on four ranks."""
import sys

import numpy as np
from common import FLBC, ROOT, page, save, working_folder, write

sys.path.insert(0, str(ROOT / "tests/openfoam"))
import channel  # noqa: E402

SCALE, LEFT, RANKS = 210, 75, 4
COLORS = [(86, 140, 206), (226, 149, 72), (98, 172, 104), (160, 116, 190)]
INK = (33, 38, 48)


def main():
    with working_folder() as work:
        case = channel.Case(str(work / "channel"), FLBC, str(ROOT / "build/release/openfoam/libcageMotion.so"))
        case.decompose(RANKS)
        case.run_ranks(RANKS, "moveDynamicMesh")
        meshes = [(case.points("constant"), channel.control_points(), "At rest: the colors are four ranks"),
                  (case.points_of_ranks(RANKS, "1"), channel.control_points(0.2), "Morphed: only points inside the cage move")]
        ranks = [set(np.frombuffer(case.binary(np.int32, 4, f"processor{rank}", "constant", "polyMesh",
                                               "pointProcAddressing"), np.int32)) for rank in range(RANKS)]
    picture, draw = page(990, 660)
    columns, rows = channel.CELLS[:2]
    for top, (points, cage, title) in zip((0, 330), meshes):
        at = [(round(LEFT + SCALE * x), round(top + 265 - SCALE * y)) for x, y, _ in np.concatenate([points, cage])]
        write(draw, (495, top + 26), title, 24, color=INK)
        for j in range(rows):
            for i in range(columns):
                corner = i + (columns + 1) * j
                cell = [corner, corner + 1, corner + columns + 2, corner + columns + 1]
                color = next(color for color, mine in zip(COLORS, ranks) if mine.issuperset(cell))
                draw.polygon([at[v] for v in cell], fill=(*(255 - (255 - np.array(color)) // 3),), outline=color)
        n = len(channel.X)
        loop = [at[len(points) + k] for k in (*range(n), *range(2 * n - 1, n - 1, -1), 0)]
        draw.line(loop, fill=INK, width=3)
        for x, y in loop:
            draw.ellipse((x - 5, y - 5, x + 5, y + 5), fill=INK)
    save(picture.convert("RGB"), "openfoam.png")


if __name__ == "__main__":
    main()
