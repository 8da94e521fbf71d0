"""What hangs and stands in the bathroom: lamps, mirror, washbasin, taps and pipes, shower, towel, small things.
Coordinates are those of bathroom_room.py."""

import math

from bathroom_room import RIGHT, SHOWER_FRONT, SHOWER_LEFT, gloss
from gltf_builder import diffuse, geodesic_sphere, light
from shapes import broken, joined, patch, placed, rounded_box, scaled, shell, spline, spun, tube

BASIN_X, BASIN_Z, BASIN_RIM = -0.15, 0.275, 0.868
HAIR = 0.001                     # glass floats this far from everything

TUBE_RADIUS, TUBE_WALL, TUBE_LENGTH = 0.036, 0.0045, 0.26
BUMPS_AROUND, BUMPS_ALONG, BUMP = 12, 14, 0.0008
BULB = 0.009


def add_lamps(scene, chrome, glass):
    """Two bumpy glass tubes beside the mirror, a small sphere of light in each."""
    def outer(u, v):
        calm = min(1.0, 12 * min(v, 1 - v))
        a = 2 * math.pi * u
        r = TUBE_RADIUS + BUMP * calm * math.cos(BUMPS_AROUND * a) * math.cos(math.pi * BUMPS_ALONG * v)
        return r * math.sin(a), TUBE_LENGTH * (v - 0.5), r * math.cos(a)

    def inner(u, v):
        a = 2 * math.pi * u
        r = TUBE_RADIUS - TUBE_WALL
        return r * math.sin(a), TUBE_LENGTH * (v - 0.5), r * math.cos(a)
    bumpy = shell(outer, inner, 168, 168)
    top = TUBE_LENGTH / 2
    r = TUBE_RADIUS
    cap = spun([(0, top + HAIR), (r + 0.0015, top + HAIR), (r + 0.0015, top - 0.010), (r + 0.004, top - 0.010),
                         (r + 0.004, top + 0.006), (0.016, top + 0.018), (0, top + 0.020)], 0.003, 72)
    stem = tube([(0, -top, 0), (0, -BULB - 0.001, 0)], 0.003, 20)
    arm = broken([(0, -top - 0.014, 0), (0, -top - 0.05, 0), (0, -top - 0.05, -0.145)], 0.03, 8)
    rose = wall_rose(0.030)
    metal = joined(cap, placed(cap, axis="x", angle=math.pi), stem, tube(arm, 0.008, 24),
                   placed(rose, (0, -top - 0.05, -0.135)))
    bulb = geodesic_sphere(6)
    shine = scene.material("light", light((1.0, 0.86, 0.66), 3000))
    for side, x in (("left", -0.66), ("right", 0.36)):
        place = (x, 1.56, 0.14)
        scene.add(f"{side} lamp, metal", metal, chrome, place)
        scene.add(f"{side} lamp, glass", bumpy, glass, place)
        scene.add(f"{side} lamp, light", bulb, shine, place, BULB)


def wall_rose(radius):
    """The disc that hides where a pipe enters a wall, which it faces away from (+z)."""
    disc = spun([(radius, 0), (radius, 0.006), (0.5 * radius, 0.015), (0, 0.015)], 0.004, 48)
    return placed(disc, axis="x", angle=math.pi / 2)


def add_mirror(scene, chrome, silver, glass):
    width, low, high = 0.78, 1.13, 1.88
    middle, half = (low + high) / 2, (high - low) / 2
    scene.add("mirror", rounded_box((width, high - low, 0.006), 0.0025, 2), silver, (BASIN_X, middle, 0.030))
    side = width / 2
    frame = broken([(-side, 0), (-side, half), (side, half), (side, -half), (-side, -half), (-side, 0)], 0.02)
    scene.add("mirror frame", tube([(x, y, 0) for x, y in frame], 0.007, 16), chrome, (BASIN_X, middle, 0.030))
    # A shelf of glass on two brackets.
    scene.add("shelf", rounded_box((0.70, 0.008, 0.11), 0.003, 3), glass, (BASIN_X, 1.060, 0.075))
    brackets = [placed(spun([(0, 0), (0.009, 0), (0.009, 0.115), (0, 0.118)], 0.003, 24),
                       (BASIN_X + x, 1.060 - 0.004 - 0.010, 0.002), "x", math.pi / 2) for x in (-0.29, 0.29)]
    scene.add("brackets", joined(*brackets), chrome)


def add_basin(scene, chrome):
    china = scene.material("china", gloss((0.84, 0.84, 0.82), 0.15))
    profile = spline([(0, 0.688, 0), (0.42, 0.692, 0), (0.70, 0.715, 0), (0.90, 0.775, 0), (0.985, 0.832, 0),
                      (1.0, 0.853, 0), (0.988, 0.866, 0), (0.955, BASIN_RIM, 0), (0.86, BASIN_RIM, 0.016),
                      (0.80, 0.864, 0.028), (0.755, 0.848, 0.034), (0.70, 0.810, 0.036), (0.58, 0.760, 0.036),
                      (0.36, 0.734, 0.036), (0.16, 0.727, 0.036), (0, 0.725, 0.036)])

    def point(u, v):
        s, y, forwards = profile(v)
        a = 2 * math.pi * u
        x, z = math.sin(a), math.cos(a)
        round_off = (abs(x) ** 2.8 + abs(z) ** 2.8) ** (-1 / 2.8)
        return BASIN_X + 0.31 * s * round_off * x, y, BASIN_Z + 0.235 * s * round_off * z + forwards
    scene.add("basin", patch(point, 144, 96, True), china)
    drain = spun([(0.024, 0), (0.024, 0.003), (0.018, 0.004), (0.017, 0.002), (0, 0.005)], 0.001, 48)
    scene.add("drain", drain, chrome, (BASIN_X, 0.7262, BASIN_Z + 0.036))


def add_tap(scene, chrome):
    """A spout and two cross handles on the basin's rim, and the pipes beneath."""
    y, z = BASIN_RIM, 0.085
    foot = spun([(0.026, -0.002), (0.026, 0.006), (0.015, 0.016), (0.014, 0.05), (0.010, 0.056), (0, 0.056)], 0.005, 48)
    spout = broken([(0, 0.03, 0), (0, 0.15, 0), (0, 0.15, 0.145), (0, 0.105, 0.145)], 0.062, 16)
    parts = [placed(foot, (BASIN_X, y, z)), placed(tube(spout, 0.0105, 28), (BASIN_X, y, z))]
    ball = scaled(geodesic_sphere(5), 0.0085)
    for side in (-1, 1):
        x = BASIN_X + side * 0.105
        parts.append(placed(foot, (x, y, z)))
        for k in range(2):
            a = math.pi / 2 * k + 0.4 * side
            reach = (0.030 * math.cos(a), 0, 0.030 * math.sin(a))
            ends = [[x + t * reach[0], y + 0.064, z + t * reach[2]] for t in (-1, 1)]
            parts.append(tube([tuple(e) for e in ends], 0.0055, 16))
            parts += [placed(ball, e) for e in ends]
        hub = spun([(0, 0.050), (0.010, 0.052), (0.012, 0.064), (0.009, 0.076), (0, 0.078)], 0.004, 32)
        parts.append(placed(hub, (x, y, z)))
    scene.add("tap", joined(*parts), chrome)

    trap_z = BASIN_Z + 0.036
    rose = wall_rose(0.032)
    trap = [tube([(BASIN_X, 0.70, trap_z), (BASIN_X, 0.57, trap_z)], 0.016, 32),
            placed(spun([(0, 0.42), (0.026, 0.42), (0.034, 0.43), (0.034, 0.545), (0.022, 0.57), (0.019, 0.60),
                                  (0.019, 0.62), (0, 0.62)], 0.008, 64), (BASIN_X, 0, trap_z)),
            tube(broken([(BASIN_X, 0.525, trap_z - 0.02), (BASIN_X, 0.525, trap_z - 0.12), (BASIN_X, 0.525, 0)], 0.02),
                 0.016, 32), placed(rose, (BASIN_X, 0.525, 0.006))]
    for side in (-1, 1):
        x = BASIN_X + 0.14 * side
        trap.append(placed(rose, (x, 0.46, 0.006)))
        trap.append(tube([(x, 0.46, 0), (x, 0.46, 0.085)], 0.009, 24))
        knob = spun([(0, 0), (0.016, 0), (0.017, 0.008), (0.016, 0.022), (0, 0.024)], 0.003, 32)
        trap.append(placed(knob, (x, 0.46, 0.085), "x", math.pi / 2))
        bend = spline([(x, 0.46, 0.06), (x, 0.52, 0.06), (x - 0.02 * side, 0.60, 0.09), (x - 0.05 * side, 0.66, 0.13),
                       (x - 0.06 * side, 0.72, 0.14)])
        trap.append(tube([bend(k / 40) for k in range(41)], 0.007, 20))
    scene.add("pipes", joined(*trap), chrome)


def add_towel_warmer(scene, chrome):
    left, right, low, high, z = -1.13, -0.77, 0.62, 1.80, 0.085
    pipes = []
    for x in (left, right):
        pipes.append(tube([(x, low, z), (x, high, z)], 0.015, 32))
        for y in (low + 0.08, high - 0.08):
            pipes.append(tube([(x, y, 0), (x, y, z)], 0.010, 20))
    for y in [0.70 + 0.062 * k for k in (0, 1, 2, 4, 5, 6, 7, 9, 10, 11, 12, 14, 15, 16)]:
        pipes.append(tube([(left, y, z), (right, y, z)], 0.010, 24))
    scene.add("towel warmer", joined(*pipes), chrome)

    # A towel over the bar at 1.506 m, folded once lengthwise: two cloths that follow each other.
    bar, radius = 0.70 + 0.062 * 13, 0.017
    scene.add("towel bar", tube([(left, bar - 0.002, z + 0.02), (right, bar - 0.002, z + 0.02)], 0.011, 24), chrome)
    cotton = scene.material("towel", diffuse((0.74, 0.34, 0.24)))
    stripe = scene.material("towel, stripe", diffuse((0.86, 0.80, 0.68)))
    for thick, long in ((0.0, 0.50), (0.006, 0.42)):
        def point(u, v, thick=thick, long=long):
            r = radius + thick
            s = (v - 0.5) * 2 * long
            x = left + 0.045 + (right - left - 0.09) * u
            arc = r * math.pi / 2
            hang = max(0.0, abs(s) - arc)
            wave = (0.006 * math.sin(9 * u + 2) + 0.004 * math.sin(23 * u + 5 * v)) * min(1.0, hang / 0.25)
            turn = max(-1.0, min(1.0, s / arc)) * math.pi / 2
            across = r * math.sin(turn)
            return x, bar + r * math.cos(turn) - hang, z + 0.02 + across + wave * (1 if s > 0 else 0.3)
        scene.add("towel", patch(point, 120, 200), cotton)

    def band(u, v):
        along = 0.5 + (0.36 + 0.05 * v) / 0.84  # of the upper cloth at the same height
        wave = 0.006 * math.sin(9 * u + 2) + 0.004 * math.sin(23 * u + 5 * along)
        return left + 0.045 + (right - left - 0.09) * u, bar - 0.33 - 0.05 * v, z + 0.02 + radius + 0.0085 + wave
    scene.add("towel, stripe", patch(band, 120, 8), stripe)


def add_shower(scene, chrome, glass):
    white = scene.material("tray", gloss((0.82, 0.82, 0.80), 0.2))
    wide, deep = RIGHT - SHOWER_LEFT, SHOWER_FRONT
    scene.add("tray", placed(rounded_box((wide, 0.10, deep), 0.012, 4), (RIGHT - wide / 2, 0.05, deep / 2)), white)
    low, high, thick = 0.104, 2.00, 0.008
    x, z = SHOWER_LEFT + 0.025, SHOWER_FRONT - 0.025
    scene.add("shower screen", rounded_box((thick, high - low, z - 0.035), 0.002, 3), glass,
              (x, (high + low) / 2, 0.012 + (z - 0.035) / 2))
    scene.add("shower door", rounded_box((RIGHT - x - 0.035, high - low, thick), 0.002, 3), glass,
              (x + 0.022 + (RIGHT - x - 0.035) / 2, (high + low) / 2, z))
    rails = [placed(rounded_box((0.022, 0.022, z + 0.01), 0.004, 2), (x, high + 0.0125, (z + 0.01) / 2)),
             placed(rounded_box((RIGHT - x, 0.022, 0.022), 0.004, 2), ((RIGHT + x) / 2, high + 0.0125, z)),
             tube([(x, 0.09, z), (x, high + 0.012, z)], 0.012, 28)]
    grip = broken([(0, -0.16, 0), (0, -0.16, 0.05), (0, 0.16, 0.05), (0, 0.16, 0)], 0.02, 8)
    rails.append(placed(tube(grip, 0.009, 24), (x + 0.12, 1.05, z + thick / 2 + HAIR)))
    scene.add("shower rails", joined(*rails), chrome)

    # Riser, head, mixer, and a hand shower on its hose.
    rx, rz = 1.02, 0.075
    riser = broken([(rx, 1.02, rz), (rx, 2.12, rz), (rx, 2.12, 0.40), (rx, 2.06, 0.40)], 0.06, 12)
    head = spun([(0, -0.014), (0.10, -0.014), (0.104, -0.006), (0.09, 0.004), (0.03, 0.012), (0.018, 0.03), (0, 0.03)],
                0.004, 72)
    rose = wall_rose(0.034)
    parts = [tube(riser, 0.011, 28), placed(head, (rx, 2.05, 0.40)),
             placed(spun([(0, -0.13), (0.026, -0.13), (0.028, -0.11), (0.024, -0.07), (0.024, 0.07), (0.028, 0.11),
                                   (0.026, 0.13), (0, 0.13)], 0.006, 56), (rx, 1.02, rz), "z", math.pi / 2),
             placed(rose, (rx - 0.075, 1.02, 0.006)), placed(rose, (rx + 0.075, 1.02, 0.006))]
    for dx in (-0.075, 0.075):
        parts.append(tube([(rx + dx, 1.02, 0), (rx + dx, 1.02, rz)], 0.014, 24))
    parts += [tube([(rx, 1.80, 0), (rx, 1.80, rz)], 0.009, 20), placed(rose, (rx, 1.80, 0.006))]
    hose = spline([(rx - 0.03, 1.00, rz + 0.01), (rx - 0.05, 0.82, rz + 0.03), (rx - 0.14, 0.60, rz + 0.05),
                   (rx - 0.25, 0.66, rz + 0.05), (rx - 0.25, 0.95, rz + 0.03), (rx - 0.22, 1.30, rz + 0.03),
                   (rx - 0.19, 1.52, rz + 0.05)])
    parts.append(tube([hose(k / 120) for k in range(121)], 0.007, 18))
    parts.append(tube(broken([(rx - 0.19, 1.50, rz + 0.045), (rx - 0.185, 1.66, rz + 0.09)], 0.01), 0.013, 24))
    parts.append(placed(placed(spun([(0, -0.012), (0.045, -0.012), (0.048, 0), (0.03, 0.012), (0, 0.016)], 0.004, 56),
                               axis="x", angle=-0.9), (rx - 0.183, 1.685, rz + 0.105)))
    parts.append(tube([(rx - 0.19, 1.53, 0), (rx - 0.19, 1.53, rz + 0.045)], 0.010, 20))
    parts.append(placed(rose, (rx - 0.19, 1.53, 0.006)))
    scene.add("shower", joined(*parts), chrome)


def add_small_things(scene, chrome, glass):
    top = 1.064 + HAIR
    tumbler = spun([(0, 0), (0.030, 0), (0.034, 0.095), (0.0315, 0.095), (0.028, 0.010), (0, 0.010)], 0.0012, 96, 4)
    scene.add("tumbler", tumbler, glass, (BASIN_X - 0.19, top, 0.075))
    for k, (color, lean, turn) in enumerate((((0.75, 0.14, 0.10), 0.016, 0.4), ((0.10, 0.36, 0.62), 0.016, 2.6))):
        dx, dz = lean * math.cos(turn), lean * math.sin(turn)
        x, z = BASIN_X - 0.19, 0.075
        foot, tip = (x - dx, top + 0.014, z - dz), (x + 1.6 * dx, top + 0.165, z + 1.6 * dz)
        scene.add("toothbrush", tube([foot, tip], 0.0035, 16), scene.material(f"toothbrush {k}", gloss(color, 0.2)))
        bristles = rounded_box((0.008, 0.024, 0.012), 0.002, 2)
        scene.add("bristles", bristles, scene.material(f"bristles {k}", diffuse((0.85, 0.85, 0.82))),
                  (tip[0], tip[1] - 0.014, tip[2] + 0.008))
    bottle = spun([(0, 0), (0.032, 0), (0.034, 0.02), (0.033, 0.09), (0.014, 0.112), (0.012, 0.122), (0, 0.122)],
                  0.008, 64)
    green = scene.material("soap bottle", gloss((0.12, 0.34, 0.32), 0.12))
    scene.add("soap bottle", bottle, green, (BASIN_X + 0.17, top, 0.075))
    pump = [tube([(0, 0.12, 0), (0, 0.155, 0)], 0.004, 16),
            spun([(0, 0.122), (0.013, 0.122), (0.013, 0.132), (0, 0.134)], 0.002, 32),
            tube(broken([(0, 0.152, -0.008), (0, 0.155, 0.03), (0, 0.146, 0.036)], 0.008), 0.0045, 16)]
    scene.add("pump", joined(*pump), chrome, (BASIN_X + 0.17, top, 0.075))
    soap = scene.material("soap", diffuse((0.80, 0.72, 0.48)))
    scene.add("soap", rounded_box((0.075, 0.024, 0.05), 0.010, 5), soap, (BASIN_X + 0.225, BASIN_RIM + 0.012, 0.12))
