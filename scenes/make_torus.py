#!/usr/bin/env python3
"""Writes torus.glb, after Figure 7 of Hachisuka, Ogaki, Jensen: Progressive Photon Mapping (2008).

From the paper's words: a torus embedded in a glass cube (inspired by a scene by Cline et al. 2005). The torus is
diffuse and the cube solid, so that what lights the torus and what the eye sees of it has gone through glass: nothing
but specular-diffuse-specular paths. The light is small and bright like a low sun: a disc whose radius seen from the
cube is 0.5 degrees, behind the eye. Sizes, places and colours are ours.

Usage: make_torus.py [OUTPUT.glb]   (default: torus.glb beside this script)
"""

import math
import pathlib
import sys

from gltf_builder import Mesh, Scene, diffuse, glass, light, normalized, cross
from shapes import patch, placed, rounded_box, spline, torus

CUBE = 1.0                       # edge, with a bevel
BEVEL = 0.015
HAIR = 0.002                     # the cube floats this high: glass must not touch anything
RING, PIPE = 0.30, 0.125
SUN_DIRECTION = normalized((-0.80, 0.75, 0.30))
SUN_DISTANCE, SUN_RADIUS = 3.6, 0.032
SUN_RADIANCE = 13000


def sun():
    """A disc that faces the cube."""
    centre = [SUN_DISTANCE * x for x in SUN_DIRECTION]
    u = normalized(cross((0, 1, 0), SUN_DIRECTION))
    v = cross(SUN_DIRECTION, u)
    rim = []
    for k in range(32):
        c, s = math.cos(2 * math.pi * k / 32), math.sin(2 * math.pi * k / 32)
        rim.append(tuple(m + SUN_RADIUS * (c * a + s * b) for m, a, b in zip(centre, u, v)))
    return Mesh([tuple(centre), *rim], [(0, 1 + (k + 1) % 32, 1 + k) for k in range(32)])


def stage():
    """A floor that bends up into a wall, as photographers use it."""
    way = [(3.2, 0.0), (2.0, 0.0), (1.0, 0.0), (0.0, 0.0), (-1.0, 0.0), (-1.7, 0.06), (-2.2, 0.35), (-2.5, 0.85),
           (-2.6, 1.5), (-2.6, 2.4), (-2.6, 3.4)]
    curve = spline(way)

    def point(u, v):
        z, y = curve(v)
        return -4.0 + 8.0 * u, y, z
    return patch(point, 1, 80)


def main():
    scene = Scene("A torus in a cube of glass, after Figure 7 of the progressive photon mapping paper (2008)")
    scene.add("stage", stage(), scene.material("paper", diffuse((0.58, 0.57, 0.55))))
    cube = placed(rounded_box((CUBE,) * 3, BEVEL), axis="y", angle=0.52)
    scene.add("cube", cube, scene.material("glass", glass(1.5)), (0, CUBE / 2 + HAIR, 0))
    ring = placed(placed(torus(RING, PIPE, 160, 64), axis="x", angle=0.85), axis="y", angle=0.15)
    scene.add("torus", ring, scene.material("clay", diffuse((0.82, 0.34, 0.10))), (0, CUBE / 2, 0))
    scene.add("sun", sun(), scene.material("sun", light((1.0, 0.93, 0.82), SUN_RADIANCE)))
    scene.camera("front", (0.35, 1.45, 3.2), (0.05, 0.43, 0), 0.50, 4 / 3)
    scene.write(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("torus.glb"))
    print(f"{scene.triangle_count()} triangles")


if __name__ == "__main__":
    main()
