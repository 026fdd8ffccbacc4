#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes tables.md and the figures from the CSV files of flbc_bench_paper.

    plots.py MODELS_FOLDER OUT_FOLDER FLBC_PROGRAM
"""

import pathlib
import subprocess
import sys

import tables


def write_tables(out):
    """All tables of the pages of which there are results."""
    found = [name for name in tables.TABLES if (out / f"{tables.source_of(name)}.csv").exists()]
    path = out / "tables.md"
    path.write_text("\n".join(f"## {name}\n\n{tables.markdown(out, name)}" for name in found))
    return path


def main(models, out, flbc):
    print(write_tables(out))
    try:
        import curves
        import pictures
    except ImportError:
        sys.exit("plots.py: no pictures without matplotlib: install the Debian package python3-matplotlib "
                 f"and run again; the numbers are in {out}")
    try:
        for path in [*curves.draw_all(out, out), *pictures.draw_all(models, out, flbc)]:
            print(path)
    except subprocess.CalledProcessError as error:
        sys.exit(f"plots.py: {' '.join(error.cmd)} failed")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__.strip())
    main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:]))
