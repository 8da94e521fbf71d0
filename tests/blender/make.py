"""Builds a scene in Blender, exports it and renders it with Cycles.

    blender -b --python-exit-code 1 --python make.py -- SCENE FOLDER [--samples N] [--width N] [--height N] [--no-render]

SCENE: room, glass, yard. Writes FOLDER/SCENE.glb and FOLDER/SCENE-VIEW-cycles.exr for each of its views (and
FOLDER/sky.hdr, the world of the yard, which a .glb cannot hold).
"""

import argparse
import importlib
import inspect
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
bpy.ops.preferences.addon_enable(module="io_scene_gltf2")

import kit  # noqa: E402  (needs the exporter)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("scene")
    parser.add_argument("folder")
    parser.add_argument("--samples", type=int, default=512)
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--height", type=int, default=120)
    parser.add_argument("--views", help="comma-separated; all by default")
    parser.add_argument("--no-render", action="store_true")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])

    os.makedirs(options.folder, exist_ok=True)
    kit.empty_file()
    scene, module = bpy.context.scene, importlib.import_module(options.scene)
    module.build(options.folder) if inspect.signature(module.build).parameters else module.build()
    stem = os.path.join(os.path.abspath(options.folder), options.scene)
    scene.camera = bpy.data.objects[module.VIEWS[0]]
    for each in bpy.data.scenes:  # the exporter asks each scene for the shape of its pictures
        kit.cycles(each, options.width, options.height, options.samples)
    kit.export(stem + ".glb")
    if options.no_render:
        return
    for view in options.views.split(",") if options.views else module.VIEWS:
        rendered = bpy.data.scenes.get(view, scene)  # a view is a camera of the first scene or a scene of its own
        if rendered is scene:
            scene.camera = bpy.data.objects[view]
        rendered.render.filepath = f"{stem}-{view}-cycles.exr"
        bpy.ops.render.render(write_still=True, scene=rendered.name)


main()
