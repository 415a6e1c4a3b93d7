"""Bakes the floor of `bench_bake --model` by Blender's Cycles.

  blender -b --factory-startup -P cycles_floor.py -- MODEL.ply OUT SAMPLES THREADS

OUT gets 512 x 512 texels as the chart has them, four floats each: direct light on a white floor, up
to a factor. Prints "cycles<tab>SECONDS" for the bake alone, its structures included.
"""
import array
import sys
import time

import bpy

model, out, samples, threads = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_mesh.ply(filepath=model)
figure = bpy.context.selected_objects[0]
corners = [v.co for v in figure.data.vertices]
low = [min(p[k] for p in corners) for k in range(3)]
high = [max(p[k] for p in corners) for k in range(3)]
middle = [(a + b) / 2 for a, b in zip(low, high)]
side = 2 * max(high[0] - low[0], high[2] - low[2])

x, y, z = middle[0] - side / 2, low[1], middle[2] + side / 2
mesh = bpy.data.meshes.new("floor")
mesh.from_pydata(
    [(x, y, z), (x + side, y, z), (x + side, y, z - side), (x, y, z - side)], [], [(0, 1, 2, 3)]
)
layer = mesh.uv_layers.new()
for loop, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]):
    loop.uv = uv
floor = bpy.data.objects.new("floor", mesh)

# A sphere of the same radius; its power is a matter of the factor.
lamp = bpy.data.lights.new("lamp", "POINT")
lamp.energy, lamp.shadow_soft_size = 1000 * side * side, 0.1 * side
light = bpy.data.objects.new("lamp", lamp)
light.location = (middle[0] + 0.5 * side, middle[1] + side, middle[2] + 0.3 * side)
for thing in (floor, light):
    bpy.context.collection.objects.link(thing)

image = bpy.data.images.new("light", 512, 512, float_buffer=True)
material = bpy.data.materials.new("white")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
white, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
white.inputs["Color"].default_value = (1, 1, 1, 1)
links.new(white.outputs[0], output.inputs[0])
target = nodes.new("ShaderNodeTexImage")
target.image = image
nodes.active = target
mesh.materials.append(material)

scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = int(samples)
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
scene.render.threads_mode, scene.render.threads = "FIXED", int(threads)
scene.render.bake.margin = 0
bpy.ops.object.select_all(action="DESELECT")
floor.select_set(True)
bpy.context.view_layer.objects.active = floor
begin = time.perf_counter()
bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT"}, margin=0)
print(f"cycles\t{time.perf_counter() - begin:.6g}")

texels = array.array("f", bytes(4 * 4 * 512 * 512))
image.pixels.foreach_get(texels)
with open(out, "wb") as file:
    texels.tofile(file)
