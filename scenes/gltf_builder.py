"""A small writer of glTF scenes: meshes, materials, a camera, and the .glb file. Standard library only.

The same calls write the same bytes. Lengths are metres, angles radians, y is up, emission is radiance in
W/(m^2 sr). Triangles run counter-clockwise seen from the front.
"""

import json
import math
import struct


class Mesh:
    """Triangles by index; `normals` is empty (flat shading) or holds one unit vector per position, `coordinates`
    (of textures; v downwards) likewise."""

    def __init__(self, positions, triangles, normals=(), coordinates=()):
        self.positions, self.triangles = positions, triangles
        self.normals, self.coordinates = normals, coordinates


def normalized(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _check_solid(name, mesh):
    """Glass must be closed, with its front outside: every edge is passed once in each direction, and the volume that
    the triangles enclose is positive."""
    edges = set()
    volume = 0.0
    for triangle in mesh.triangles:
        a, b, c = (tuple(mesh.positions[k]) for k in triangle)
        edges |= {(a, b), (b, c), (c, a)}
        volume += sum(x * y for x, y in zip(a, cross(b, c)))
    if len(edges) != 3 * len(mesh.triangles) or any((b, a) not in edges for a, b in edges) or volume <= 0:
        raise ValueError(f"{name}: no closed solid with its front outside")


def _box(positions):
    """The centre of their bounding box and half its longest edge."""
    least, most = [min(axis) for axis in zip(*positions)], [max(axis) for axis in zip(*positions)]
    return tuple((a + b) / 2 for a, b in zip(least, most)), max(b - a for a, b in zip(least, most)) / 2


def quad(corner, edge_u, edge_v):
    """A parallelogram with its front towards edge_u x edge_v."""
    def at(u, v):
        return tuple(c + u * a + v * b for c, a, b in zip(corner, edge_u, edge_v))
    return Mesh([at(0, 0), at(1, 0), at(1, 1), at(0, 1)], [(0, 1, 2), (0, 2, 3)])


def geodesic_sphere(frequency, smooth=True):
    """The unit sphere in 20 * frequency^2 nearly equal triangles: an icosahedron whose edges are cut into
    `frequency` parts and pushed outwards. Smooth normals are the sphere's own."""
    golden = (1 + math.sqrt(5)) / 2
    shape = [(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)]
    shape = [normalized(p[i:] + p[:i]) for i in range(3) for p in shape]
    near = 1.1 * min(math.dist(shape[0], p) for p in shape[1:])
    faces = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                p, q, r = shape[a], shape[b], shape[c]
                if max(math.dist(p, q), math.dist(q, r), math.dist(r, p)) < near:
                    outwards = sum(x * y for x, y in zip(p, cross(q, r))) > 0
                    faces.append((p, q, r) if outwards else (p, r, q))

    positions, triangles, index = [], [], {}

    def vertex(face, i, j):
        weights = (frequency - i - j, i, j)
        p = normalized([sum(w * corner[axis] for w, corner in zip(weights, face)) for axis in range(3)])
        key = tuple(round(x, 9) + 0.0 for x in p)  # + 0.0: no negative zero
        if key not in index:
            index[key] = len(positions)
            positions.append(p)
        return index[key]

    for face in faces:
        for i in range(frequency):
            for j in range(frequency - i):
                a, b, c = vertex(face, i, j), vertex(face, i + 1, j), vertex(face, i, j + 1)
                triangles.append((a, b, c))
                if i + j < frequency - 1:
                    triangles.append((b, vertex(face, i + 1, j + 1), c))
    return Mesh(positions, triangles, positions if smooth else ())


def lathe(profile, segments):
    """Revolves straight pieces about the y axis: `profile` is a list of (radius, y). Smooth around, sharp between
    the pieces; the front is to the right of the way from one point to the next (radius rightwards, y upwards)."""
    positions, normals, triangles = [], [], []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        length = math.hypot(r1 - r0, y1 - y0)
        radial, vertical = (y1 - y0) / length, (r0 - r1) / length
        first = len(positions)
        for k in range(segments):
            s, c = math.sin(2 * math.pi * k / segments), math.cos(2 * math.pi * k / segments)
            positions += [(r0 * s, y0, r0 * c), (r1 * s, y1, r1 * c)]
            normals += [(radial * s, vertical, radial * c)] * 2
            a, b = first + 2 * k, first + 2 * ((k + 1) % segments)
            if r0 > 0:
                triangles.append((a, b, b + 1) if r1 > 0 else (a, b, a + 1))
            if r1 > 0:
                triangles.append((a, b + 1, a + 1))
    return Mesh(positions, triangles, normals)


def diffuse(color):
    """A Lambertian surface."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0},
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}


def metal(color, roughness=0):
    """Roughness 0 is a perfect mirror."""
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 1,
                                     "roughnessFactor": roughness}}


def glass(ior):
    """A clear solid with smooth sides."""
    return {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                           "KHR_materials_ior": {"ior": ior},
                           "KHR_materials_volume": {"thicknessFactor": 1}}}


def light(color, radiance):
    """Emits `color` (in [0,1] per channel) times `radiance` and reflects nothing."""
    material = diffuse((0, 0, 0))
    material["emissiveFactor"] = list(color)
    material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": radiance}
    return material


class Scene:
    """Collects objects, each one a node with a mesh of its own, and writes them. With `quantized` positions and
    normals are stored in 16 bits an axis (KHR_mesh_quantization) and indices, where they fit, in 16."""

    def __init__(self, purpose, quantized=False):
        self.document = {
            "asset": {"version": "2.0", "extras": {"purpose": purpose}},
            "scene": 0, "scenes": [{"nodes": []}], "extensionsUsed": [],
            "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [],
        }
        self.quantized = quantized
        if quantized:
            self.document["extensionsUsed"] = self.document["extensionsRequired"] = ["KHR_mesh_quantization"]
        self.binary = bytearray()
        self.triangles = 0
        self.stored = {}  # by id of a list of rows: the list, kept so that its id stays its own, and its accessor

    def material(self, name, material):
        """Returns the index that `add` wants."""
        self.document["materials"].append({"name": name, **material})
        used = set(self.document["extensionsUsed"]) | set(material.get("extensions", {}))
        self.document["extensionsUsed"] = sorted(used)
        return len(self.document["materials"]) - 1

    def texture(self, name, png):
        """Takes the bytes of a PNG and returns the index that a material's `..Texture` wants. It repeats."""
        self.document.setdefault("images", []).append(
            {"name": name, "mimeType": "image/png", "bufferView": self._view(png)})
        self.document.setdefault("samplers", [{"magFilter": 9729, "wrapS": 10497, "wrapT": 10497}])
        self.document.setdefault("textures", []).append(
            {"source": len(self.document["images"]) - 1, "sampler": 0})
        return len(self.document["textures"]) - 1

    def add(self, name, mesh, material, position=(0, 0, 0), scale=1, copies=()):
        """`copies`: places (x, y, z) relative to `position`; the mesh is then at each of them instead (by
        EXT_mesh_gpu_instancing)."""
        if "KHR_materials_volume" in self.document["materials"][material].get("extensions", {}):
            _check_solid(name, mesh)
        positions, centre, extent = mesh.positions, (0, 0, 0), 1
        if self.quantized:
            centre, extent = _box(positions)
        attributes = {"POSITION": self._accessor("VEC3", positions, (centre, extent))}
        if mesh.normals:
            attributes["NORMAL"] = self._accessor("VEC3", mesh.normals, ((0, 0, 0), 1))
        if mesh.coordinates:
            attributes["TEXCOORD_0"] = self._floats("VEC2", mesh.coordinates)
        primitive = {"attributes": attributes, "indices": self._indices(mesh.triangles, len(positions)),
                     "material": material}
        self.document["meshes"].append({"name": name, "primitives": [primitive]})
        node = {"name": name, "mesh": len(self.document["meshes"]) - 1}
        if copies:
            node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": self._instances(
                [tuple(p + scale * c for p, c in zip(place, centre)) for place in copies], scale * extent)}}
            self.document["extensionsUsed"] = sorted({*self.document["extensionsUsed"], "EXT_mesh_gpu_instancing"})
        else:
            position = tuple(p + scale * c for p, c in zip(position, centre))
            scale *= extent
        if position != (0, 0, 0):
            node["translation"] = list(position)
        if scale != 1 and not copies:
            node["scale"] = [scale] * 3
        self._node(node)
        self.triangles += len(mesh.triangles) * max(1, len(copies))

    def camera(self, name, eye, target, yfov, aspect):
        """`yfov` is the full vertical angle."""
        perspective = {"yfov": yfov, "aspectRatio": aspect, "znear": 0.01}
        self.document.setdefault("cameras", []).append(
            {"name": name, "type": "perspective", "perspective": perspective})
        back = normalized([e - t for e, t in zip(eye, target)])
        right = normalized(cross((0, 1, 0), back))
        axes = [*right, 0, *cross(back, right), 0, *back, 0, *eye, 1]
        self._node({"name": name, "camera": len(self.document["cameras"]) - 1,
                    "matrix": [round(x, 9) + 0.0 for x in axes]})

    def triangle_count(self):
        return self.triangles

    def write(self, path):
        self.binary += b"\0" * (-len(self.binary) % 4)
        text = json.dumps({**self.document, "buffers": [{"byteLength": len(self.binary)}]},
                          separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.binary)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)

    def _node(self, node):
        self.document["scenes"][0]["nodes"].append(len(self.document["nodes"]))
        self.document["nodes"].append(node)

    def _accessor(self, kind, rows, frame):
        """Vectors: floats, or with quantisation 16 bits an axis of what lies within `extent` of `centre`."""
        if not self.quantized:
            return self._floats(kind, rows)
        key = (id(rows), frame)
        if key in self.stored:
            return self.stored[key][1]
        centre, extent = frame
        numbers = [[round((x - c) / extent * 32767) for x, c in zip(row, centre)] for row in rows]
        data = b"".join(struct.pack("<4h", *row, 0) for row in numbers)
        accessor = {"bufferView": self._view(data, 34962, 8), "componentType": 5122, "normalized": True,
                    "count": len(rows), "type": kind,
                    "min": [min(column) for column in zip(*numbers)], "max": [max(column) for column in zip(*numbers)]}
        return self._append(key, rows, accessor)

    def _floats(self, kind, rows):
        if id(rows) in self.stored:
            return self.stored[id(rows)][1]
        width = len(rows[0])
        numbers = [x for row in rows for x in row]
        data = struct.pack(f"<{len(numbers)}f", *numbers)
        accessor = {"bufferView": self._view(data, 34962), "componentType": 5126, "count": len(rows), "type": kind}
        stored = struct.unpack(f"<{len(numbers)}f", data)
        accessor["min"] = [min(stored[axis::width]) for axis in range(width)]
        accessor["max"] = [max(stored[axis::width]) for axis in range(width)]
        return self._append(id(rows), rows, accessor)

    def _indices(self, triangles, vertices):
        if id(triangles) in self.stored:
            return self.stored[id(triangles)][1]
        numbers = [x for row in triangles for x in row]
        short = self.quantized and vertices < 65536
        data = struct.pack(f"<{len(numbers)}{'H' if short else 'I'}", *numbers)
        accessor = {"bufferView": self._view(data, 34963), "componentType": 5123 if short else 5125,
                    "count": len(numbers), "type": "SCALAR"}
        return self._append(id(triangles), triangles, accessor)

    def _instances(self, places, scale):
        scales = [(scale,) * 3] * len(places)
        return {"TRANSLATION": self._floats("VEC3", places), "SCALE": self._floats("VEC3", scales)}

    def _append(self, key, rows, accessor):
        """The same list is stored once, whatever number of objects use it."""
        self.document["accessors"].append(accessor)
        self.stored[key] = rows, len(self.document["accessors"]) - 1
        return self.stored[key][1]

    def _view(self, data, target=None, stride=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if stride:
            view["byteStride"] = stride
        if target:
            view["target"] = target
        self.document["bufferViews"].append(view)
        self.binary += data
        return len(self.document["bufferViews"]) - 1
