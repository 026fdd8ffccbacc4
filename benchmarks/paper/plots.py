#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes tables.md and the figures from the CSV files of flbc_bench_paper.

    plots.py MODELS_FOLDER OUT_FOLDER FLBC_PROGRAM
"""

import pathlib
import subprocess
import sys

import tables


def main(models, out, flbc):
    written = [tables.write(out)]
    try:
        import matplotlib
    except ImportError:
        report(written)
        print(f"plots.py: no pictures without matplotlib: install the Debian package "
              f"python3-matplotlib and run again; the numbers are in {out}", file=sys.stderr)
        return 1
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    import curves
    import pictures

    curves.style(plt)
    written += curves.draw_all(plt, out)
    try:
        written += pictures.draw_all(plt, models, out, flbc)
    except subprocess.CalledProcessError as error:
        report(written)
        print(f"plots.py: {' '.join(error.cmd)} failed", file=sys.stderr)
        return 1
    report(written)
    return 0


def report(written):
    for path in written:
        if path:
            print(path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.strip())
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:])))
