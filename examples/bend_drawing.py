# SPDX-License-Identifier: BSD-3-Clause
"""Turns the upper half of a drawing: bend_drawing.py DRAWING.svg OUTPUT.svg"""
import pathlib
import sys

import flbc
import numpy as np

if __name__ == "__main__":
    points, edges = flbc.read_model(sys.argv[1])  # the outline
    cage = flbc.make_cage(points, edges)
    binding = flbc.bind(points, edges, cage, mesh_vertices=3000)
    center = cage.points.mean(axis=0)
    turn = np.array([[0.9, -0.4], [0.4, 0.9]])
    is_upper = cage.points[:, 1:] > center[1]
    pose = np.where(is_upper, (cage.points - center) @ turn.T + center, cage.points)
    moved = binding.deform_drawing(pathlib.Path(sys.argv[1]).read_text(), pose)
    pathlib.Path(sys.argv[2]).write_text(moved)
