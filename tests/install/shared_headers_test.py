# SPDX-License-Identifier: BSD-3-Clause
"""Shared libraries export the names of internal headers that other libraries and programs include:
shared_headers_test.py REPOSITORY. Only packages are built with shared libraries."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
IO = ROOT / "libflbc/io/src"
# A list of cmake/shared.cmake, and the folders of what those libraries compile.
LISTS = {"shared_inside": (ROOT / "libflbc/src", [ROOT / "libflbc/src"]),
         "shared_inside_io": (IO, [folder for folder in IO.iterdir() if folder.name != "gltf"])}

listing = (ROOT / "cmake/shared.cmake").read_text()
sources = [path for top in ("libflbc", "apps", "python/src", "openmesh_bindings", "openfoam")
           for path in sorted((ROOT / top).rglob("*")) if path.suffix in (".h", ".cpp", ".C")]
missing = []
for name, (base, folders) in LISTS.items():
    exported = re.search(rf"set\({name}\s([^)]*)\)", listing)[1].split()
    for path in sources:
        if any(folder in path.parents for folder in folders):
            continue
        for header in re.findall(r'#include "([\w/]+)\.h"', path.read_text(encoding="utf-8")):
            file = base / f"{header}.cpp"
            if file.exists() and any(folder in file.parents for folder in folders) and header not in exported:
                missing.append(f"{path.relative_to(ROOT)} includes {header}.h, which is not in {name} of cmake/shared.cmake")
assert len(sources) > 300
print("\n".join(missing))
sys.exit(1 if missing else 0)
