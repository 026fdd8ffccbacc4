# SPDX-License-Identifier: BSD-3-Clause
"""Drawings and pictures follow the cage, as those of the program do."""
import shutil
import subprocess
import sys

import flbc
import numpy as np
import pytest
from conftest import SOURCE

CORNERS = [[4, 4], [28, 4], [28, 12], [28, 20], [4, 20], [4, 12]]  # in a picture of 32 x 24
SVG = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 24" width="32" height="24">'
       '<path id="a" fill="#c50" d="M8 8H24V16L8 14z"/><text x="9" y="12">a</text></svg>')


@pytest.fixture(scope="module")
def binding():
    return flbc.bind(CORNERS, None, flbc.Cage(CORNERS), mesh_vertices=200)


def noise(kind, *channels):
    pixels = np.random.default_rng(1).integers(1, np.iinfo(kind).max, (24, 32, *channels), kind)
    pixels[:5] = pixels[-5:] = pixels[:, :5] = pixels[:, -5:] = 0
    return pixels


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
@pytest.mark.parametrize("channels", [(), (1,), (2,), (3,), (4,)])
def test_pictures_follow(binding, kind, channels):
    pixels = noise(kind, *channels)
    full = pixels.reshape(24, 32, -1)
    if full.shape[2] % 2:
        full = np.concatenate([full, np.full_like(full[..., :1], np.iinfo(kind).max)], axis=2)
    moved, offset = binding.deform_picture(pixels, binding.cage)
    assert moved.dtype == kind and offset == (0, 0)
    assert np.array_equal(moved * (full[..., -1:] > 0), full * (full[..., -1:] > 0))
    if len(channels) == 1 and channels[0] % 2 == 0:
        half = binding.cage.points / 2
        small, offset = binding.deform_picture(pixels[::1], half + [0, 12], scale=2)
        assert small.shape[:2] == (48, 64) and offset == (0, 0)
        seen = full[..., -1:] > 0
        assert np.array_equal(small[:24, :32] * seen, full * seen)


def test_size_is_in_units_of_the_cage(binding):
    pixels = noise(np.uint8, 4)
    large = np.kron(pixels, np.ones((3, 3, 1), np.uint8))
    moved, offset = binding.deform_picture(large, binding.cage.points + [-9, 1], size=(32, 24))
    assert offset == (-12, 0)  # 27 pixels to the left, of which 15 are empty
    assert np.array_equal(moved[:69, :69], large[3:, 15:84])


def test_drawings_follow(binding, program, tmp_path):
    with pytest.warns(UserWarning, match="text"):
        moved = binding.deform_drawing(SVG, binding.cage.points * 2)
    drawing, pose = tmp_path / "drawing.svg", tmp_path / "pose.obj"
    drawing.write_text(SVG)
    binding.save(tmp_path / "binding.npz")
    flbc.write_cage(pose, flbc.Cage(binding.cage.points * 2, binding.cage.facets))
    program("deform", drawing, "--weights", tmp_path / "binding.npz", "--pose", pose, "-o",
            tmp_path / "moved.svg")
    assert moved == (tmp_path / "moved.svg").read_text() != SVG


def test_refusals(binding, limb):
    pose = binding.cage
    for wrong in (np.zeros((4, 4)), np.zeros((4, 4, 5), np.uint8), np.zeros((0, 4, 4), np.uint8), "a"):
        with pytest.raises(flbc.InputError, match="picture"):
            binding.deform_picture(wrong, pose)
    pixels = noise(np.uint8, 4)
    with pytest.raises(flbc.OptionError, match="scale"):
        binding.deform_picture(pixels, pose, scale=0)
    with pytest.raises(flbc.InputError, match="16384"):
        binding.deform_picture(pixels, pose.points * 1e5)
    bare = flbc.Binding(np.eye(6), binding.cage, CORNERS)
    with pytest.raises(flbc.InputError, match="domain mesh"):
        bare.deform_picture(pixels, pose)
    with pytest.raises(flbc.InputError):
        binding.deform_drawing("no drawing", pose)
    cage, vertices, _ = limb
    solid = flbc.Binding(np.zeros((len(vertices), len(cage.points))), cage, vertices)
    for deform, art in ((solid.deform_drawing, SVG), (solid.deform_picture, pixels)):
        with pytest.raises(flbc.InputError, match="2D"):
            deform(art, cage)


def test_examples(tmp_path):
    image = pytest.importorskip("PIL.Image")
    picture, pose = tmp_path / "picture.png", flbc.Cage(np.array(CORNERS) * [1, 2])
    image.fromarray(noise(np.uint8, 4)).save(picture)
    names = [tmp_path / name for name in ("cage.obj", "pose.obj", "moved.png", "drawing.svg", "moved.svg")]
    flbc.write_cage(names[0], flbc.Cage(CORNERS))
    flbc.write_cage(names[1], pose)
    examples = SOURCE / "examples"
    subprocess.run([sys.executable, examples / "bend_picture.py", picture, *names[:3]], check=True)
    assert image.open(names[2]).size == (32, 38)
    names[3].write_text(SVG)
    subprocess.run([sys.executable, "-W", "ignore", examples / "bend_drawing.py", *names[3:]], check=True)
    assert 'id="a"' in names[4].read_text() and names[4].read_text() != SVG
    assert shutil.which("rsvg-convert") is None or subprocess.run(["rsvg-convert", names[4]],
                                                                  stdout=subprocess.DEVNULL).returncode == 0
