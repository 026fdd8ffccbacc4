# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that flbc deform and flbc run move: picture_test.py PROGRAM

Judged by arrays that move without a mesh, by a supersampled warp in NumPy, and by librsvg.
"""
import io
import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

try:
    import numpy as np
    from matplotlib.tri import Triangulation
    from PIL import Image, ImageOps
    from scipy.ndimage import binary_erosion
except ImportError:
    sys.exit(77)
import png_file

PROGRAM = sys.argv[1]
FOLDER = Path(tempfile.mkdtemp())
SIZE = 96
RANDOM = np.random.default_rng(1)


def flbc(*words, status=0):
    done = subprocess.run([PROGRAM, *map(str, words)], stderr=subprocess.PIPE, text=True)
    assert done.returncode == status, (words, done.returncode, done.stderr)
    return done.stderr


def cage(name, points):
    path = FOLDER / name
    lines = ["v {:.17g} {:.17g} 0".format(*point) for point in points]
    order = [*range(1, len(points) + 1), 1]
    path.write_text("\n".join([*lines, "l " + " ".join(map(str, order)), ""]))
    return path


def box(low, high, pieces=3):
    """Corners of a square, with points on its sides."""
    side = low + (high - low) * np.arange(pieces) / pieces
    other = high + low - side
    ends = np.full(pieces, low), np.full(pieces, high)
    return np.hstack([[side, ends[0]], [ends[1], side], [other, ends[1]], [ends[0], other]]).T


def bound(points, name="rest"):
    rest = cage(name + ".obj", points)
    flbc("run", rest, "--vertices", 600, "-q", "-o", FOLDER / name)
    return FOLDER / name / "binding.npz"


def deformed(picture, binding, pose, *options, output="result.png"):
    path = FOLDER / output
    text = flbc("deform", picture, "--weights", binding, "--pose", cage("pose.obj", pose), "-o", path,
                *options)
    pixels, chunks = png_file.read(path)
    return pixels, chunks, text


def offset_of(chunks):
    return struct.unpack(">iiB", chunks[b"oFFs"])[:2] if b"oFFs" in chunks else (0, 0)


def noise(kind, channels=4):
    """A random sprite with a transparent margin of 8 pixels."""
    pixels = RANDOM.integers(0, np.iinfo(kind).max, (SIZE, SIZE, channels), kind, endpoint=True)
    if channels % 2 == 0:
        for edge in (np.s_[:8], np.s_[-8:], np.s_[:, :8], np.s_[:, -8:]):
            pixels[edge] = 0
    return pixels


def premultiplied(pixels):
    """In [0, 1]."""
    pixels = pixels / np.iinfo(pixels.dtype).max
    return np.concatenate([pixels[..., :-1] * pixels[..., -1:], pixels[..., -1:]], axis=-1)


def placed(pixels, offset, low, high):
    """The part of a plane from `low` to before `high`, (x, y) each."""
    (left, top), (height, width) = offset, pixels.shape[:2]
    plane = np.zeros((high[1] - low[1], high[0] - low[0], pixels.shape[2]), pixels.dtype)
    x, y = max(low[0], left), max(low[1], top)
    ends = min(high[0], left + width), min(high[1], top + height)
    plane[y - low[1]:ends[1] - low[1], x - low[0]:ends[0] - low[0]] = pixels[
        y - top:ends[1] - top, x - left:ends[0] - left]
    return plane


def bilinear(image, x, y):
    """At places with the y axis down; nothing is outside."""
    image = np.pad(image, ((1, 1), (1, 1), (0, 0)))
    x, y = (np.clip(v + 0.5, 0, s - 1.001) for v, s in ((x, image.shape[1]), (y, image.shape[0])))
    i, j = x.astype(int), y.astype(int)
    s, t = (x - i)[..., None], (y - j)[..., None]
    upper = (1 - s) * image[j, i] + s * image[j, i + 1]
    return (1 - t) * upper + t * ((1 - s) * image[j + 1, i] + s * image[j + 1, i + 1])


def warped(image, binding, pose, low, high, samples=4):
    """Each of 16 samples of a pixel is found in the moved mesh."""
    arrays = np.load(binding)
    moved = np.zeros_like(arrays["domain"])
    for v, (begin, end) in enumerate(zip(arrays["domain_indptr"], arrays["domain_indptr"][1:])):
        moved[v] = arrays["domain_data"][begin:end] @ pose[arrays["domain_indices"][begin:end]]
    height, cells = image.shape[0], arrays["cells"]
    x, y = (np.arange(a * samples, b * samples) / samples + 0.5 / samples for a, b in zip(low, high))
    x, y = np.meshgrid(x, height - y)
    found = Triangulation(*moved.T, cells).get_trifinder()(x, y)
    corners = moved[cells[found]]
    sides = np.stack([corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :]], -1)
    parts = np.linalg.solve(sides, np.stack([x, y], -1)[..., None] - corners[..., 0, :, None])[..., 0]
    rest = arrays["domain"][cells[found]]
    rest = rest[..., 0, :] + parts[..., :1] * (rest[..., 1, :] - rest[..., 0, :]) + parts[..., 1:] * (
        rest[..., 2, :] - rest[..., 0, :])
    seen = np.where((found >= 0)[..., None], bilinear(image, rest[..., 0], height - rest[..., 1]), 0)
    count = [(b - a) for a, b in zip(low, high)]
    return seen.reshape(count[1], samples, count[0], samples, -1).mean(axis=(1, 3))


def turned(points, degrees, center):
    angle = math.radians(degrees)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return (points - center) @ turn.T + center


def bent(points):
    """The upper part turns, the farther up the more."""
    part = np.clip((points[:, 1] - 30) / 60, 0, 1)
    center = np.array([48, 30])
    return np.array([turned(p[None], 40 * s, center)[0] for p, s in zip(points, part)])


def test_rigid_motions():
    points = box(4, SIZE - 4)
    binding = bound(points)
    profile = (b"iCCP", b"a profile\0\0" + zlib.compress(bytes(range(200))))
    for kind, channels in ((np.uint8, 4), (np.uint16, 4), (np.uint8, 2), (np.uint16, 2)):
        pixels, file = noise(kind, channels), FOLDER / "picture.png"
        png_file.write(file, pixels, [profile, (b"tEXt", b"Author\0me")])
        seen = pixels[..., -1:] > 0
        found, chunks, _ = deformed(file, binding, points)
        assert found.dtype == kind and found.shape == pixels.shape and offset_of(chunks) == (0, 0)
        assert (found * seen == pixels * seen).all(), "at rest the same picture"
        assert chunks[b"iCCP"] == profile[1] and b"tEXt" not in chunks

        found, chunks, text = deformed(file, binding, points + [13, 30])
        assert offset_of(chunks) == (0, -22) and found.shape[:2] == (SIZE + 22, SIZE + 5), text
        assert "offset (0, -22)" in text
        found = placed(found, offset_of(chunks), (13, -30), (13 + SIZE, SIZE - 30))
        assert (found * seen == pixels * seen).all(), "whole pixels"

        found, chunks, _ = deformed(file, binding, turned(points, 90, [48, 48]))
        assert found.shape == pixels.shape
        difference = premultiplied(found) - np.rot90(premultiplied(pixels))
        assert np.abs(difference).max() <= 1 / np.iinfo(kind).max, "90 degrees"
    for channels in (1, 3):  # opaque
        pixels = noise(np.uint8, channels)
        png_file.write(file, pixels)
        found, *_ = deformed(file, binding, points)
        assert (found[..., :-1] == pixels).all() and (found[..., -1] == 255).all()


def smooth_sprite():
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    alpha = np.clip(36 - np.hypot(x - 48, y - 48), 0, 1)
    colors = np.stack([np.sin(x / 6), np.cos(y / 5), np.sin((x + y) / 9)], -1) / 2 + 0.5
    return np.rint(255 * np.concatenate([colors, alpha[..., None]], -1)).astype(np.uint8)


def test_bend():
    points, file = box(6, SIZE - 6), FOLDER / "sprite.png"
    binding, pixels = bound(points), smooth_sprite()
    png_file.write(file, pixels)
    for pose in (bent(points), bent(points) * [0.4, 1], 2.2 * points):
        found, chunks, _ = deformed(file, binding, pose)
        low, high = (-30, -140), (240, SIZE + 10)
        expected = warped(premultiplied(pixels), binding, pose, low, high)
        found = premultiplied(placed(found, offset_of(chunks), low, high))
        seen = expected[..., -1] > 0
        difference = np.abs(found - expected)[seen].mean()
        assert difference < 0.01, difference
        assert np.abs(found - expected)[~seen].max() < 0.05


def test_no_seams():
    """Nothing shows through an opaque picture, also where it is enlarged, and where the cage is its edge."""
    points, file = box(0, SIZE, 4), FOLDER / "opaque.png"
    binding = bound(points)
    png_file.write(file, np.full((SIZE, SIZE, 3), 200, np.uint8))
    for scale in (1, 3):
        pose = bent(points)
        found, chunks, _ = deformed(file, binding, pose, "--scale", scale)
        covered = warped(np.ones((SIZE, SIZE, 1)), binding, pose, (-60, -60), (200, 200), 1)[..., 0] > 0
        inside = np.kron(binary_erosion(covered, iterations=2), np.ones((scale, scale))) > 0
        found = placed(found, offset_of(chunks), (-60 * scale,) * 2, (200 * scale,) * 2)
        assert inside.sum() > 5000 * scale**2
        assert (found[inside] == [200, 200, 200, 255]).all(), f"scale {scale}"


def test_outside_stays():
    points, file = box(30, 66), FOLDER / "photo.png"
    binding, pixels = bound(points, "inner"), noise(np.uint8, 3)
    png_file.write(file, pixels)
    found, _, text = deformed(file, binding, points)
    assert (found[..., :3] == pixels).all() and (found[..., 3] == 255).all()
    assert "pixels are outside the cage" in text
    found, chunks, _ = deformed(file, binding, points + [60, 0])
    assert offset_of(chunks) == (0, 0)
    assert (found[:SIZE, :25, :3] == pixels[:, :25]).all()
    assert (found[32:64, 92:124, :3] == pixels[32:64, 32:64]).all(), "moved"
    assert (found[33:63, 33:63, 3] == 0).all(), "a hole where it was"


def test_folds():
    """What moves farther is in front, and where it is transparent, the rest shows through."""
    pixels = np.zeros((SIZE, SIZE, 4), np.uint8)
    pixels[60:90, 6:90] = [0, 0, 255, 255]
    pixels[20:60, 70:90] = [255, 0, 0, 255]
    file = FOLDER / "arm.png"
    png_file.write(file, pixels)
    rest = np.array([(2, 2), (94, 2), (94, 36), (94, 80), (66, 80), (66, 40), (2, 40)], float)
    binding = bound(rest, "arm")
    pose = rest.copy()
    pose[3:5] = [(0, 10), (2, 30)]  # the arm lies across the body
    found, chunks, _ = deformed(file, binding, pose)
    found = placed(found, offset_of(chunks), (0, 0), (SIZE, SIZE))
    body = found[66:86, 10:60]
    assert (body[..., 3] == 255).all() and set(map(tuple, body[..., :3].reshape(-1, 3))) >= {(255, 0, 0), (0, 0, 255)}


def test_sheet_and_frames():
    points, file = box(6, SIZE - 6), FOLDER / "sprite.png"
    binding = bound(points)
    png_file.write(file, smooth_sprite())
    poses = [cage(f"pose_{k}.obj", turned(points, 9 * k, [10, 10])) for k in range(5)]
    common = ("--weights", binding, "--pose", FOLDER / "pose_%d.obj")
    flbc("deform", file, *common, "-o", FOLDER / "bent_%04d.png")
    frames = [png_file.read(FOLDER / f"bent_{k:04d}.png") for k in range(len(poses))]
    assert len({(frame.shape, offset_of(chunks)) for frame, chunks in frames}) == 1, "one canvas"
    flbc("deform", file, *common, "--sheet", "--fps", 10, "-o", FOLDER / "bent.png")
    sheet, _ = png_file.read(FOLDER / "bent.png")
    cells = json.loads((FOLDER / "bent.json").read_text())
    assert list(cells["frames"]) == [f"bent_{k:04d}.png" for k in range(len(poses))]
    assert cells["meta"]["image"] == "bent.png"
    assert cells["meta"]["size"] == {"w": sheet.shape[1], "h": sheet.shape[0]}
    for (frame, _), cell in zip(frames, cells["frames"].values()):
        x, y, w, h = (cell["frame"][key] for key in "xywh")
        assert (sheet[y:y + h, x:x + w] == frame).all()
        assert cell["duration"] == 100 and cell["sourceSize"] == {"w": w, "h": h}


def test_run():
    file = FOLDER / "sprite.png"
    png_file.write(file, smooth_sprite())
    out = FOLDER / "auto"
    flbc("run", file, "--auto-cage", "--vertices", 500, "-q", "-o", out)
    lines = (out / "cage.obj").read_text().splitlines()
    moved = ["v {} {} 0".format(float(w[1]) + 10, float(w[2]) * 0.8) if w and w[0] == "v" else " ".join(w)
             for w in map(str.split, lines)]
    pose = FOLDER / "auto_pose.obj"
    pose.write_text("\n".join(moved))
    flbc("run", file, "--auto-cage", "--vertices", 500, "--pose", pose, "-q", "-o", out)
    flbc("deform", file, "--weights", out / "binding.npz", "--pose", pose, "-q", "-o", FOLDER / "same.png")
    ours, same = (png_file.read(path) for path in (out / "deformed.png", FOLDER / "same.png"))
    assert (ours[0] == same[0]).all() and ours[1] == same[1] and ours[0][..., 3].any()
    report = json.loads((out / "report.json").read_text())
    assert {"pose": str(pose), "file": "deformed.png", "offset": list(offset_of(ours[1]))} in report["deform"]


def test_jpeg():
    points = box(0, SIZE)
    binding = bound(points)
    colors = Image.fromarray(smooth_sprite()[:64, :, :3])
    for mode in ("RGB", "L"):
        for orientation in range(1, 9):
            exif = Image.Exif()
            exif[0x112] = orientation
            path = FOLDER / "photo.jpg"
            colors.convert(mode).save(path, quality=95, exif=exif, icc_profile=bytes(range(256)) * 3)
            upright = np.asarray(ImageOps.exif_transpose(Image.open(path))).astype(int)
            found, chunks, _ = deformed(path, binding, points)
            found = found[-upright.shape[0]:, :upright.shape[1]]
            difference = found[..., :-1].astype(int) - upright.reshape(*upright.shape[:2], -1)
            assert np.abs(difference).max() <= 3, (mode, orientation)
            name, profile = chunks[b"iCCP"].split(b"\0\0", 1)
            assert zlib.decompress(profile) == bytes(range(256)) * 3
    path.write_bytes(b"\xff\xd8\xff\xe0 no picture")
    assert "photo.jpg" in flbc("deform", path, "--weights", binding, "--pose", FOLDER / "rest.obj", "-o",
                               FOLDER / "no.png", status=2)


def test_drawing():
    """The picture of a bent drawing is the bent picture of the drawing."""
    if not shutil.which("rsvg-convert"):
        return
    document = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 96 96" width="96" height="96">'
        '<path fill="#c50" d="M20 70C20 20 40 10 48 12S80 30 76 70z"/>'
        '<circle cx="40" cy="40" r="9" fill="#26c"/><rect x="50" y="50" width="16" height="12" fill="#fe4"/></svg>')
    drawing, painted = FOLDER / "drawing.svg", FOLDER / "drawing.png"
    drawing.write_text(document)
    points = box(6, SIZE - 6)
    binding, pose = bound(points), bent(points)
    subprocess.run(["rsvg-convert", drawing, "-o", painted], check=True)
    found, chunks, _ = deformed(painted, binding, pose)
    result = FOLDER / "bent.svg"
    flbc("deform", drawing, "--weights", binding, "--pose", FOLDER / "pose.obj", "-q", "-o", result)
    subprocess.run(["rsvg-convert", result, "-o", painted], check=True)
    expected = premultiplied(np.asarray(Image.open(io.BytesIO(painted.read_bytes())).convert("RGBA")))
    found = premultiplied(placed(found, offset_of(chunks), (0, 0), (SIZE, SIZE)))
    seen = (found[..., 3] > 0) | (expected[..., 3] > 0)
    difference = np.abs(found - expected)[seen].mean()
    assert difference < 0.01, difference


def test_refusals():
    points, file = box(6, SIZE - 6), FOLDER / "sprite.png"
    binding = bound(points)
    pose = cage("pose.obj", 1e6 * points)
    png_file.write(file, smooth_sprite())
    common = ("deform", file, "--weights", binding, "--pose", pose)
    assert "at most 16384 x 16384" in flbc(*common, "-o", FOLDER / "no.png", status=2)
    for words in (("-o", "no.jpg"), ("--outside", "keep", "-o", "no.png"), ("--scale", 0, "-o", "no.png")):
        flbc(*common[:5], FOLDER / "rest.obj", *words, status=1)
    flbc("deform", file, "--weights", FOLDER / "rest/weights.npy", "--rest", FOLDER / "rest.obj", "--pose",
         pose, "-o", "no.png", status=1)
    flbc("deform", FOLDER / "rest/domain.obj", "--weights", binding, "--pose", pose, "--sheet", "-o", "no.obj",
         status=1)
    assert not list(FOLDER.glob("no.*"))


TESTS = [test for name, test in list(globals().items()) if name.startswith("test_")]
for test in TESTS:
    test()
    print(test.__name__)
shutil.rmtree(FOLDER)
