#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""charts.py FOLDER: the charts of error against time, from the results in docs/results."""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks" / "paper"))
import curves  # noqa: E402
import results  # noqa: E402

CHARTS = {"figure5": (curves.convergence, "error_against_time"),
          "figure6": (curves.convergence, "error_against_time_large"),
          "race": (curves.bars, "seconds_to_error")}


def main(folder):
    curves.style(plt)
    for name, (draw, picture) in CHARTS.items():
        rows, comments = results.read(ROOT / "docs" / "results", name)
        draw(plt, rows, comments, folder / f"{picture}.png")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
