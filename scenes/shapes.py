"""Curved shapes as triangles: patches of functions, revolved and swept curves, shells, rounded boxes.

Lengths are metres, angles radians, y is up. Triangles run counter-clockwise seen from the front, which closed
shapes have outside. Where a shape closes on itself its corners are shared, so that glass has no gaps.
"""

import math

from gltf_builder import Mesh, cross, normalized

STEP = 1e-5  # of a parameter in [0,1], for derivatives


def patch(point, columns, rows, around=False, along=False, coordinates=None):
    """The surface point(u, v), u and v in [0,1], with the front towards du x dv and smooth normals. `around`:
    u = 1 is u = 0; `along`: the same of v. `coordinates`: (u, v) -> those of the texture. A row that is one
    point (a pole) gets its neighbours' mean normal."""
    wide, high = columns + (not around), rows + (not along)
    positions, normals, uvs = [], [], []
    for j in range(high):
        v = j / rows
        for i in range(wide):
            u = i / columns
            positions.append(tuple(point(u, v)))
            normals.append(_normal(point, u, v, around, along))
            if coordinates:
                uvs.append(tuple(coordinates(u, v)))
    poles = {}
    for j in {0, high - 1} if not along else ():
        row = positions[j * wide:(j + 1) * wide]
        if max(math.dist(row[0], p) for p in row) < 1e-9:
            inner = 1 if j == 0 else high - 2
            normal = normalized([sum(n[axis] for n in normals[inner * wide:(inner + 1) * wide]) for axis in range(3)])
            for i in range(wide):
                positions[j * wide + i], normals[j * wide + i] = row[0], normal
            poles[j] = True
    triangles = []
    for j in range(rows):
        below, above = j * wide, (j + 1) % high * wide
        for i in range(columns):
            k = (i + 1) % wide
            a, b, c, d = below + i, below + k, above + k, above + i
            if j not in poles:
                triangles.append((a, b, c))
            if (j + 1) % high not in poles:
                triangles.append((a, c, d))
    return Mesh(positions, triangles, normals, uvs)


def _normal(point, u, v, around, along):
    def ends(t, closed):
        return (t - STEP, t + STEP) if closed else (max(0.0, t - STEP), min(1.0, t + STEP))
    (u0, u1), (v0, v1) = ends(u, around), ends(v, along)
    du = [b - a for a, b in zip(point(u0, v), point(u1, v))]
    dv = [b - a for a, b in zip(point(u, v0), point(u, v1))]
    normal = cross(du, dv)
    return normalized(normal) if max(map(abs, normal)) > 1e-24 else (0.0, 1.0, 0.0)


def reversed_mesh(mesh):
    """With its front where its back was."""
    return Mesh(mesh.positions, [(a, c, b) for a, b, c in mesh.triangles],
                [tuple(-x for x in n) for n in mesh.normals], mesh.coordinates)


def joined(*meshes):
    """One mesh of all, each keeping its own corners. Either all or none have normals, and texture coordinates."""
    positions, triangles, normals, coordinates = [], [], [], []
    for mesh in meshes:
        first = len(positions)
        positions += mesh.positions
        normals += mesh.normals
        coordinates += mesh.coordinates
        triangles += [(a + first, b + first, c + first) for a, b, c in mesh.triangles]
    return Mesh(positions, triangles, normals, coordinates)


def welded(mesh):
    """Corners that agree in place and normal become one."""
    index, order, renumbered = {}, [], []
    for k, (p, n) in enumerate(zip(mesh.positions, mesh.normals)):
        key = tuple(round(x, 9) + 0.0 for x in (*p, *n))
        if key not in index:
            index[key] = len(order)
            order.append(k)
        renumbered.append(index[key])
    return Mesh([mesh.positions[k] for k in order], [tuple(renumbered[k] for k in t) for t in mesh.triangles],
                [mesh.normals[k] for k in order])


def placed(mesh, offset=(0, 0, 0), axis=None, angle=0.0):
    """Turned about a coordinate axis ('x', 'y' or 'z') through the origin, then moved."""
    def turn(p):
        if axis is None:
            return p
        a = "xyz".index(axis)
        b, c = (a + 1) % 3, (a + 2) % 3
        turned = [0.0] * 3
        turned[a] = p[a]
        turned[b] = math.cos(angle) * p[b] - math.sin(angle) * p[c]
        turned[c] = math.sin(angle) * p[b] + math.cos(angle) * p[c]
        return tuple(turned)
    return Mesh([tuple(x + o for x, o in zip(turn(p), offset)) for p in mesh.positions], mesh.triangles,
                [turn(n) for n in mesh.normals], mesh.coordinates)


def scaled(mesh, scale):
    return Mesh([tuple(scale * x for x in p) for p in mesh.positions], mesh.triangles, mesh.normals, mesh.coordinates)


def spline(points, closed=False):
    """A smooth curve through points of any dimension, t in [0,1] -> point (Catmull-Rom, evenly in t)."""
    count = len(points) if closed else len(points) - 1

    def at(k):
        if closed:
            return points[k % len(points)]
        if k < 0:
            return [2 * a - b for a, b in zip(points[0], points[1])]
        if k >= len(points):
            return [2 * a - b for a, b in zip(points[-1], points[-2])]
        return points[k]

    def curve(t):
        k = min(int(math.floor(t * count)), count - 1) if not closed else int(math.floor(t * count))
        s = t * count - k
        return tuple(b + 0.5 * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)))
                     for a, b, c, d in zip(at(k - 1), at(k), at(k + 1), at(k + 2)))
    return curve


def broken(points, bend, steps=6):
    """The way from point to point with its corners rounded: arcs that begin `bend` before each corner (less where
    there is no room). A list of points for `tube` or `turned`; of any dimension."""
    way = [tuple(points[0])]
    for before, corner, after in zip(points, points[1:], points[2:]):
        room = min(bend, math.dist(before, corner) / 2, math.dist(corner, after) / 2)
        start = [c + (b - c) * room / math.dist(before, corner) for b, c in zip(before, corner)]
        end = [c + (a - c) * room / math.dist(after, corner) for a, c in zip(after, corner)]
        for k in range(steps + 1):
            t = k / steps
            way.append(tuple((1 - t) ** 2 * s + 2 * t * (1 - t) * c + t * t * e for s, c, e in zip(start, corner, end)))
    way.append(tuple(points[-1]))
    return [p for k, p in enumerate(way) if k == 0 or math.dist(p, way[k - 1]) > 1e-9]


def turned(profile, segments):
    """Revolves a smooth way of points (radius, y) about the y axis; the front is to the right of the way (radius
    rightwards, y upwards). Ends at radius 0 are poles."""
    slopes = []
    for k in range(len(profile)):
        (r0, y0), (r1, y1) = profile[max(k - 1, 0)], profile[min(k + 1, len(profile) - 1)]
        length = math.hypot(r1 - r0, y1 - y0)
        slopes.append(((y1 - y0) / length, (r0 - r1) / length))
    positions, normals, triangles, rings = [], [], [], []
    for (r, y), (radial, vertical) in zip(profile, slopes):
        first, count = len(positions), segments if r > 0 else 1
        rings.append((first, count))
        for k in range(count):
            s, c = math.sin(2 * math.pi * k / segments), math.cos(2 * math.pi * k / segments)
            positions.append((r * s, y, r * c))
            normals.append((radial * s, vertical, radial * c) if r > 0 else (0.0, math.copysign(1.0, vertical), 0.0))
    for (lower, m), (upper, n) in zip(rings, rings[1:]):
        for k in range(segments):
            l = (k + 1) % segments
            a, b, c, d = lower + k % m, lower + l % m, upper + l % n, upper + k % n
            if m > 1:
                triangles.append((a, b, c))
            if n > 1:
                triangles.append((a, c, d))
    return Mesh(positions, triangles, normals)


def spun(points, bend, segments, steps=6):
    """`turned` of a way whose corners are rounded."""
    return turned(broken(points, bend, steps), segments)


def shell(outer, inner, columns, rows):
    """The solid between two surfaces of revolution-like patches (around in u, front outside), closed by a rim at
    each end: the wall of a vessel without bottom."""
    def rim(v):
        return patch(lambda u, t: [a * (1 - t) + b * t for a, b in zip(outer(u, v), inner(u, v))], columns, 1, True)
    return joined(patch(outer, columns, rows, True), reversed_mesh(patch(inner, columns, rows, True)),
                  reversed_mesh(rim(0)), rim(1))


def tube(way, radius, segments, caps=True):
    """A round pipe along a list of points, its ends closed by flat discs if `caps`."""
    ahead = []
    for k in range(len(way)):
        a, b = way[max(k - 1, 0)], way[min(k + 1, len(way) - 1)]
        ahead.append(normalized([y - x for x, y in zip(a, b)]))
    least = min(range(3), key=lambda axis: abs(ahead[0][axis]))
    side = normalized(cross(ahead[0], [float(axis == least) for axis in range(3)]))
    positions, normals, triangles = [], [], []
    for k, (p, t) in enumerate(zip(way, ahead)):
        along = sum(a * b for a, b in zip(side, t))
        side = normalized([s - along * x for s, x in zip(side, t)])
        up = cross(t, side)
        for i in range(segments):
            c, s = math.cos(2 * math.pi * i / segments), math.sin(2 * math.pi * i / segments)
            n = tuple(c * a + s * b for a, b in zip(side, up))
            positions.append(tuple(x + radius * y for x, y in zip(p, n)))
            normals.append(n)
            if k > 0:
                a, b = (k - 1) * segments + i, (k - 1) * segments + (i + 1) % segments
                triangles += [(a, b, b + segments), (a, b + segments, a + segments)]
    for ring, direction in ((0, -1), (len(way) - 1, 1)) if caps else ():
        first, rim = len(positions), positions[ring * segments:(ring + 1) * segments]
        positions += [way[ring], *rim]
        normals += [tuple(direction * x for x in ahead[ring])] * (segments + 1)
        for i in range(segments):
            a, b = first + 1 + i, first + 1 + (i + 1) % segments
            triangles.append((first, a, b) if direction > 0 else (first, b, a))
    return Mesh(positions, triangles, normals)


def rounded_box(size, radius, steps=4):
    """A box about the origin, edges and corners rounded."""
    half = [s / 2 - radius for s in size]
    bends = [math.tan(math.pi / 4 * k / steps) for k in range(steps + 1)]
    lines = [(-b, -1) for b in reversed(bends)] + [(b, 1) for b in bends]
    sides = []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            positions, normals, triangles = [], [], []
            for tv, sv in lines:
                for tu, su in lines:
                    n, core = [0.0] * 3, [0.0] * 3
                    n[axis], n[u], n[v] = float(sign), tu, tv
                    core[axis], core[u], core[v] = sign * half[axis], su * half[u], sv * half[v]
                    n = normalized(n)
                    positions.append(tuple(c + radius * x for c, x in zip(core, n)))
                    normals.append(n)
            wide = len(lines)
            for j in range(wide - 1):
                for i in range(wide - 1):
                    a, b, c, d = (j * wide + i, j * wide + i + 1, (j + 1) * wide + i + 1, (j + 1) * wide + i)
                    triangles += [(a, b, c), (a, c, d)] if sign > 0 else [(a, c, b), (a, d, c)]
            sides.append(Mesh(positions, triangles, normals))
    return welded(joined(*sides))


def torus(ring, pipe, columns, rows):
    """About the y axis; `ring` from the axis to the middle of the pipe, whose radius is `pipe`."""
    def point(u, v):
        a, b = 2 * math.pi * u, 2 * math.pi * v
        r = ring + pipe * math.cos(b)
        return r * math.sin(a), pipe * math.sin(b), r * math.cos(a)
    return patch(point, columns, rows, True, True)
