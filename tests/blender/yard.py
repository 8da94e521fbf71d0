"""Outdoors: an HDR world, sun, point and spot light, a posed armature, shape keys, a second scene in the file."""

import math
import os

import bmesh
import bpy
import numpy as np

import kit

VIEWS = ("yard", "gate", "annex")
WORLD_TURN = 40.0  # degrees, of the Mapping node about z
WORLD_STRENGTH = 0.7


def build(folder):
    ground()
    figures()
    lights()
    world(os.path.join(folder, "sky.hdr"))
    kit.look("yard", (0.5, -5.5, 2.2), (0, 0, 0.8), angle=50)
    kit.look("gate", (-4.5, -3.0, 1.2), (0.3, 0.2, 0.9), angle=40)
    annex()


def annex():
    """Another scene of the file: some of the objects, the point light, a black world, the camera at the gate."""
    made = bpy.data.scenes.new("annex")
    for name in ("ground", "rig", "bent column", "blob", "point", "gate"):
        made.collection.objects.link(bpy.data.objects[name])
    made.world = bpy.data.worlds["black"]
    made.camera = bpy.data.objects["gate"]


def ground():
    tiles = kit.lambert("ground")
    picture = kit.image("tiles", kit.checker(64, 2, (0.45, 0.5, 0.35), (0.7, 0.68, 0.6)))
    tiles["Base Color"] = tiles.texture(picture, "UVMap", (8, 8), nearest=True).outputs["Color"]
    kit.place("ground", kit.sheet("ground", (-8, -8, 0), (16, 0, 0), (0, 16, 0)), material=tiles)


def column(bm):
    bmesh.ops.create_cone(bm, cap_ends=True, segments=32, radius1=0.25, radius2=0.25, depth=2.0)
    bmesh.ops.translate(bm, verts=bm.verts, vec=(0, 0, 1))
    sides = [e for e in bm.edges if abs(e.verts[0].co.z - e.verts[1].co.z) > 1]
    bmesh.ops.subdivide_edges(bm, edges=sides, cuts=15)


def figures():
    # a column bent by an armature of two bones, in pose
    data = bpy.data.armatures.new("bones")
    rig = kit.place("rig", data, (-1.3, 0.3, 0), (0, 0, 25))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    low, high = data.edit_bones.new("low"), data.edit_bones.new("high")
    low.head, low.tail = (0, 0, 0), (0, 0, 1)
    high.head, high.tail, high.parent = (0, 0, 1), (0, 0, 2), low
    bpy.ops.object.mode_set(mode="OBJECT")
    bent = kit.place("bent column", kit.mesh_of("bent column", column),
                     material=kit.lambert("clay", (0.75, 0.4, 0.3)))
    bent.parent = rig
    weights = {name: bent.vertex_groups.new(name=name) for name in ("low", "high")}
    for vertex in bent.data.vertices:
        upper = min(max(vertex.co.z - 0.5, 0.0), 1.0)
        weights["low"].add([vertex.index], 1 - upper, "REPLACE")
        weights["high"].add([vertex.index], upper, "REPLACE")
    bent.modifiers.new("rig", "ARMATURE").object = rig
    pose = rig.pose.bones["high"]
    pose.rotation_mode = "XYZ"
    pose.rotation_euler = (math.radians(15), 0, math.radians(-50))
    rig.pose.bones["low"].scale = (1.2, 1.0, 0.8)

    # a ball with two shape keys in force
    blob = kit.place("blob", kit.sphere("blob"), (0.9, 0.6, 0.7), scale=(0.7, 0.7, 0.7),
                     material=kit.lambert("leaf", (0.3, 0.6, 0.25)))
    blob.shape_key_add(name="Basis")
    ripple, lean = blob.shape_key_add(name="ripple"), blob.shape_key_add(name="lean")
    for vertex, a, b in zip(blob.data.vertices, ripple.data, lean.data):
        x, y, z = vertex.co
        grown = 1 + 0.25 * math.sin(4 * math.atan2(y, x)) * (1 - z * z)
        a.co = (x * grown, y * grown, z)
        b.co = (x + 0.5 * z, y, z * 0.9)
    ripple.value, lean.value = 0.8, 0.4

    # a collection, instanced thrice, once mirrored, once stretched
    post = bpy.data.collections.new("post")
    shaft = bpy.data.objects.new("shaft", kit.cube("shaft"))
    shaft.scale, shaft.location = (0.2, 0.2, 1.0), (0, 0, 0.5)
    knob = bpy.data.objects.new("knob", kit.sphere("knob", 32, 16))
    knob.scale, knob.location = (0.18, 0.18, 0.18), (0.1, 0, 1.1)
    shaft.data.materials.append(kit.lambert("stone", (0.6, 0.6, 0.65)).data)
    brass = kit.Material("brass", base_color=(0.85, 0.65, 0.3), metallic=1.0, roughness=0.4)
    knob.data.materials.append(brass.data)
    for part in (shaft, knob):
        post.objects.link(part)
    for name, at, turn, scale in (("post 1", (2.2, -0.6, 0), (0, 0, 0), (1, 1, 1)),
                                  ("post 2", (2.6, 1.6, 0), (0, 0, 30), (-1, 1, 1.5)),
                                  ("post 3", (-0.2, -1.3, 0), (0, 0, -60), (1.6, 0.7, 0.6))):
        instance = kit.place(name, None, at, turn, scale)
        instance.instance_type, instance.instance_collection = "COLLECTION", post


def lights():
    kit.light("sun", "SUN", (0, 0, 5), 2.0, (1, 0.9, 0.75), target=(1.5, 1.2, 0))
    kit.light("point", "POINT", (0.2, -0.4, 1.3), 60.0, (0.4, 0.6, 1.0))
    kit.light("spot", "SPOT", (-2.5, -2.0, 3.0), 400.0, (1.0, 0.5, 0.3), target=(-0.4, -0.6, 0), cone=35.0)


def sky(width=128):
    """Radiance [height, width, 3] from the bottom: a gradient over the horizon, a bright broad patch, dim ground."""
    height = width // 2
    u = (np.arange(width) + 0.5) / width
    v = (np.arange(height) + 0.5) / height
    u, v = np.meshgrid(u, v)
    azimuth, elevation = 2 * math.pi * u, math.pi * (v - 0.5)
    up = np.clip(np.sin(elevation), 0, 1)
    radiance = np.stack([0.5 - 0.3 * up, 0.6 - 0.2 * up, 0.7 + 0.2 * up], axis=2)
    radiance[elevation < 0] = (0.12, 0.1, 0.08)
    towards = np.cos(elevation) * np.cos(azimuth - 1.0) * math.cos(0.6) + np.sin(elevation) * math.sin(0.6)
    radiance += np.exp((towards - 1) * 40)[:, :, None] * np.array([9.0, 6.0, 3.0])
    return radiance


def write_hdr(path, radiance):
    """Radiance's format, not packed; `radiance` from the bottom."""
    height, width, _ = radiance.shape
    _, exponent = np.frexp(radiance.max(axis=2))
    mantissas = np.floor(np.ldexp(radiance, 8 - exponent[:, :, None])).astype(np.uint8)
    texels = np.dstack([mantissas, (exponent + 128).astype(np.uint8)])
    with open(path, "wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode())
        file.write(texels[::-1].tobytes())


def world(path):
    """Blender looks its world up at u = 1/2 - atan2(y, x) / 2 pi after the Mapping node has turned the direction."""
    write_hdr(path, sky())
    picture = bpy.data.images.load(path)
    made = bpy.data.worlds.new("sky")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = picture
    mapping = nodes.new("ShaderNodeMapping")
    mapping.inputs["Rotation"].default_value = (0, 0, math.radians(WORLD_TURN))
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    background = nodes["Background"]
    background.inputs["Strength"].default_value = WORLD_STRENGTH
    links.new(texture.outputs["Color"], background.inputs["Color"])
    bpy.context.scene.world = made
