"""One picture of the floor by Mitsuba 3, on one thread. Prints the CPU seconds of preparing (none)
and of rendering alone: without Python's start, loading, and compiling (a first picture of one ray).

  mitsuba_peer.py FOLDER LAMP INTEGRATOR SPP SEED VIEW OUT.npy   INTEGRATOR: ptracer (light
  tracing), path. MITSUBA_VARIANT and MITSUBA_THREADS (1) may be set.
"""
import glob
import os
import sys
import time

import drjit
import mitsuba as mi
import numpy

import lamps

mi.set_variant(os.environ.get('MITSUBA_VARIANT', 'scalar_rgb'))
THREADS = int(os.environ.get('MITSUBA_THREADS', 1))


def mirrored(p):
    return [float(p[0]), float(p[1]), -float(p[2])]


def matt(albedo):
    return {'type': 'twosided', 'bsdf': {'type': 'diffuse', 'reflectance': {'type': 'rgb', 'value': albedo}}}


def material(name):
    kind, value = name.split('-')[:2]
    if kind == 'matt':
        return matt(float(value))
    return {'type': 'twosided', 'bsdf': {'type': 'conductor', 'material': 'none',
                                         'specular_reflectance': {'type': 'rgb', 'value': float(value)}}}


def load(folder, lamp, integrator, view):
    eye, target = lamps.camera(lamp, view)
    scene = {'type': 'scene', 'integrator': {'type': integrator, 'max_depth': 24, 'rr_depth': 6},
             'sensor': {'type': 'perspective', 'fov': lamps.FOV,
                        'to_world': mi.ScalarTransform4f().look_at(mirrored(eye), mirrored(target), [0, 1, 0]),
                        'sampler': {'type': 'independent'},
                        'film': {'type': 'hdrfilm', 'width': lamps.SIZE, 'height': lamps.SIZE,
                                 'pixel_format': 'luminance', 'component_format': 'float32', 'rfilter': {'type': 'box'}}}}
    for k, name in enumerate(sorted(glob.glob(f'{folder}/*-*.obj'))):
        scene[f'part{k}'] = {'type': 'obj', 'filename': name, 'bsdf': material(os.path.basename(name)[:-4]),
                             'face_normals': not os.path.basename(name).startswith('mirror')}
    size = lamps.HEIGHT[lamp]
    scene['floor'] = {'type': 'rectangle', 'bsdf': matt(lamps.ALBEDO), 'to_world': mi.ScalarTransform4f().translate(
        [0, -size, 0]).rotate([1, 0, 0], -90).scale(lamps.FLOOR*size)}
    low, high = ((numpy.array(mirrored(p)) - (0, 1, 0))*size for p in lamps.POST)
    scene['post'] = {'type': 'cube', 'bsdf': matt(0.0), 'to_world':
                     mi.ScalarTransform4f().translate((low + high)/2).scale(abs(high - low)/2)}
    for k, (centre, radius, radiance) in enumerate(lamps.lamp(lamp)[1]):
        scene[f'bulb{k}'] = {'type': 'sphere', 'center': mirrored(centre), 'radius': radius, 'bsdf': matt(0.0),
                             'emitter': {'type': 'area', 'radiance': {'type': 'rgb', 'value': radiance}}}
    return mi.load_dict(scene)


def main(folder, lamp, integrator, spp, seed, view, out):
    drjit.set_thread_count(THREADS)
    scene = load(folder, lamp, integrator, int(view))
    if not mi.variant().startswith('scalar'):
        drjit.eval(mi.render(scene, spp=1, seed=int(seed)))
        drjit.sync_thread()
    start = time.process_time()
    picture = mi.render(scene, spp=int(spp), seed=int(seed))
    picture = numpy.array(picture, numpy.float32).reshape(lamps.SIZE, lamps.SIZE)
    print(f'0 {time.process_time() - start:.4f}')
    numpy.save(out, picture)


main(*sys.argv[1:])
