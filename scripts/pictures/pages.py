#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/images/view.png of a page of flbc run, browser.png and protect.png of web/dist/flbc.html, which
scripts/web.sh makes, or of the page that is named. Needs Chromium, and npm ci in tests/browser.
"""
import pathlib
import subprocess
import sys

from common import MESHES, ROOT, Image, flbc, save, working_folder

PAGE = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "web/dist/flbc.html").resolve()

with working_folder() as work:
    flbc("run", MESHES / "3d/limb_model.obj", "--auto-cage", "-q", "-o", work / "limb")
    subprocess.run(["node", pathlib.Path(__file__).with_name("pages.mjs"), work / "limb/model.html", PAGE, work], check=True)
    for name in ("view", "browser", "protect"):
        save(Image.open(work / f"{name}.png").convert("RGB"), f"{name}.png", 128)
