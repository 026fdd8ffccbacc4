#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""charts.py FOLDER: the charts of error against time, from the results in docs/results."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks" / "paper"))
import curves  # noqa: E402
import results  # noqa: E402

CHARTS = {"figure5": (curves.convergence, "error_against_time"),
          "figure6": (curves.convergence, "error_against_time_large"),
          "race": (curves.bars, "seconds_to_error")}


def main(folder):
    for name, (draw, picture) in CHARTS.items():
        curves.saved(draw(*results.read(ROOT / "docs" / "results", name)), folder / f"{picture}.png")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
