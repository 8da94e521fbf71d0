"""The bathroom's room: walls and floor with their tiles, paint, door and mat. Lengths are metres; the wall with the
washbasin is z = 0, x goes to the right along it, z into the room, y up."""

import math

from gltf_builder import Mesh, diffuse, geodesic_sphere, metal, normalized, quad
from shapes import joined, placed, rounded_box, spun, tube
from textures import hashed

LEFT, RIGHT, FRONT, HEIGHT = -1.2, 1.4, 3.0, 2.45
PITCH, JOINT, THICK = 0.152, 0.004, 0.006       # of the tiles
DADO = 8 * PITCH                                # the walls are tiled up to here, and painted above
MOSAIC = 0.0525                                 # pitch of the small tiles in the shower
SHOWER_LEFT, SHOWER_FRONT = 0.60, 0.86
SHOWER_ROWS = 42


def gloss(color, roughness):
    """A glaze: what shines is as rough as said, over a diffuse base."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": roughness}}


def tile(width, thickness, bend):
    """A square tile that faces +z, its back in z = 0 and open, its edges and corners rounded."""
    rings = []
    for inset, depth, tilt in ((0, 0, 0.0), (0, thickness - bend, 0.0), (0.293 * bend, thickness - 0.293 * bend, 0.25),
                               (bend, thickness, 0.5)):
        ring, h = [], width / 2 - bend
        out = max(0.0, bend - inset)
        for k in range(4):
            for turn in (0.0, 0.5, 1.0):
                a = math.pi / 2 * (k + turn)
                corner = math.pi / 2 * (k + 0.5)
                x = math.copysign(h, math.cos(corner)) + out * math.cos(a)
                y = math.copysign(h, math.sin(corner)) + out * math.sin(a)
                flat = math.cos(math.pi * tilt)
                ring.append(((x, y, depth), (flat * math.cos(a), flat * math.sin(a), math.sin(math.pi * tilt))))
        rings.append(ring)
    count = len(rings[0])
    positions = [p for ring in rings for p, _ in ring] + [(0.0, 0.0, thickness)]
    normals = [normalized(n) for ring in rings for _, n in ring] + [(0.0, 0.0, 1.0)]
    triangles = []
    for j in range(len(rings) - 1):
        for i in range(count):
            a, b = j * count + i, j * count + (i + 1) % count
            triangles += [(a, b, b + count), (a, b + count, a + count)]
    last = (len(rings) - 1) * count
    triangles += [(last + i, last + (i + 1) % count, len(positions) - 1) for i in range(count)]
    # The innermost ring's corners are points.
    triangles = [t for t in triangles if len({positions[k] for k in t}) == 3]
    return Mesh(positions, triangles, normals)


def lay(scene, name, mesh, materials, columns, rows, place):
    """Copies of a tile at place(column, row), each in one of the materials, unless place says None."""
    places = {material: [] for material in materials}
    for j in range(rows):
        for i in range(columns):
            where = place(i, j)
            if where:
                places[materials[int(hashed(i, j, len(name)) * len(materials))]].append(where)
    for material, copies in places.items():
        if copies:
            scene.add(name, mesh, material, copies=copies)


def add_walls(scene):
    grout = scene.material("joints", diffuse((0.46, 0.44, 0.41)))
    paint = scene.material("paint", diffuse((0.80, 0.73, 0.58)))
    white = scene.material("ceiling", diffuse((0.82, 0.81, 0.78)))
    across, along = RIGHT - LEFT, FRONT
    scene.add("floor", quad((LEFT, 0, 0), (0, 0, along), (across, 0, 0)), grout)
    scene.add("ceiling", quad((LEFT, HEIGHT, 0), (across, 0, 0), (0, 0, along)), white)
    for y0, y1, material, name in ((0, DADO, grout, "behind tiles"), (DADO, HEIGHT, paint, "painted")):
        up = (0, y1 - y0, 0)
        scene.add(f"back wall, {name}", quad((LEFT, y0, 0), (across, 0, 0), up), material)
        scene.add(f"front wall, {name}", quad((LEFT, y0, along), up, (across, 0, 0)), material)
        scene.add(f"left wall, {name}", quad((LEFT, y0, 0), up, (0, 0, along)), material)
        scene.add(f"right wall, {name}", quad((RIGHT, y0, 0), (0, 0, along), up), material)

    glazes = [scene.material(f"white glaze {k}", gloss(color, 0.25)) for k, color in
              enumerate(((0.80, 0.79, 0.75), (0.77, 0.77, 0.74), (0.82, 0.80, 0.74)))]
    plain = tile(PITCH - JOINT, THICK, 0.0025)
    half = PITCH / 2

    def outside_shower(x, z):
        return x < SHOWER_LEFT or z > SHOWER_FRONT
    lay(scene, "back tiles", plain, glazes, 17, 8, lambda i, j:
        (LEFT + half + i * PITCH, half + j * PITCH, 0) if LEFT + (i + 1) * PITCH < SHOWER_LEFT + 0.03 else None)
    lay(scene, "left tiles", placed(plain, axis="y", angle=math.pi / 2), glazes, 19, 8,
        lambda i, j: (LEFT, half + j * PITCH, half + i * PITCH))
    lay(scene, "right tiles", placed(plain, axis="y", angle=-math.pi / 2), glazes, 19, 8, lambda i, j:
        (RIGHT, half + j * PITCH, half + i * PITCH) if outside_shower(RIGHT, i * PITCH) else None)
    lay(scene, "front tiles", placed(plain, axis="y", angle=math.pi), glazes, 17, 8, lambda i, j:
        (LEFT + half + i * PITCH, half + j * PITCH, FRONT) if not -0.46 < LEFT + half + i * PITCH < 0.56 else None)

    rail = scene.material("border", gloss((0.10, 0.28, 0.36), 0.2))
    strips = [tube([a, b], 0.016, 24, False) for a, b in (
        ((LEFT, DADO + 0.012, 0.002), (SHOWER_LEFT + 0.02, DADO + 0.012, 0.002)),
        ((LEFT + 0.002, DADO + 0.012, 0), (LEFT + 0.002, DADO + 0.012, FRONT)),
        ((RIGHT - 0.002, DADO + 0.012, SHOWER_FRONT), (RIGHT - 0.002, DADO + 0.012, FRONT)))]
    scene.add("border", joined(*strips), rail)


def add_shower_tiles(scene):
    """Glazes from sea green to deep blue, strewn; deeper towards the floor."""
    colors = ((0.30, 0.56, 0.58), (0.18, 0.46, 0.54), (0.11, 0.34, 0.48), (0.07, 0.24, 0.40), (0.42, 0.64, 0.62))
    glazes = [scene.material(f"sea glaze {k}", gloss(color, 0.22)) for k, color in enumerate(colors)]
    joints = scene.material("shower joints", diffuse((0.66, 0.66, 0.62)))
    small = tile(MOSAIC - 0.0025, 0.005, 0.0016)
    height = SHOWER_ROWS * MOSAIC
    scene.add("shower back", quad((SHOWER_LEFT, 0, 0.001), (RIGHT - SHOWER_LEFT, 0, 0), (0, height, 0)), joints)
    scene.add("shower side", quad((RIGHT - 0.001, 0, 0), (0, 0, SHOWER_FRONT), (0, height, 0)), joints)
    lay(scene, "shower back tiles", small, glazes, 15, SHOWER_ROWS,
        lambda i, j: (RIGHT - (i + 0.5) * MOSAIC, (j + 0.5) * MOSAIC, 0.001))
    lay(scene, "shower side tiles", placed(small, axis="y", angle=-math.pi / 2), glazes, 16, SHOWER_ROWS,
        lambda i, j: (RIGHT - 0.001, (j + 0.5) * MOSAIC, (i + 0.5) * MOSAIC))


def add_floor(scene):
    pitch = 0.2
    slate = [scene.material(f"slate {k}", gloss(color, 0.35)) for k, color in
             enumerate(((0.10, 0.12, 0.14), (0.13, 0.14, 0.15)))]
    cream = [scene.material(f"cream {k}", gloss(color, 0.35)) for k, color in
             enumerate(((0.70, 0.66, 0.58), (0.66, 0.62, 0.54)))]
    flat = placed(tile(pitch - 0.003, 0.004, 0.002), axis="x", angle=-math.pi / 2)
    for name, glazes, odd in (("dark floor tiles", slate, 0), ("light floor tiles", cream, 1)):
        lay(scene, name, flat, glazes, 13, 15, lambda i, j, odd=odd:
            (LEFT + (i + 0.5) * pitch, 0, (j + 0.5) * pitch) if (i + j) % 2 == odd else None)


def add_mat(scene):
    """A bath mat of tufts."""
    cotton = [scene.material(f"cotton {k}", diffuse(color)) for k, color in
              enumerate(((0.72, 0.42, 0.33), (0.76, 0.47, 0.37)))]
    scene.add("mat", placed(rounded_box((0.84, 0.008, 0.50), 0.003, 2), (-0.15, 0.009, 0.46)), cotton[0])
    tuft = geodesic_sphere(2)
    tuft = Mesh([(0.0115 * x, 0.013 * y, 0.0115 * z) for x, y, z in tuft.positions], tuft.triangles, tuft.normals)
    lay(scene, "tufts", tuft, cotton, 40, 27, lambda i, j: (
        -0.555 + 0.0203 * (i + 0.5 * (j % 2)) + 0.004 * (hashed(i, j, 1) - 0.5), 0.013 + 0.004 * hashed(i, j, 2),
        0.226 + 0.0178 * j + 0.004 * (hashed(i, j, 3) - 0.5)))


def add_door(scene):
    """In the wall behind the eye; the mirror shows it."""
    wood = scene.material("door", gloss((0.42, 0.25, 0.13), 0.3))
    inlay = scene.material("door panels", gloss((0.50, 0.31, 0.17), 0.3))
    brass = scene.material("brass", metal((0.91, 0.72, 0.40)))
    z = FRONT - 0.02
    parts = [placed(rounded_box((0.86, 2.04, 0.03), 0.004, 2), (0.05, 1.02, z))]
    for x in (-0.41, 0.51):
        parts.append(placed(rounded_box((0.07, 2.1, 0.05), 0.008, 2), (x, 1.05, z)))
    parts.append(placed(rounded_box((0.99, 0.07, 0.05), 0.008, 2), (0.05, 2.10, z)))
    scene.add("door", joined(*parts), wood)
    panels = [placed(rounded_box((0.30, height, 0.03), 0.012, 3), (0.05 + x, y, z - 0.012))
              for x in (-0.19, 0.19) for y, height in ((0.50, 0.70), (1.42, 0.88))]
    scene.add("door panels", joined(*panels), inlay)
    knob = spun([(0.026, 0.0), (0.026, 0.006), (0.010, 0.012), (0.010, 0.03), (0.026, 0.044), (0.024, 0.062),
                          (0, 0.066)], 0.006, 48)
    scene.add("knob", placed(knob, (0.40, 0.98, z - 0.015), "x", -math.pi / 2), brass)
