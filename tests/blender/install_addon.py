# SPDX-License-Identifier: BSD-3-Clause
"""Installs the zip as a user does: blender ... --python install_addon.py -- ZIP VERSION"""
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
import scene  # noqa: E402

path, version = scene.arguments()
bpy.ops.preferences.addon_install(filepath=path)
bpy.ops.preferences.addon_enable(module=scene.ADDON)
addon = sys.modules[scene.ADDON]
manifest = (Path(addon.__file__).parent / 'blender_manifest.toml').read_text()
for found in ('.'.join(map(str, addon.bl_info['version'])),
              manifest.split('\nversion = "')[1].split('"')[0]):
    if found.removesuffix('-dev') != version:
        sys.exit(f'the add-on has version {found}, libflbc {version}')
