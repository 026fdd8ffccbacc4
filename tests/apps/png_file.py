# SPDX-License-Identifier: BSD-3-Clause
"""PNG files of gray or RGB with 8 or 16 bits and maybe alpha, without libpng."""
import struct
import zlib

import numpy as np

CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by color type


def write(path, pixels, chunks=()):
    """`pixels` has shape (height, width, channels) and type uint8 or uint16; `chunks` are pairs."""
    height, width, channels = pixels.shape
    kind = next(kind for kind, count in CHANNELS.items() if count == channels)
    depth = 8 * pixels.dtype.itemsize
    rows = pixels.astype(f">u{depth // 8}").view(np.uint8).reshape(height, -1)
    content = zlib.compress(np.hstack([np.zeros((height, 1), np.uint8), rows]).tobytes())
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    file = b"\x89PNG\r\n\x1a\n"
    for name, data in [(b"IHDR", header), *chunks, (b"IDAT", content), (b"IEND", b"")]:
        file += struct.pack(">I", len(data)) + name + data
        file += struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(file)


def read(path):
    """The pixels, and all chunks by name."""
    file, at, chunks = path.read_bytes(), 8, {}
    while at < len(file):
        length, name = struct.unpack_from(">I4s", file, at)
        data, check = file[at + 8:at + 8 + length], file[at + 8 + length:at + 12 + length]
        assert struct.pack(">I", zlib.crc32(name + data)) == check, name
        chunks[name] = chunks.get(name, b"") + data
        at += 12 + length
    width, height, depth, kind, *rest = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert rest == [0, 0, 0] and depth >= 8
    size = CHANNELS[kind] * depth // 8
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
    pixels = np.zeros((height + 1, size * (width + 1)), np.uint8)  # zeros above and to the left
    for y, row in enumerate(rows):
        above, line = pixels[y], pixels[y + 1]
        line[size:] = row[1:]
        if row[0] == 2:
            line[size:] += above[size:]
        elif row[0] != 0:
            for x in range(size, len(line)):
                a, b, c = int(line[x - size]), int(above[x]), int(above[x - size])
                nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))
                line[x] = (int(line[x]) + {1: a, 3: (a + b) // 2, 4: nearest[2]}[row[0]]) % 256
    pixels = np.ascontiguousarray(pixels[1:, size:]).view(f">u{depth // 8}")
    return pixels.astype(f"u{depth // 8}").reshape(height, width, -1), chunks
