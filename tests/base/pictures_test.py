#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the docs are of this version of the program, and charts of the stored results: pictures_test.py VERSION"""

import pathlib
import re
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
LIMIT = 300_000  # bytes


def origin(name, content):
    """What the metadata says: the version of flbc that a picture is of, or the check sums of the results of a chart."""
    texts = dict.fromkeys(("Software", "Source"), "")
    if name.endswith(".svg"):
        texts["Software"] = re.search(r"<desc>(.*?)</desc>", content.decode()).group(1)
    at = 8
    while name.endswith(".png") and at < len(content):
        (length,), kind = struct.unpack(">I", content[at:at + 4]), content[at + 4:at + 8]
        if kind == b"tEXt":
            key, text = content[at + 8:at + 8 + length].decode("latin-1").split("\0")
            texts[key] = text
        at += 12 + length
    version = re.match(r"flbc (\d+\.\d+)", texts["Software"])
    return version.group(1) if version else texts["Source"]


def stale(pictures, version, sums):
    """Names of pictures of another minor version, and of charts of other results."""
    minor = ".".join(version.split(".")[:2])
    return [name for name, made_of in pictures.items() if made_of != minor and not
            (made_of and set(made_of.split()) <= sums)]


def main(version):
    contents = {path.name: path.read_bytes() for path in IMAGES.iterdir()}
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    shown = set(re.findall(r"images/([\w.]+)", "".join(page.read_text() for page in pages)))
    assert set(contents) == shown, f"on no page, or missing: {set(contents) ^ shown}"
    large = [name for name, content in contents.items() if len(content) > LIMIT]
    assert not large, f"more than {LIMIT} bytes: {large}"
    scripts = "".join(path.read_text() for path in (*(ROOT / "scripts" / "pictures").iterdir(),
                                                    ROOT / "benchmarks" / "paper" / "plots.py") if path.is_file())
    unmade = [name for name in contents if not re.search(rf"\b{pathlib.Path(name).stem}\b", scripts)]
    assert not unmade, f"no script makes {unmade}"

    sums = {line.split()[0] for line in (ROOT / "docs" / "results" / "SHA256SUMS").read_text().splitlines()}
    pictures = {name: origin(name, content) for name, content in contents.items()}
    found = stale(pictures, version, sums)
    assert not found, f"of another version, or of other results: {found}; docs/contributing/index.md says how to make them"
    charts = {"seconds_to_error.png", "error_against_time.png"}
    assert set(stale(pictures, "9.9.0", sums)) == set(pictures) - charts, "an older version is not found"
    assert set(stale(pictures, version, set())) == charts, "other results are not found"
    assert stale({"none.png": ""}, version, sums), "a picture without metadata is not found"


if __name__ == "__main__":
    main(sys.argv[1])
