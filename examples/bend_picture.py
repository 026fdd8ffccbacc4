# SPDX-License-Identifier: BSD-3-Clause
"""Bends a picture by a cage and its pose, in pixels with the y axis up: bend_picture.py PICTURE CAGE POSE OUTPUT.png"""
import sys

import flbc
import numpy as np
from PIL import Image

if __name__ == "__main__":
    picture = np.asarray(Image.open(sys.argv[1]).convert("RGBA"))
    cage, pose = flbc.read_cage(sys.argv[2]), flbc.read_cage(sys.argv[3])
    binding = flbc.bind(cage.points, None, cage, mesh_vertices=3000)
    moved, (right, down) = binding.deform_picture(picture, pose)
    Image.fromarray(moved).save(sys.argv[4])
    print(f"offset {right} {down}")
