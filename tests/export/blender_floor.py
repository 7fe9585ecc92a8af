# blender_floor.py FOLDER NAME SIDE [SAMPLES] - the irradiance of SIDE x SIDE receivers of a plane by
# Cycles, in Blender's space: rows of a point and a normal on stdin, a row of the plane after the
# other. A matt white floor is looked at from just before it. Exit status 77: no bpy.
import os
import sys

try:
    import bpy
    import numpy as np
    from mathutils import Matrix
except Exception as reason:
    print(f'no bpy: {reason}', file=sys.stderr)
    sys.exit(77)

folder, name, side, samples = sys.argv[1], sys.argv[2], int(sys.argv[3]), int((sys.argv[4:] or [256])[0])
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
import canned_lights

rows = np.loadtxt(sys.stdin).reshape(side, side, 6)
middle, normal = rows[..., :3].mean((0, 1)), rows[0, 0, 3:]
steps = [(rows[0, 1] - rows[0, 0])[:3], (rows[1, 0] - rows[0, 0])[:3]]
lengths = [np.linalg.norm(step) for step in steps]
right, up = (step / length for step, length in zip(steps, lengths))

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
canned_lights.add_lamp(os.path.join(folder, f'{name}.json'), scene)
mesh = bpy.data.meshes.new('floor')
mesh.from_pydata([middle + side * (i * steps[0] + j * steps[1]) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
                 [], [(0, 1, 2, 3)])
paint = bpy.data.materials.new('paint')
paint.use_nodes = True
tree = paint.node_tree
tree.nodes.clear()
surface, output = tree.nodes.new('ShaderNodeBsdfDiffuse'), tree.nodes.new('ShaderNodeOutputMaterial')
surface.inputs['Color'].default_value = 1, 1, 1, 1
tree.links.new(surface.outputs[0], output.inputs['Surface'])
mesh.materials.append(paint)
scene.collection.objects.link(bpy.data.objects.new('floor', mesh))

# The camera's rows run down; seen from the lit side, up may be left of where right is: mirrored.
flip = 1 if np.dot(np.cross(right, up), normal) > 0 else -1
camera = bpy.data.objects.new('eye', bpy.data.cameras.new('eye'))
height = .01 * lengths[0]
columns = [right, up * flip, normal, middle + height * normal]
camera.matrix_world = Matrix([[float(column[row]) for column in columns] for row in range(3)] + [[0, 0, 0, 1]])
camera.data.type, camera.data.sensor_fit = 'ORTHO', 'HORIZONTAL'
camera.data.ortho_scale, camera.data.clip_start = side * lengths[0], height / 10
scene.collection.objects.link(camera)
scene.camera = camera
render, cycles = scene.render, scene.cycles
ratio = lengths[1] / lengths[0]
render.pixel_aspect_x, render.pixel_aspect_y = max(1, 1 / ratio), max(1, ratio)
render.engine = 'CYCLES'
cycles.samples, cycles.max_bounces = samples, 0
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
# The filter BOX is a pixel wide, whatever filter_width says; the other can be narrow.
cycles.pixel_filter_type, cycles.filter_width = 'BLACKMAN_HARRIS', .01
render.resolution_x = render.resolution_y = side
render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
render.filepath = os.path.join(folder, 'floor.exr')
kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
os.dup2(nothing, 1)  # it tells its progress
bpy.ops.render.render(write_still=True)
os.dup2(kept, 1)
image = bpy.data.images.load(render.filepath)
pixels = np.array(image.pixels[:]).reshape(side, side, 4)[..., :3]  # rows from below
np.savetxt(sys.stdout, np.pi * (pixels if flip > 0 else pixels[::-1]).reshape(-1, 3), '%.9g')
