"""What the scenes are made of: images, materials, meshes, lights, cameras and the settings of both renderers.

For Blender 3.4. Blender's frame: z up, metres; images are row-major from the BOTTOM, linear unless said otherwise.
"""

import math

import bmesh
import bpy
import numpy as np
from mathutils import Vector

from io_scene_gltf2.blender.com.gltf2_blender_material_helpers import create_settings_group, get_gltf_node_name


def empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    world = bpy.data.worlds.new("black")
    world.color = (0, 0, 0)
    bpy.context.scene.world = world


# --- images -----------------------------------------------------------------------------------------------------------

def image(name, pixels, colour=True):
    """An 8-bit image, packed as PNG. `pixels`: [height, width, 3 or 4] encoded values in [0,1], sRGB where `colour`."""
    height, width, channels = pixels.shape
    rgba = np.ones((height, width, 4), dtype=np.float32)
    rgba[:, :, :channels] = pixels
    made = bpy.data.images.new(name, width, height, alpha=channels == 4)
    made.colorspace_settings.name = "sRGB" if colour else "Non-Color"
    made.alpha_mode = "CHANNEL_PACKED"
    made.pixels.foreach_set(rgba.ravel())
    made.file_format = "PNG"
    made.pack()
    return made


def unit_grid(size):
    """Centres of size x size texels: (u, v) in [0,1]."""
    at = (np.arange(size) + 0.5) / size
    return np.meshgrid(at, at)


def checker(size, squares, dark, light):
    u, v = unit_grid(size)
    odd = (np.floor(u * squares) + np.floor(v * squares)) % 2 > 0.5
    return np.where(odd[:, :, None], np.array(light), np.array(dark))


def normals_of_waves(size, waves, slope):
    """A tangent-space normal map (+y up, as glTF and Blender have it) of crossed waves."""
    u, v = unit_grid(size)
    x = -slope * np.cos(2 * math.pi * waves * u)
    y = -slope * np.cos(2 * math.pi * waves * v)
    normal = np.stack([x, y, np.ones_like(x)], axis=2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    return normal * 0.5 + 0.5


# --- materials --------------------------------------------------------------------------------------------------------

class Material:
    """A Principled BSDF, which is what the exporter reads; Cycles renders the same unless `cycles_renders` is called.

    `gltf` sets the exporter's own values that Principled lacks (Thickness, Specular)."""

    def __init__(self, name, gltf=None, **inputs):
        self.data = bpy.data.materials.new(name)
        self.data.use_nodes = True
        self.data.use_backface_culling = False  # doubleSided: Cycles emits from both sides
        self.nodes, self.links = self.data.node_tree.nodes, self.data.node_tree.links
        self.principled = self.nodes["Principled BSDF"]
        self.output = self.nodes["Material Output"]
        self.principled.distribution = "GGX"  # one bounce in the microsurface, as glTF's model
        for key, value in inputs.items():
            self[key.replace("_", " ").title().replace("Ior", "IOR")] = value
        if gltf:
            group = bpy.data.node_groups.get(get_gltf_node_name()) or create_settings_group(get_gltf_node_name())
            node = self.add("ShaderNodeGroup")
            node.node_tree = group
            for key, value in gltf.items():
                node.inputs[key].default_value = value

    def __setitem__(self, socket, value):
        """A number, a colour or the output of another node."""
        target = self.principled.inputs[socket]
        if isinstance(value, bpy.types.NodeSocket):
            self.links.new(value, target)
        elif isinstance(value, tuple):
            target.default_value = (*value, 1.0)
        else:
            target.default_value = value

    def add(self, kind, **properties):
        node = self.nodes.new(kind)
        for key, value in properties.items():
            setattr(node, key, value)
        return node

    def link(self, source, target):
        self.links.new(source, target)

    def texture(self, picture, uv_map=None, scale=None, rotation=0.0, offset=(0, 0), mirrored=False, nearest=False):
        """An image node with its UV map, its Mapping node (KHR_texture_transform) and its wrap mode."""
        node = self.add("ShaderNodeTexImage", image=picture, interpolation="Closest" if nearest else "Linear")
        coordinates = None
        if uv_map:
            coordinates = self.add("ShaderNodeUVMap", uv_map=uv_map).outputs["UV"]
        if scale:
            mapping = self.add("ShaderNodeMapping")
            mapping.inputs["Scale"].default_value = (*scale, 1)
            mapping.inputs["Rotation"].default_value = (0, 0, rotation)
            mapping.inputs["Location"].default_value = (*offset, 0)
            self.link(coordinates, mapping.inputs["Vector"])
            coordinates = mapping.outputs["Vector"]
        if mirrored:
            apart, together = self.add("ShaderNodeSeparateXYZ"), self.add("ShaderNodeCombineXYZ")
            self.link(coordinates, apart.inputs[0])
            for axis in "XY":
                fold = self.add("ShaderNodeMath", operation="PINGPONG")
                fold.inputs[1].default_value = 1.0
                self.link(apart.outputs[axis], fold.inputs[0])
                self.link(fold.outputs[0], together.inputs[axis])
            coordinates = together.outputs[0]
        if coordinates:
            self.link(coordinates, node.inputs["Vector"])
        return node

    def times(self, colour, socket):
        """colour * socket, as the exporter recognises a base colour factor."""
        mix = self.add("ShaderNodeMix", data_type="RGBA", blend_type="MULTIPLY")
        mix.inputs[0].default_value = 1.0
        mix.inputs[6].default_value = (*colour, 1.0)
        self.link(socket, mix.inputs[7])
        return mix.outputs[2]

    def absorb(self, colour, density):
        """Cycles: exp(-density (1 - colour) s); the exporter writes colour and 1/density, glTF: colour^(density s).
        They agree to (1 - colour) / 2 of the exponent: take a colour near white and a high density."""
        node = self.add("ShaderNodeVolumeAbsorption")
        node.inputs["Color"].default_value = (*colour, 1.0)
        node.inputs["Density"].default_value = density
        self.link(node.outputs[0], self.output.inputs["Volume"])

    def cycles_renders(self, shader):
        """Lets Cycles see `shader`, while the exporter goes on seeing Principled: where the two differ in what a
        parameter means, this is glTF's meaning put together from elementary BSDFs."""
        self.output.target = "EEVEE"
        output = self.add("ShaderNodeOutputMaterial", target="CYCLES")
        self.link(shader, output.inputs["Surface"])

    def shader(self, kind, **inputs):
        node = self.add("ShaderNodeBsdf" + kind)
        if kind in ("Glossy", "Glass"):
            node.distribution = "GGX"
        for key, value in inputs.items():
            node.inputs[key].default_value = (*value, 1.0) if isinstance(value, tuple) else value
        return node.outputs[0]

    def mixed(self, factor, below, above):
        node = self.add("ShaderNodeMixShader")
        self.link(factor, node.inputs[0])
        self.link(below, node.inputs[1])
        self.link(above, node.inputs[2])
        return node.outputs[0]

    def fresnel(self, ior):
        """Reflectance from outside on both sides: Cycles' node takes 1/IOR at the back."""
        node = self.add("ShaderNodeFresnel")
        back = self.add("ShaderNodeNewGeometry").outputs["Backfacing"]
        sign = self.arithmetic("SUBTRACT", 1.0, self.arithmetic("MULTIPLY", back, 2.0))
        self.link(self.arithmetic("POWER", ior, sign), node.inputs["IOR"])
        return node.outputs[0]

    def arithmetic(self, operation, a, b):
        node = self.add("ShaderNodeMath", operation=operation)
        for value, target in zip((a, b), node.inputs):
            if isinstance(value, bpy.types.NodeSocket):
                self.link(value, target)
            else:
                target.default_value = value
        return node.outputs[0]


def lambert(name, colour=(0.8, 0.8, 0.8), **inputs):
    """Principled with specular 0; its Burley term at roughness 0.4 is within 1 % of Lambert's albedo. The exporter's
    'original specular' writes specularFactor 0, with which glTF's model is Lambert exactly."""
    return Material(name, gltf={"Specular": 0.0}, base_color=colour, specular=0.0, roughness=0.4, **inputs)


# --- objects ----------------------------------------------------------------------------------------------------------

def place(name, data, at=(0, 0, 0), turn=(0, 0, 0), scale=(1, 1, 1), material=None):
    """An object of `data` (mesh, light, camera ...); `turn`: Euler angles in degrees."""
    made = bpy.data.objects.new(name, data)
    made.location, made.scale = at, scale
    made.rotation_euler = [math.radians(a) for a in turn]
    bpy.context.scene.collection.objects.link(made)
    if material:
        data.materials.append(material.data)
    return made


def mesh_of(name, build, smooth=False):
    """A mesh from bmesh's own operators: `build(bm)`."""
    bm = bmesh.new()
    bm.loops.layers.uv.new("UVMap")
    build(bm)
    for face in bm.faces:
        face.smooth = smooth
    data = bpy.data.meshes.new(name)
    bm.to_mesh(data)
    bm.free()
    return data


def sphere(name, segments=64, rings=32):
    return mesh_of(name, lambda bm: bmesh.ops.create_uvsphere(
        bm, u_segments=segments, v_segments=rings, radius=1.0, calc_uvs=True), smooth=True)


def cube(name):
    """From -0.5 to 0.5."""
    return mesh_of(name, lambda bm: bmesh.ops.create_cube(bm, size=1.0, calc_uvs=True))


def monkey(name):
    """Suzanne, flat."""
    return mesh_of(name, lambda bm: bmesh.ops.create_monkey(bm))


def sheet(name, corner, edge_u, edge_v, second_uv=None):
    """A parallelogram, front towards edge_u x edge_v, UV (0,0) at `corner`. `second_uv`: ((u,v) of the corner, its
    change along edge_u, along edge_v) for the UV map "Second"."""
    c, u, v = Vector(corner), Vector(edge_u), Vector(edge_v)
    data = bpy.data.meshes.new(name)
    data.from_pydata([c, c + u, c + u + v, c + v], [], [(0, 1, 2, 3)])
    places = [(0, 0), (1, 0), (1, 1), (0, 1)]
    data.uv_layers.new(name="UVMap").data.foreach_set("uv", [x for p in places for x in p])
    if second_uv:
        at, du, dv = (np.array(x, dtype=float) for x in second_uv)
        values = [at + a * du + b * dv for a, b in places]
        data.uv_layers.new(name="Second").data.foreach_set("uv", np.concatenate(values))
    data.update()
    return data


def look(name, at, target, angle=None, ortho_scale=None):
    """A camera; `angle`: the horizontal one in degrees; `ortho_scale`: width of an orthographic picture."""
    data = bpy.data.cameras.new(name)
    if ortho_scale:
        data.type, data.ortho_scale = "ORTHO", ortho_scale
    else:
        data.angle = math.radians(angle)
    made = place(name, data, at)
    made.rotation_euler = (Vector(target) - Vector(at)).to_track_quat("-Z", "Y").to_euler()
    return made


def light(name, kind, at, power, colour=(1, 1, 1), target=None, cone=None):
    """POINT and SPOT: watts as Blender counts them (intensity power / 4 pi W/sr, the spot's too); SUN: W/m^2."""
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = power, colour
    if kind == "SUN":
        data.angle = 0.0
    else:
        data.shadow_soft_size = 0.0
    if kind == "SPOT":
        data.spot_size, data.spot_blend = math.radians(cone), 0.02
    made = place(name, data, at)
    if target:
        made.rotation_euler = (Vector(target) - Vector(at)).to_track_quat("-Z", "Y").to_euler()
    return made


# --- both renderers ---------------------------------------------------------------------------------------------------

def cycles(scene, width, height, samples, seed=0):
    """Cycles without anything that biases it: no clamping, filtering, denoising, roulette threshold."""
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.view_settings.view_transform = "Standard"
    settings = scene.cycles
    settings.device, settings.samples, settings.seed = "CPU", samples, seed
    settings.use_adaptive_sampling = settings.use_denoising = False
    settings.max_bounces = settings.diffuse_bounces = settings.glossy_bounces = 64
    settings.transmission_bounces = settings.transparent_max_bounces = 64
    settings.sample_clamp_direct = settings.sample_clamp_indirect = 0.0
    settings.blur_glossy = 0.0
    settings.caustics_reflective = settings.caustics_refractive = True
    settings.light_sampling_threshold = 0.0
    settings.pixel_filter_type = "BOX"


def export(path):
    bpy.ops.export_scene.gltf(
        filepath=path, export_format="GLB", export_lights=True, export_cameras=True, export_extras=True,
        export_original_specular=True, export_animations=False,
        export_current_frame=True, export_yup=True)  # the pose, not the rest position
