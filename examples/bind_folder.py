# SPDX-License-Identifier: BSD-3-Clause
"""Binds every model of a folder to a cage around it, on all machines of a Dask cluster.

bind_folder.py FOLDER [SCHEDULER]   SCHEDULER such as tcp://farm:8786; default: two local processes
"""
import pathlib
import sys

import flbc
from dask.distributed import Client, as_completed


def bind(path):
    vertices, faces = flbc.read_model(path)
    cage = flbc.make_cage(vertices, faces)
    flbc.bind(vertices, faces, cage, threads=1).save(path.with_suffix(".npz"))
    return f"{len(cage)} control points"


if __name__ == "__main__":
    local = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with Client(*sys.argv[2:3]) if sys.argv[2:] else Client(**local) as client:
        jobs = {client.submit(bind, path): path for path in pathlib.Path(sys.argv[1]).glob("*.obj")}
        for job in as_completed(jobs):
            print(f"{jobs[job].name}: {job.exception() or job.result()}")
