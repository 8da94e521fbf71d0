"""Pictures for materials, made of noise that is the same everywhere, and the PNG to keep them in."""

import functools
import math
import struct
import zlib


def png(width, height, pixels, palette):
    """A PNG of `pixels`, rows from the top of indices into `palette` (at most 256 colours of three bytes). It is
    stored without compression, since zlib's output differs from version to version."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(row) for row in pixels)
    stream = b"\x78\x01"
    for start in range(0, len(rows), 65535):
        block = rows[start:start + 65535]
        stream += struct.pack("<BHH", start + 65535 >= len(rows), len(block), len(block) ^ 0xFFFF) + block
    stream += struct.pack(">I", zlib.adler32(rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
            chunk(b"PLTE", b"".join(bytes(color) for color in palette)) + chunk(b"IDAT", stream) + chunk(b"IEND", b""))


def ramp(colors, count=256):
    """A palette that goes evenly through colours (sRGB, 0 to 255)."""
    palette = []
    for k in range(count):
        t = k / (count - 1) * (len(colors) - 1)
        i = min(int(t), len(colors) - 2)
        palette.append(tuple(round(a + (t - i) * (b - a)) for a, b in zip(colors[i], colors[i + 1])))
    return palette


@functools.lru_cache(maxsize=None)
def hashed(*cell):
    """A number in [0,1) from integers."""
    h = 2166136261
    for x in cell:
        h = (h ^ (x & 0xFFFFFFFF)) * 16777619 & 0xFFFFFFFF
        h ^= h >> 15
    h = h * 2246822519 & 0xFFFFFFFF
    return ((h ^ h >> 13) * 3266489917 & 0xFFFFFFFF) / 2 ** 32


def noise(x, y, period_x=1 << 20, period_y=1 << 20, seed=0):
    """Smooth value noise in [0,1], one value a unit; it repeats after the periods."""
    i, j = math.floor(x), math.floor(y)
    s, t = x - i, y - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)

    def at(a, b):
        return hashed(a % period_x, b % period_y, seed)
    low = at(i, j) + s * (at(i + 1, j) - at(i, j))
    high = at(i, j + 1) + s * (at(i + 1, j + 1) - at(i, j + 1))
    return low + t * (high - low)
