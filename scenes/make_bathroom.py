#!/usr/bin/env python3
"""Writes bathroom.glb, after Figure 8 of Hachisuka, Ogaki, Jensen: Progressive Photon Mapping (2008).

From the paper's words: a bathroom with a mirror, chrome pipes and a glass door, of complex geometry, lit by two
small spherical lights enclosed in bumpy glass tubes. So every way of light from a lamp to the eye that ends in the
mirror, in the chrome or behind the glass door is specular at both ends. Room, tiles and colours are ours.

Usage: make_bathroom.py [OUTPUT.glb]   (default: bathroom.glb beside this script)
"""

import pathlib
import sys

import bathroom_fittings as fittings
import bathroom_room as room
from gltf_builder import Scene, glass, metal


def main():
    scene = Scene("A bathroom, after Figure 8 of the progressive photon mapping paper (2008)", quantized=True)
    room.add_walls(scene)
    room.add_shower_tiles(scene)
    room.add_floor(scene)
    room.add_mat(scene)
    room.add_door(scene)
    chrome = scene.material("chrome", metal((0.80, 0.81, 0.82)))
    silver = scene.material("silver", metal((0.93, 0.94, 0.93)))
    clear = scene.material("glass", glass(1.5))
    fittings.add_lamps(scene, chrome, clear)
    fittings.add_mirror(scene, chrome, silver, clear)
    fittings.add_basin(scene, chrome)
    fittings.add_tap(scene, chrome)
    fittings.add_towel_warmer(scene, chrome)
    fittings.add_shower(scene, chrome, clear)
    fittings.add_small_things(scene, chrome, clear)
    scene.camera("front", (-0.30, 1.50, 2.62), (0.12, 0.99, 0), 0.82, 4 / 3)
    scene.write(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("bathroom.glb"))
    print(f"{scene.triangle_count()} triangles")


if __name__ == "__main__":
    main()
