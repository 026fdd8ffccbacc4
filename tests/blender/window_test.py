# SPDX-License-Identifier: BSD-3-Clause
"""The add-on in a window: binding in the background, refinement, undo, cancel, the panel.
  blender ... --python window_test.py -- PROGRAM MESHES DONE
Writes the file DONE at the end if all is well.
"""
import os
import sys
import time
import traceback
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import scene  # noqa: E402

PROGRAM, MESHES, DONE = scene.arguments()
SECONDS = 60  # for everything that is waited for


def require(condition, message):
    if not condition:
        raise AssertionError(message)


def until(condition, what):
    end = time.monotonic() + SECONDS
    while not condition():
        require(time.monotonic() < end, f'waited in vain until {what}')
        yield


def in_window(operator, *arguments):
    with bpy.context.temp_override(**scene.viewport()):
        return operator(*arguments)


def model():
    return bpy.data.objects['limb_model']


def steps():
    from local_barycentric_cage import operators, panel
    scene.load(f'{MESHES}/3d/limb_model.obj')
    settings = bpy.context.scene.flbc
    settings.cage = scene.load(f'{MESHES}/3d/limb_cage.obj')
    settings.quality = 'DRAFT'
    draws = []
    draw = panel.FLBC_PT_cage._draw_state
    panel.FLBC_PT_cage._draw_state = lambda self, item: (draw(self, item), draws.append(item.name))
    yield from scene.show_panel()
    scene.select(model())
    bpy.ops.ed.undo_push(message='before')
    yield
    # Bound at once, then refined.
    require(in_window(bpy.ops.flbc.bind, 'INVOKE_DEFAULT') == {'RUNNING_MODAL'}, 'not modal')
    require(operators.running and not model().modifiers, 'the operator has waited')
    require(not in_window(bpy.ops.flbc.bind.poll), 'a second job could start')
    yield from until(lambda: model().flbc.quality == 'DRAFT', 'there is a draft')
    draft = scene.influences(model())[1]
    yield from until(lambda: model().flbc.quality == 'GOOD', 'the draft is refined')
    yield from until(lambda: not operators.running, 'the operator ends')
    require(np.abs(draft - scene.influences(model())[1]).max() > 1e-6, 'nothing was refined')
    yield from until(lambda: draws, 'the panel shows the model')
    yield
    in_window(bpy.ops.ed.undo)
    require(model().flbc.quality == 'DRAFT', 'undo does not lead back to the draft')
    in_window(bpy.ops.ed.undo)
    require(not model().modifiers, 'undo does not lead back to the start')
    in_window(bpy.ops.ed.redo)
    in_window(bpy.ops.ed.redo)
    require(model().flbc.quality == 'GOOD', 'redo does not lead to the end')
    yield
    # Cancelled: the old binding remains.
    bpy.context.scene.flbc.quality = 'EXACT'
    in_window(bpy.ops.flbc.rebind, 'INVOKE_DEFAULT')
    yield
    require(operators.running, 'ended before it could be cancelled')
    in_window(bpy.ops.flbc.cancel)
    for _ in range(3):
        yield
    require(model().flbc.quality == 'GOOD' and not operators.running, 'not cancelled')
    # Changed meanwhile: refused, and another job can start.
    in_window(bpy.ops.flbc.rebind, 'INVOKE_DEFAULT')
    model().data.vertices[0].co.x += 0.01
    yield from until(lambda: not operators.running, 'the operator ends')
    require(model().flbc.quality == 'GOOD', 'a changed model was bound')


def advance(generator):
    try:
        next(generator)
        return 0.1
    except StopIteration:
        Path(DONE).touch()
    except Exception:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


scene.enable(PROGRAM)
generator = steps()
bpy.app.timers.register(lambda: advance(generator), first_interval=0.5)
