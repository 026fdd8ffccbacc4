# SPDX-License-Identifier: BSD-3-Clause
"""A file of addon_test.py deforms without the add-on:
  blender ... --python without_addon.py -- WORK
"""
import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import scene  # noqa: E402

work, = scene.arguments()
bpy.ops.wm.open_mainfile(filepath=f'{work}/bound.blend')
assert not hasattr(bpy.types.Scene, 'flbc'), 'the add-on is enabled'
expected = np.load(f'{work}/bound.npy')
model = bpy.data.objects['limb_model']
error = np.abs(scene.shown(model) - expected).max() / scene.size(expected)
moves = np.abs(scene.base(model) - expected).max() / scene.size(expected)
assert error < 1e-6 < moves, (error, moves)
print(f'without the add-on: {error:.2g} of the size away')
