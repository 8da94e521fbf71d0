#!/usr/bin/env python3
"""Writes box.glb, the room of Figure 6 in Hachisuka, Ogaki, Jensen: Progressive Photon Mapping (2008).

From the paper's words: a box with two mirror balls, one of them faceted, and a smaller glass ball. The only
light comes from two fixtures at the ceiling, each a small spherical light behind a spherical lens inside a
metal cylinder. So nearly all light in the room has passed glass: what the camera sees are caustics, and in
the balls the reflections of caustics. Sizes, places and colours are ours.

Usage: make_box.py [OUTPUT.glb]   (default: box.glb beside this script)
"""

import pathlib
import sys

from gltf_builder import Scene, diffuse, geodesic_sphere, glass, lathe, light, metal, quad

WIDTH, HEIGHT, BACK, FRONT = 2.4, 1.6, -1.1, 2.4  # the room: |x| <= WIDTH/2, 0 <= y <= HEIGHT, BACK <= z <= FRONT
HAIR = 0.002                                      # balls float this high: glass must not touch anything

# The fixtures. Where they hang decides what is seen: the left one shines on the glass ball and the mirror
# ball, the right one on the far shoulder of the faceted ball.
LENS_RADIUS = 0.14
LENS_Y = 1.30
LIGHT_RADIUS = 0.017
LIGHT_ABOVE_LENS = 0.1605    # centre to centre, well inside the focus (1.5 radii at index 1.5): the beam spreads
TUBE_RADIUS = 0.1425         # inside; a ring of 2.5 mm is left around the lens
TUBE_WALL = 0.006
TUBE_MOUTH_Y = 1.22          # above the lens's lowest point, so that it bulges out
TUBE_END_Y = 1.54            # inner end, below the ceiling


def add_room(scene):
    white = scene.material("white wall", diffuse((0.75, 0.75, 0.72)))
    red = scene.material("red wall", diffuse((0.70, 0.24, 0.18)))
    blue = scene.material("blue wall", diffuse((0.20, 0.34, 0.70)))
    floor = scene.material("floor", diffuse((0.72, 0.68, 0.60)))
    left, right, depth = -WIDTH / 2, WIDTH / 2, FRONT - BACK
    across, up, along = (WIDTH, 0, 0), (0, HEIGHT, 0), (0, 0, depth)
    scene.add("floor", quad((left, 0, BACK), along, across), floor)
    scene.add("ceiling", quad((left, HEIGHT, BACK), across, along), white)
    scene.add("back wall", quad((left, 0, BACK), across, up), white)
    scene.add("front wall", quad((left, 0, FRONT), up, across), white)
    scene.add("left wall", quad((left, 0, BACK), up, along), red)
    scene.add("right wall", quad((right, 0, BACK), along, up), blue)


def add_balls(scene, glass_material):
    mirror = scene.material("mirror", metal((0.93, 0.93, 0.93)))
    smooth, faceted = geodesic_sphere(32), geodesic_sphere(4, smooth=False)
    for name, mesh, material, radius, x, z in (
            ("mirror ball", smooth, mirror, 0.36, -0.34, -0.34),
            ("faceted mirror ball", faceted, mirror, 0.34, 0.54, -0.22),
            ("glass ball", smooth, glass_material, 0.17, -0.62, 0.18)):
        scene.add(name, mesh, material, (x, radius + HAIR, z), radius)


def add_fixtures(scene, glass_material):
    dark_mirror = scene.material("dark mirror", metal((0.50, 0.50, 0.48)))
    brushed = scene.material("brushed metal", metal((0.72, 0.68, 0.62), roughness=0.6))
    warm = scene.material("light", light((1.0, 0.88, 0.70), 1500))
    outside = TUBE_RADIUS + TUBE_WALL
    reflector = lathe([(0, TUBE_END_Y), (TUBE_RADIUS, TUBE_END_Y), (TUBE_RADIUS, TUBE_MOUTH_Y)], 96)
    # The outside runs a little into the ceiling, so that no edge lies in its plane.
    shell = lathe([(TUBE_RADIUS, TUBE_MOUTH_Y), (outside, TUBE_MOUTH_Y), (outside, HEIGHT + 0.01)], 96)
    bulb, lens = geodesic_sphere(6), geodesic_sphere(24)
    for side, x, z in (("left", -0.56, 0.0), ("right", 0.64, -0.20)):
        scene.add(f"{side} reflector", reflector, dark_mirror, (x, 0, z))
        scene.add(f"{side} shell", shell, brushed, (x, 0, z))
        scene.add(f"{side} light", bulb, warm, (x, LENS_Y + LIGHT_ABOVE_LENS, z), LIGHT_RADIUS)
        scene.add(f"{side} lens", lens, glass_material, (x, LENS_Y, z), LENS_RADIUS)


def main():
    scene = Scene("A room lit through lenses only, after Figure 6 of the progressive photon mapping paper (2008)")
    glass_material = scene.material("glass", glass(1.5))
    add_room(scene)
    add_balls(scene, glass_material)
    add_fixtures(scene, glass_material)
    scene.camera("front", (0, 0.92, 2.3), (0, 0.70, 0), 0.7, 4 / 3)
    scene.write(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("box.glb"))
    print(f"{scene.triangle_count()} triangles")


if __name__ == "__main__":
    main()
