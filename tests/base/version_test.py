#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that CMake does not write have the version of cmake/version.cmake."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
version = re.search(r"FLBC_VERSION (\S+)\)", (ROOT / "cmake/version.cmake").read_text())[1]
for path, pattern in (("CITATION.cff", r"^version: (\S+)$"), ("README.md", r"\[!\[Version (\S+?)\]"),
                      ("docs/images/version.svg", r"<title>Version (\S+?)</title>"),
                      ("docs/images/version.svg", r">(\d\S+?)</text>")):
    found = re.findall(pattern, (ROOT / path).read_text(), re.M)
    assert found == [version], f"{path}: {found} instead of {version}"
