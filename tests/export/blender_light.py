# blender_light.py FOLDER NAME SAMPLES - the irradiance that Cycles gets from an exported lamp, for
# rows on stdin, in its own space: point and normal of a square number of receivers in a plane, row
# by row in even steps. It is the picture of a white plane, seen from just before it. Exit status
# 77: no bpy.
import math
import os
import sys

try:
    import bpy
    import numpy as np
    from mathutils import Matrix, Vector
except Exception as reason:
    print(f'no bpy: {reason}', file=sys.stderr)
    sys.exit(77)

folder, name, samples = sys.argv[1:]
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
import canned_lights

rows = np.loadtxt(sys.stdin)
side = math.isqrt(len(rows))
points, normal = rows[:, :3].reshape(side, side, 3), rows[0, 3:]
right, up = points[0, 1] - points[0, 0], points[1, 0] - points[0, 0]
steps = np.linalg.norm(right), np.linalg.norm(up)
middle = points.mean((0, 1))

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.samples, scene.cycles.seed, scene.cycles.max_bounces = int(samples), 1, 0
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'BLACKMAN_HARRIS', .01
scene.render.resolution_x = scene.render.resolution_y = side
scene.render.pixel_aspect_x = max(steps[0] / steps[1], 1)
scene.render.pixel_aspect_y = max(steps[1] / steps[0], 1)
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = os.path.join(folder, 'light.exr')
canned_lights.add_lamp(os.path.join(folder, f'{name}.json'), scene, Matrix())

half = right * side * .6, up * side * .6
corners = [tuple(middle + x * half[0] + y * half[1]) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
mesh = bpy.data.meshes.new('plane')
mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
white = bpy.data.materials.new('white')
white.use_nodes = True
white.node_tree.nodes.clear()
surface = white.node_tree.nodes.new('ShaderNodeBsdfDiffuse')
surface.inputs['Color'].default_value = 1, 1, 1, 1
output = white.node_tree.nodes.new('ShaderNodeOutputMaterial')
white.node_tree.links.new(surface.outputs[0], output.inputs['Surface'])
mesh.materials.append(white)
scene.collection.objects.link(bpy.data.objects.new('plane', mesh))

x, z = Vector(right / steps[0]), Vector(normal)
y = z.cross(x)
camera = bpy.data.objects.new('eye', bpy.data.cameras.new('eye'))
camera.data.type, camera.data.sensor_fit = 'ORTHO', 'HORIZONTAL'
camera.data.ortho_scale, camera.data.clip_start = steps[0] * side, 1e-4
turn = Matrix((x, y, z)).transposed().to_4x4()
camera.matrix_world = Matrix.Translation(Vector(middle + .01 * normal)) @ turn
scene.collection.objects.link(camera)
scene.camera = camera

kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
os.dup2(nothing, 1)  # it tells its progress
bpy.ops.render.render(write_still=True)
os.dup2(kept, 1)
image = bpy.data.images.load(scene.render.filepath)
pixels = np.array(image.pixels[:], np.float32).reshape(side, side, 4)[:, :, :3]  # rows upwards
if np.dot(np.array(y), up) < 0:
    pixels = pixels[::-1]
np.savetxt(sys.stdout, math.pi * pixels.reshape(-1, 3), '%.9g')
