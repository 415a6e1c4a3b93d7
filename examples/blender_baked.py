"""Loads what penumbra bake wrote: blender --python blender_baked.py -- room-baked.glb

A radiance bake needs no more than the import: its materials are emission alone. A lightmap bake
(--lightmap) gets its irradiance (the .exr beside it) as emission, base colour / pi times it.
"""
import json
import math
import pathlib
import sys

import bpy
import numpy

# The importer of Blender 3.4 takes a name that NumPy 1.24 dropped.
vars(numpy).setdefault("bool", bool)

path = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=str(path))
bpy.context.scene.view_settings.view_transform = "Standard"

description = path.with_suffix(".json")
if description.exists():
    maps = json.loads(description.read_text())
    images = [bpy.data.images.load(str(path.parent / image["exr"])) for image in maps["images"]]
    for light in [o for o in bpy.data.objects if o.type == "LIGHT" and o.data.get("baked")]:
        bpy.data.objects.remove(light)
    for entry in maps["meshes"]:
        mesh = bpy.data.objects[entry["mesh"]].data
        nodes, links = (tree := mesh.materials[entry["primitive"]].node_tree).nodes, tree.links
        shader = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
        uv, texture = nodes.new("ShaderNodeUVMap"), nodes.new("ShaderNodeTexImage")
        uv.uv_map, texture.image = mesh.uv_layers[entry["texCoord"]].name, images[entry["image"]]
        product, emission = nodes.new("ShaderNodeVectorMath"), nodes.new("ShaderNodeEmission")
        product.operation = "MULTIPLY"
        emission.inputs["Strength"].default_value = 1 / math.pi
        links.new(uv.outputs[0], texture.inputs[0])
        links.new(texture.outputs[0], product.inputs[0])
        base = shader.inputs["Base Color"]
        if base.links:
            links.new(base.links[0].from_socket, product.inputs[1])
        else:
            product.inputs[1].default_value = base.default_value[:3]
        links.new(product.outputs[0], emission.inputs[0])
        output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
        links.new(emission.outputs[0], output.inputs[0])
