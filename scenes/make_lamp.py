#!/usr/bin/env python3
"""Writes lamp.glb, after Figure 1 of Hachisuka, Ogaki, Jensen: Progressive Photon Mapping (2008).

From the paper's words: a glass lamp with a small light inside illuminates a wall and throws a complex pattern of
caustics on it, which is also seen through the lamp. So all light has gone through glass, and much of it comes back
to the eye through the same glass. The lamp's shape, the table and the colours are ours.

Usage: make_lamp.py [OUTPUT.glb]   (default: lamp.glb beside this script)
"""

import math
import pathlib
import sys

from gltf_builder import Scene, diffuse, geodesic_sphere, glass, light, metal, quad
from shapes import broken, patch, rounded_box, shell, spline, turned
from textures import noise, png, ramp

WALL_Z = -0.30                   # the lamp stands at the origin, on the table top (y = 0)
GLASS = 0.006                    # thickness of the lamp's wall between the waves
WAVES, TWIST, WAVE = 13, 0.50, 0.0028   # waves around, turns from foot to neck, height
UNEVEN = 0.0012                  # what the glass blower's hand added
BULB, BULB_Y = 0.0035, 0.205
PROFILE = spline([(0.046, 0.092), (0.078, 0.112), (0.104, 0.150), (0.110, 0.195), (0.098, 0.240), (0.072, 0.280),
                  (0.046, 0.308), (0.034, 0.325), (0.031, 0.342)])


def lamp_glass():
    """A bellied vessel, open at both ends. Twisted waves outside work as lenses; the inside is smooth."""
    def outer(u, v):
        r, y = PROFILE(v)
        swell = math.sin(math.pi * v) ** 0.7 if 0 < v < 1 else 0.0
        twisted = 2 * math.pi * (u + TWIST * v)
        counter = 2 * math.pi * (u - TWIST * v)
        r += WAVE * swell * (0.5 * math.cos(WAVES * twisted) + 0.5 * math.cos(WAVES * counter))
        r += UNEVEN * swell * math.sin(3 * twisted + 5 * v) * math.cos(2 * counter - 11 * v)
        return r * math.sin(2 * math.pi * u), y, r * math.cos(2 * math.pi * u)

    def inner(u, v):
        r, y = PROFILE(v)
        r -= GLASS
        return r * math.sin(2 * math.pi * u), y, r * math.cos(2 * math.pi * u)
    return shell(outer, inner, 288, 144)


def add_lamp(scene):
    brass = scene.material("brass", metal((0.91, 0.72, 0.40)))
    foot = broken([(0, 0.001), (0.075, 0.001), (0.075, 0.012), (0.030, 0.026), (0.018, 0.050), (0.022, 0.075),
                   (0.056, 0.082), (0.056, 0.094), (0.052, 0.094), (0.050, 0.088), (0, 0.088)], 0.006)
    scene.add("foot", turned(foot, 96), brass)
    cap = broken([(0, 0.346), (0.033, 0.346), (0.033, 0.336), (0.0355, 0.336), (0.0355, 0.352), (0.012, 0.362),
                  (0.006, 0.366), (0.009, 0.374), (0.008, 0.382), (0, 0.385)], 0.004)
    scene.add("cap", turned(cap, 96), brass)
    stem = broken([(0.012, 0.086), (0.012, 0.095), (0.0035, 0.105), (0.003, BULB_Y - 0.012), (0.0045, BULB_Y - 0.008),
                   (0.0045, BULB_Y - 0.005), (0, BULB_Y - 0.005)], 0.003)
    scene.add("stem", turned(stem, 48), brass)
    scene.add("lamp glass", lamp_glass(), scene.material("glass", glass(1.5)))
    shine = scene.material("light", light((1.0, 0.80, 0.52), 9000))
    scene.add("light", geodesic_sphere(6), shine, (0, BULB_Y, 0), BULB)


def wood():
    """Planks along the picture's width."""
    width, height, planks = 512, 512, 4
    rows = []
    for y in range(height):
        plank = y * planks // height
        within = y / height * planks - plank
        row = []
        for x in range(width):
            s = x / width
            bend = noise(s * 4, within * 2 + plank * 7, 4, seed=plank)
            rings = within * 9 + 5 * bend + 1.3 * noise(s * 8, within * 6, 8, seed=10 + plank)
            grain = 0.5 + 0.5 * math.sin(2 * math.pi * rings)
            fibre = noise(s * 24, within * 60, 24, seed=20 + plank)
            pore = noise(s * 48, within * 110, 48, seed=30 + plank)
            value = 0.30 + 0.28 * grain * grain + 0.22 * fibre - (0.22 if pore > 0.80 else 0.0) + 0.06 * (plank % 2)
            if min(within, 1 - within) < 0.012:
                value *= 0.35
            row.append(max(0, min(255, int(255 * value))))
        rows.append(row)
    browns = [(58, 32, 18), (120, 72, 40), (170, 110, 64), (204, 146, 92), (224, 176, 120)]
    return png(width, height, rows, ramp(browns))


def add_room(scene):
    wall = scene.material("wall", diffuse((0.78, 0.74, 0.66)))
    dim = scene.material("rest of the room", diffuse((0.42, 0.40, 0.38)))
    left, right, front, floor, ceiling = -1.3, 1.5, 1.7, -0.75, 1.5
    across, up, along = (right - left, 0, 0), (0, ceiling - floor, 0), (0, 0, front - WALL_Z)
    scene.add("wall", quad((left, floor, WALL_Z), across, up), wall)
    scene.add("front wall", quad((left, floor, front), up, across), dim)
    scene.add("left wall", quad((left, floor, WALL_Z), up, along), dim)
    scene.add("right wall", quad((right, floor, WALL_Z), along, up), dim)
    scene.add("ceiling", quad((left, ceiling, WALL_Z), across, along), wall)
    scene.add("floor", quad((left, floor, WALL_Z), along, across), dim)

    varnish = {"pbrMetallicRoughness": {"baseColorTexture": {"index": scene.texture("wood", wood())},
                                        "metallicFactor": 0, "roughnessFactor": 0}}
    varnished = scene.material("varnished wood", varnish)
    top = patch(lambda u, v: (-0.9 + 2.0 * u, 0, 0.62 - (0.62 - WALL_Z - 0.004) * v), 1, 1,
                coordinates=lambda u, v: (2.5 * u, 1 - v))
    scene.add("table top", top, varnished)
    edge = patch(lambda u, v: (-0.9 + 2.0 * u, -0.04 + 0.04 * v, 0.62), 1, 1,
                 coordinates=lambda u, v: (2.5 * u, 0.06 * v))
    scene.add("table edge", edge, varnished)


def main():
    purpose = "A glass lamp by a wall, after Figure 1 of the progressive photon mapping paper (2008)"
    scene = Scene(purpose, quantized=True)
    add_room(scene)
    add_lamp(scene)
    scene.camera("front", (0.20, 0.35, 1.00), (0.065, 0.190, -0.05), 0.50, 4 / 3)
    scene.write(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("lamp.glb"))
    print(f"{scene.triangle_count()} triangles")


if __name__ == "__main__":
    main()
