#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes tables.md and the figures from the CSV files of flbc_bench_paper.

    plots.py OUT_FOLDER
"""

import pathlib
import sys

import tables


def write_tables(out):
    """All tables of the pages of which there are results."""
    found = [name for name in tables.TABLES if (out / f"{tables.source_of(name)}.csv").exists()]
    path = out / "tables.md"
    path.write_text("\n".join(f"## {name}\n\n{tables.markdown(out, name)}" for name in found))
    return path


def main(out):
    print(write_tables(out))
    try:
        import curves
    except ImportError:
        sys.exit("plots.py: no pictures without matplotlib: install the Debian package python3-matplotlib "
                 f"and run again; the numbers are in {out}")
    for path in curves.draw_all(out, out):
        print(path)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    main(pathlib.Path(sys.argv[1]).resolve())
