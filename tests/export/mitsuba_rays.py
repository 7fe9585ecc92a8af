# mitsuba_rays.py rays|irradiance FOLDER NAME [PLACE] - what Mitsuba 3 says of an exported lamp, for
# rows on stdin, in its own space. rays: origin, direction: radiance. irradiance: point, normal,
# with 1024 samples of multijitter. PLACE: the parameter of NAME.xml. Exit status 77: no Mitsuba.
import os
import sys

try:
    import mitsuba as mi
    import numpy as np
    mi.set_variant(os.environ.get('MITSUBA_VARIANT', 'llvm_ad_rgb'))
    import drjit as dr
    dr.eval(mi.Float(1) + dr.arange(mi.Float, 3))
except Exception as reason:
    print(f'no Mitsuba: {reason}', file=sys.stderr)
    sys.exit(77)

task, folder, name, *place = sys.argv[1:]
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
import slab_emitter

os.chdir(folder)
scene = mi.load_file(f'{name}.xml', **({'place': place[0]} if place else {}))
rows = np.loadtxt(sys.stdin, ndmin=2)
if task == 'rays':
    ray = mi.Ray3f(mi.Point3f(rows[:, :3].T), dr.normalize(mi.Vector3f(rows[:, 3:].T)))
    hit = scene.ray_intersect(ray)
    rgb = hit.emitter(scene).eval(hit, hit.is_valid())
    out = np.array(rgb).T
else:
    samples = 1024
    rows = np.repeat(rows, samples, 0)
    sampler = mi.load_dict({'type': 'multijitter', 'sample_count': samples})
    sampler.set_samples_per_wavefront(samples)
    sampler.seed(0, len(rows))
    at = dr.zeros(mi.SurfaceInteraction3f, len(rows))
    at.p, at.n = mi.Point3f(rows[:, :3].T), mi.Normal3f(rows[:, 3:].T)
    at.t, at.sh_frame = mi.Float(1), mi.Frame3f(at.n)
    direction, weight = scene.sample_emitter_direction(at, sampler.next_2d(), False)
    rgb = weight * dr.maximum(dr.dot(direction.d, at.n), 0)
    out = np.array(rgb, np.float64).T.reshape(-1, samples, 3).mean(1)
np.savetxt(sys.stdout, out, '%.9g')
