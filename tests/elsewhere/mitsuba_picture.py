"""The room by Mitsuba 3. Prints the CPU seconds of rendering alone: without Python's
start, loading, and compiling (a first picture of one ray a pixel). On all threads: with one,
drjit.set_thread_count(1), drjit waits for ever while the emitter is made.

  mitsuba_picture.py FOLDER NAME SPP SEED OUT.pfm     FOLDER: of bakeslab export --as mitsuba
"""
import os
import sys
import time

import drjit
import mitsuba as mi
import numpy as np

import room

mi.set_variant(os.environ.get('MITSUBA_VARIANT', 'scalar_rgb'))
folder, name, spp, seed, out = sys.argv[1:]
sys.path.insert(0, folder)
import slab_emitter


def ply(path, faces):
    """Flat faces, as triangles: Mitsuba reads PLY."""
    corners = [room.text(room.y_up(p)) for face in faces for p in face]
    fans, first = [], 0
    for face in faces:
        fans += [f'3 {first} {first + k} {first + k + 1}' for k in range(1, len(face) - 1)]
        first += len(face)
    with open(path, 'w', encoding='ascii') as stream:
        stream.write(f'ply\nformat ascii 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\nproperty float z\n'
                     f'element face {len(fans)}\nproperty list uchar int vertex_indices\nend_header\n')
        stream.write('\n'.join(corners + fans) + '\n')
    return path


def load():
    to_world = mi.ScalarTransform4f().look_at(room.y_up(room.EYE), room.y_up(room.TARGET), [0, 1, 0])
    scene = {'type': 'scene', 'integrator': {'type': 'direct'},
             'sensor': {'type': 'perspective', 'fov': room.FOV, 'to_world': to_world, 'sampler': {'type': 'multijitter'},
                        'film': {'type': 'hdrfilm', 'width': room.SIZE[0], 'height': room.SIZE[1],
                                 'component_format': 'float32', 'rfilter': {'type': 'box'}}}}
    for part, albedo, faces in room.parts():
        scene[part] = {'type': 'ply', 'filename': ply(f'{out}.{part}.ply', faces), 'face_normals': True,
                       'bsdf': {'type': 'twosided', 'bsdf': {'type': 'diffuse', 'reflectance': {'type': 'rgb', 'value': albedo}}}}
    a, b, c = room.TURN
    place = mi.ScalarTransform4f().translate(room.y_up(room.MOVE)).rotate([0, 0, 1], c).rotate([0, 1, 0], -b).rotate([1, 0, 0], -a)
    return mi.load_dict({**scene, **slab_emitter.lamp(f'{folder}/{name}.json', place)})


scene = load()
if not mi.variant().startswith('scalar'):
    drjit.eval(mi.render(scene, spp=1, seed=int(seed)))
    drjit.sync_thread()
start = time.process_time()
picture = np.array(mi.render(scene, spp=int(spp), seed=int(seed)), np.float32)
print(f'{time.process_time() - start:.4f}')
room.write(out, picture[..., :3])
