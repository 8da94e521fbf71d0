"""A closed room: textures in every role, coverage, vertex colours, mirrored and stretched instances, lamps of mesh."""

import bpy
import numpy as np

import kit

VIEWS = ("wide", "elevation")


def build():
    surfaces()
    lamps()
    things()
    kit.look("wide", (0.3, -2.8, 1.35), (-0.05, 1, 1.05), angle=70)
    kit.look("elevation", (0, -2.9, 1.3), (0, 2, 1.3), ortho_scale=3.4)


def surfaces():
    grey = kit.lambert("grey", (0.6, 0.6, 0.6))
    kit.place("ceiling", kit.sheet("ceiling", (-2, -3, 2.6), (0, 5, 0), (4, 0, 0)), material=grey)
    kit.place("front", kit.sheet("front", (2, -3, 0), (-4, 0, 0), (0, 0, 2.6)), material=grey)
    kit.place("right", kit.sheet("right", (2, 2, 0), (0, -5, 0), (0, 0, 2.6)),
              material=kit.lambert("blue", (0.25, 0.4, 0.7)))

    # floor: texture transform (scale, rotation, offset), a factor times the texture
    floor = kit.lambert("floor")
    tiles = kit.image("tiles", kit.checker(64, 2, (0.5, 0.35, 0.25), (0.85, 0.8, 0.7)))
    floor["Base Color"] = floor.times(
        (0.9, 0.9, 0.8), floor.texture(tiles, "UVMap", (4, 5), 0.4, (0.15, 0.3), nearest=True).outputs["Color"])
    kit.place("floor", kit.sheet("floor", (-2, -3, 0), (4, 0, 0), (0, 5, 0)), material=floor)

    # back wall: the second UV map, a smooth sRGB picture
    u, v = kit.unit_grid(64)
    picture = np.stack([0.3 + 0.6 * u, 0.3 + 0.6 * v, 0.7 - 0.4 * u * v], axis=2)
    back = kit.lambert("back")
    back["Base Color"] = back.texture(kit.image("gradient", picture), "Second").outputs["Color"]
    kit.place("back", kit.sheet("back", (-2, 2, 0), (4, 0, 0), (0, 0, 2.6),
                                second_uv=((0.1, 0.9), (0.8, 0), (0, -0.8))), material=back)

    # left wall: mirrored repeat and a normal map
    left = kit.lambert("left")
    u, v = kit.unit_grid(32)
    ramp = np.stack([0.85 - 0.3 * u, 0.45 + 0.3 * u, 0.35 + 0.3 * v], axis=2)
    left["Base Color"] = left.texture(kit.image("ramp", ramp), "UVMap", (3, 2), mirrored=True).outputs["Color"]
    bumps = left.texture(kit.image("waves", kit.normals_of_waves(256, 8, 0.6), colour=False), "UVMap")
    normal_map = left.add("ShaderNodeNormalMap", uv_map="UVMap")
    normal_map.inputs["Strength"].default_value = 1.0
    left.link(bumps.outputs["Color"], normal_map.inputs["Color"])
    left["Normal"] = normal_map.outputs["Normal"]
    kit.place("left", kit.sheet("left", (-2, -3, 0), (0, 5, 0), (0, 0, 2.6)), material=left)


def lamps():
    lamp = kit.Material("lamp", base_color=(0, 0, 0), specular=0.0, gltf={"Specular": 0.0},
                        emission=(1.0, 0.85, 0.6), emission_strength=14.0)
    lamp.data.use_backface_culling = True  # a closed box: nothing is seen of its inside
    kit.place("lamp", kit.cube("lamp"), (0.2, -0.4, 2.45), scale=(1.0, 0.8, 0.1), material=lamp)

    # a screen: emissive texture times strength, both sides
    u, v = kit.unit_grid(32)
    bars = np.stack([np.where(u < 0.5, 0.9, 0.1), np.where(v < 0.5, 0.8, 0.2), np.where(u + v < 1, 0.1, 0.9)], axis=2)
    screen = kit.Material("screen", base_color=(0, 0, 0), specular=0.0, gltf={"Specular": 0.0}, emission_strength=3.0)
    screen["Emission"] = screen.texture(kit.image("bars", bars), "UVMap", nearest=True).outputs["Color"]
    kit.place("screen", kit.sheet("screen", (1.85, 1.4, 1.2), (0, -1.2, 0), (0, 0, 0.8)), material=screen)


def things():
    # metallic-roughness texture: strips of metal and paint, roughness from 0.25 to 0.75 along the other way
    u, v = kit.unit_grid(64)
    metal = np.where((u * 4) % 1 < 0.5, 1.0, 0.0)
    strips = kit.Material("strips", gltf={"Specular": 0.0}, base_color=(0.8, 0.6, 0.35), specular=0.0)
    packed = strips.texture(kit.image("strips", np.stack([np.ones_like(u), 0.25 + 0.5 * v, metal], axis=2),
                                      colour=False), "UVMap", nearest=True)
    apart = strips.add("ShaderNodeSeparateColor")
    strips.link(packed.outputs["Color"], apart.inputs[0])
    strips["Roughness"], strips["Metallic"] = apart.outputs["Green"], apart.outputs["Blue"]
    kit.place("strips", kit.sheet("strips", (-1.75, 1.2, 0.0), (1.1, 0.6, 0), (0, 0, 1.1)), material=strips)

    # alpha mask: a fence; alpha blend: a pane
    holes = np.ones((32, 32, 4))
    holes[:, :, :3] = (0.9, 0.85, 0.3)
    u, v = kit.unit_grid(32)
    holes[:, :, 3] = np.where(((u * 4) % 1 < 0.5) & ((v * 4) % 1 < 0.5), 0.0, 1.0)
    fence = kit.lambert("fence")
    node = fence.texture(kit.image("holes", holes), "UVMap", nearest=True)
    fence["Base Color"], fence["Alpha"] = node.outputs["Color"], node.outputs["Alpha"]
    fence.data.blend_method, fence.data.alpha_threshold = "CLIP", 0.5
    kit.place("fence", kit.sheet("fence", (0.5, 0.2, 0), (1.0, -0.5, 0), (0, 0, 0.9)), material=fence)

    pane = kit.lambert("pane", (0.8, 0.15, 0.1), alpha=0.4)
    pane.data.blend_method = "BLEND"
    kit.place("pane", kit.sheet("pane", (-1.1, -0.3, 0), (0.9, 0.2, 0), (0, 0, 1.0)), material=pane)

    # vertex colours times a factor
    ball = kit.sphere("ball")
    colours = ball.color_attributes.new("Paint", "FLOAT_COLOR", "POINT")
    values = [x for vertex in ball.vertices
              for x in (0.5 + 0.5 * vertex.co.x, 0.5 - 0.5 * vertex.co.z, 0.4 + 0.3 * vertex.co.y, 1.0)]
    colours.data.foreach_set("color", values)
    ball.color_attributes.render_color_index = 0
    painted = kit.lambert("painted")
    painted["Base Color"] = painted.times(
        (0.9, 0.9, 0.9), painted.add("ShaderNodeVertexColor", layer_name="Paint").outputs["Color"])
    kit.place("ball", ball, (0.15, 0.9, 0.45), scale=(0.45, 0.45, 0.45), material=painted)

    # one mesh thrice: upright, mirrored, stretched and turned
    head = kit.monkey("head")
    head.materials.append(kit.lambert("clay", (0.7, 0.45, 0.35)).data)
    kit.place("head", head, (1.2, 1.2, 0.4), (0, 0, -20), (0.4, 0.4, 0.4))
    kit.place("mirrored", head, (-0.5, 1.55, 1.7), (10, 20, 35), (-0.35, 0.35, 0.35))
    kit.place("stretched", head, (1.45, -0.6, 0.35), (0, 30, -50), (0.2, 0.35, 0.5))
