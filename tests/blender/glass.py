"""A white box under a large lamp: glass smooth and rough, with absorption, a thin sheet, a coat, metals."""

import bpy

import kit

VIEWS = ("table",)


def build():
    box()
    glass()
    opaque()
    kit.look("table", (0.0, -2.4, 1.25), (0, 0.4, 0.55), angle=62)


def box():
    white, red = kit.lambert("white", (0.7, 0.7, 0.7)), kit.lambert("red", (0.7, 0.2, 0.15))
    kit.place("floor", kit.sheet("floor", (-2, -2.6, 0), (4, 0, 0), (0, 4.2, 0)), material=white)
    kit.place("ceiling", kit.sheet("ceiling", (-2, -2.6, 2.4), (0, 4.2, 0), (4, 0, 0)), material=white)
    kit.place("front", kit.sheet("front", (2, -2.6, 0), (-4, 0, 0), (0, 0, 2.4)), material=white)
    kit.place("left", kit.sheet("left", (-2, -2.6, 0), (0, 4.2, 0), (0, 0, 2.4)), material=red)
    kit.place("right", kit.sheet("right", (2, 1.6, 0), (0, -4.2, 0), (0, 0, 2.4)), material=white)
    tiles = kit.lambert("tiles")
    picture = kit.image("tiles", kit.checker(64, 2, (0.35, 0.45, 0.6), (0.85, 0.85, 0.8)))
    tiles["Base Color"] = tiles.texture(picture, "UVMap", (5, 3), nearest=True).outputs["Color"]
    kit.place("back", kit.sheet("back", (-2, 1.6, 0), (4, 0, 0), (0, 0, 2.4)), material=tiles)
    lamp = kit.Material("lamp", base_color=(0, 0, 0), specular=0.0, gltf={"Specular": 0.0},
                        emission=(1.0, 0.95, 0.9), emission_strength=6.0)
    lamp.data.use_backface_culling = True
    kit.place("lamp", kit.cube("lamp"), (0, 0, 2.3), scale=(2.2, 1.8, 0.1), material=lamp)


def glass():
    clear = kit.Material("green glass", gltf={"Thickness": 1.0}, transmission=1.0, roughness=0.0, ior=1.5,
                         base_color=(1, 1, 1))
    clear.absorb((0.975, 0.995, 0.98), 40.0)
    kit.place("green ball", kit.sphere("green ball", 96, 48), (-0.95, 0.3, 0.4), scale=(0.4, 0.4, 0.4), material=clear)

    frosted = kit.Material("frosted", gltf={"Thickness": 1.0}, transmission=1.0, roughness=0.5, ior=1.45,
                           base_color=(1, 1, 1))
    kit.place("frosted block", kit.cube("frosted block"), (0.2, 0.75, 0.47), (0, 0, 15), (0.7, 0.15, 0.9),
              material=frosted)

    # thin: glTF without thickness; Cycles: reflectance 2R/(1+R) between a mirror and nothing
    thin = kit.Material("thin sheet", transmission=1.0, roughness=0.0, ior=1.5, base_color=(1, 1, 1))
    reflectance = thin.fresnel(1.5)
    doubled = thin.arithmetic("DIVIDE", thin.arithmetic("MULTIPLY", reflectance, 2.0),
                              thin.arithmetic("ADD", reflectance, 1.0))
    thin.cycles_renders(thin.mixed(doubled, thin.shader("Transparent", Color=(1, 1, 1)),
                                   thin.shader("Glossy", Color=(1, 1, 1), Roughness=0.0)))
    kit.place("thin sheet", kit.sheet("thin sheet", (-0.5, -0.6, 0), (0.8, 0.35, 0), (0, 0, 0.7)), material=thin)


def opaque():
    # a coat: Cycles' Principled counts a quarter of it and leaves the base as it is; this is glTF's
    coated = kit.Material("coated", gltf={"Specular": 0.0}, base_color=(0.6, 0.1, 0.08), specular=0.0, roughness=0.4,
                          clearcoat=1.0, clearcoat_roughness=0.0)
    coated.cycles_renders(coated.mixed(coated.fresnel(1.5), coated.shader("Diffuse", Color=(0.6, 0.1, 0.08)),
                                       coated.shader("Glossy", Color=(1, 1, 1), Roughness=0.0)))
    kit.place("coated ball", kit.sphere("coated ball"), (0.95, -0.1, 0.3), scale=(0.3, 0.3, 0.3), material=coated)

    gold = kit.Material("gold", base_color=(0.95, 0.7, 0.3), metallic=1.0, roughness=0.35)
    kit.place("gold ball", kit.sphere("gold ball"), (-0.2, -0.2, 0.2), scale=(0.2, 0.2, 0.2), material=gold)
    mirror = kit.Material("mirror", base_color=(0.9, 0.9, 0.9), metallic=1.0, roughness=0.0)
    kit.place("mirror ball", kit.sphere("mirror ball", 96, 48), (1.25, 0.9, 0.45), scale=(0.45, 0.45, 0.45),
              material=mirror)
    plastic = kit.Material("plastic", base_color=(0.1, 0.3, 0.6), roughness=0.3)
    kit.place("plastic ball", kit.sphere("plastic ball"), (0.45, -0.75, 0.18), scale=(0.18, 0.18, 0.18),
              material=plastic)
