#!/usr/bin/env python3
"""Compares two renderings of a scene: means over blocks, their ratios, and a picture of both side by side.

    compare.py CYCLES.exr PPM.exr [--blocks 8x6] [--exposure EV] [--png OUT.png] [--other PPM2.exr]

The ratio of a block is PPM / Cycles of its mean luminance (R + G + B), and of each channel in --channels. `--other`,
a rendering by another seed, gives the noise of the ratios. Needs numpy and oiiotool.
"""

import argparse
import os
import struct
import subprocess
import tempfile
import zlib

import numpy as np


def read(path):
    """[height, width, 3] of an EXR, from the top."""
    with tempfile.TemporaryDirectory() as folder:
        plain = os.path.join(folder, "plain.exr")  # uncompressed, by lines, single precision
        subprocess.run(["oiiotool", path, "--ch", "R,G,B", "-d", "float", "--compression", "none", "--scanline",
                        "-o", plain], check=True)
        with open(plain, "rb") as file:
            data = file.read()
    at, header = 8, {}
    while data[at]:
        name, kind = (part.decode() for part in data[at:].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    at += 1 + 8 * height  # the table of lines
    lines = np.frombuffer(data[at:], np.dtype([("y", "<i4"), ("size", "<i4"), ("bgr", "<f4", (3, width))]), height)
    assert (lines["size"] == 12 * width).all() and (np.diff(lines["y"]) == 1).all()
    return lines["bgr"][:, ::-1, :].transpose(0, 2, 1).astype(float)


def block_means(picture, columns, rows):
    height, width, _ = picture.shape
    assert height % rows == 0 and width % columns == 0, "blocks of equal size"
    return picture.reshape(rows, height // rows, columns, width // columns, 3).mean(axis=(1, 3))


def encode(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def write_png(path, picture):
    height, width, _ = picture.shape
    rows = (picture * 255 + 0.5).astype(np.uint8)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def false_colours(ratio):
    """Grey where equal, red where PPM is brighter, blue where darker; full at 20 %."""
    d = np.clip((ratio - 1) / 0.2, -1, 1)
    return np.stack([0.5 + 0.5 * d, 0.5 - 0.5 * np.abs(d), 0.5 - 0.5 * d], axis=-1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cycles")
    parser.add_argument("ppm")
    parser.add_argument("--blocks", default="8x6")
    parser.add_argument("--exposure", type=float, default=0.0)
    parser.add_argument("--png")
    parser.add_argument("--other")
    parser.add_argument("--channels", action="store_true")
    options = parser.parse_args()

    columns, rows = map(int, options.blocks.split("x"))
    cycles, ppm = read(options.cycles), read(options.ppm)
    theirs, ours = block_means(cycles, columns, rows), block_means(ppm, columns, rows)
    dark = 1e-3 * theirs.mean()  # blocks below are left out
    ratio = np.where(theirs.sum(axis=2) > dark, ours.sum(axis=2) / np.maximum(theirs.sum(axis=2), dark), np.nan)
    print(f"PPM / Cycles, {columns}x{rows} blocks from the top left")
    for row in ratio:
        print("  " + " ".join(f"{x:6.3f}" for x in row))
    if options.channels:
        for channel, name in enumerate("RGB"):
            print(name)
            for row in (ours / np.maximum(theirs, dark))[:, :, channel]:
                print("  " + " ".join(f"{x:6.3f}" for x in row))
    seen = ~np.isnan(ratio)
    off = np.abs(ratio[seen] - 1)
    channels = np.abs(ours / np.maximum(theirs, dark) - 1).max(axis=2)[seen]
    print(f"whole picture {ours.sum() / theirs.sum():.4f}; median of blocks {np.nanmedian(ratio):.4f}; "
          + "; ".join(f"within {limit} %: {np.mean(off <= limit / 100):.0%} (each channel "
                      f"{np.mean(channels <= limit / 100):.0%})" for limit in (2, 5, 10)))
    if options.other:
        again = block_means(read(options.other), columns, rows).sum(axis=2)
        noise = np.abs(again[seen] / ours.sum(axis=2)[seen] - 1)
        print(f"another seed changes blocks by {np.median(noise):.2%} (median), {noise.max():.2%} (most)")
    if options.png:
        grow = max(1, 480 // cycles.shape[1])
        gain = 2.0 ** options.exposure
        scale = (cycles.shape[0] // rows, cycles.shape[1] // columns)
        map_ = np.kron(false_colours(np.nan_to_num(ratio, nan=1.0)), np.ones((*scale, 1)))
        sheet = np.concatenate([encode(cycles * gain), encode(ppm * gain), map_], axis=1)
        write_png(options.png, np.kron(sheet, np.ones((grow, grow, 1))))


main()
