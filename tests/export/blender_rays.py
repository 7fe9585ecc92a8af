# blender_rays.py FOLDER NAME COUNT RAYS [placed] - looks into an exported lamp in Cycles, from two
# eyes before each page. Writes COUNT rays out of the lamp, in lamp space, to the file RAYS, and
# prints the radiance of each. placed: turned, mirrored, scaled and moved by its empty. Exit status
# 77: no bpy. Without arguments: only whether it is there.
import json
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
if len(sys.argv) == 1:
    sys.exit()

folder, name, count, path, *placed = sys.argv[1:]
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
import canned_lights

SIDE = 512
SWAP = np.array([[1, 0, 0], [0, 0, 1], [0, 1, 0]])  # lamp space and Blender's, both ways

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.samples, scene.cycles.seed = 1, 1
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
# A single sample is in its pixel's middle, but for the filter.
scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'BLACKMAN_HARRIS', .01
scene.render.resolution_x = scene.render.resolution_y = SIDE
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = path + '.exr'
place = Matrix()
if placed:
    place = (Matrix.Translation((1, 2, -1)) @ Matrix.Rotation(1.2, 4, Vector((.6, .8, 0)))
             @ Matrix.Diagonal((-2.5, 2.5, 2.5, 1)))
canned_lights.add_lamp(os.path.join(folder, f'{name}.json'), scene, place)
back = np.linalg.inv(np.array(place))


def render():
    kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)  # it tells its progress
    bpy.ops.render.render(write_still=True)
    os.dup2(kept, 1)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.array(image.pixels[:], np.float32).reshape(SIDE, SIDE, 4)[::-1, :, :3]
    bpy.data.images.remove(image)
    os.remove(scene.render.filepath)
    return pixels


def look(eye, target, radius):
    """Rays, in lamp space and out of the lamp, and their radiance."""
    eye, target = (place @ Vector(SWAP @ at) for at in (eye, target))
    turn = (target - eye).to_track_quat('-Z', 'Y').to_matrix()
    camera = bpy.data.objects.new('eye', bpy.data.cameras.new('eye'))
    camera.matrix_world = Matrix.Translation(eye) @ turn.to_4x4()
    half = radius * place.median_scale / (target - eye).length
    camera.data.angle, camera.data.clip_start = 2 * math.atan(half), 1e-4
    scene.collection.objects.link(camera)
    scene.camera = camera
    half = math.tan(camera.data.angle / 2)
    at = ((np.arange(SIDE) + .5) / SIDE - .5) * 2 * half
    x, y = np.meshgrid(at, -at)
    rays = np.stack([x, y, -np.ones_like(x)], -1).reshape(-1, 3) @ np.array(turn).T
    pick = np.random.default_rng(1).choice(SIDE * SIDE, share, replace=False)
    rays = -rays[pick] @ back[:3, :3].T @ SWAP
    start = (back[:3, :3] @ np.array(eye) + back[:3, 3]) @ SWAP
    return np.hstack([np.tile(start, (share, 1)), rays]), render().reshape(-1, 3)[pick]


with open(os.path.join(folder, f'{name}.json'), encoding='utf-8') as file:
    pages = json.load(file)['pages']
share = int(count) // (2 * len(pages))
rays, radiances = [], []
for page in pages:
    center, u, v, normal = (np.array(page[key]) for key in ('center', 'u', 'v', 'normal'))
    edges, (s0, s1, t0, t1) = [np.linalg.norm(edge) for edge in (u, v)], page['st_window']
    for height, across in ((.4, .4), (1.7, .6)):
        slopes = s0 + across * (s1 - s0), t0 + across * (t1 - t0)
        eye = center + height * (normal + slopes[0] * u / edges[0] + slopes[1] * v / edges[1])
        seen = look(eye, center, min(.5 * max(edges), height * max(s1 - s0, t1 - t0)))
        rays.append(seen[0])
        radiances.append(seen[1])
np.savetxt(path, np.vstack(rays), '%.17g')
np.savetxt(sys.stdout, np.vstack(radiances), '%.9g')
