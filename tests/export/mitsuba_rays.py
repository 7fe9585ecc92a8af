# mitsuba_rays.py FOLDER NAME rays|sum|irradiance [KEY=VALUE...] - what Mitsuba 3 says of an exported
# lamp, for rows on stdin, in its own space. rays: origin, direction: radiance. sum, irradiance:
# point, normal: one sample of each emitter, or samples=N of multijitter (1024). Other keys are
# parameters of NAME.xml. mitsuba_rays.py rays|sum|irradiance: only whether it can. Exit status 77:
# no Mitsuba, or none that is compiled, by the LLVM that DRJIT_LIBLLVM_PATH names, and rays are not
# all that is asked. (An LLVM that it finds by itself may be too old, and abort.)
import os
import sys

task = sys.argv[min(3, len(sys.argv) - 1)]
try:
    import drjit as dr
    import mitsuba as mi
    import numpy as np

    scalar = 'DRJIT_LIBLLVM_PATH' not in os.environ
    mi.set_variant('scalar_rgb' if scalar else 'llvm_ad_rgb')
    if not scalar:
        dr.eval(mi.Float(1) + dr.arange(mi.Float, 3))
    elif task != 'rays':
        raise ImportError('its compiled variants need DRJIT_LIBLLVM_PATH')
except Exception as reason:
    print(f'no Mitsuba: {reason}', file=sys.stderr)
    sys.exit(77)
if len(sys.argv) == 2:
    sys.exit()

folder, name, _, *more = sys.argv[1:]
parameters = dict(word.split('=') for word in more)
samples = int(parameters.pop('samples', 1024)) if task == 'irradiance' else 1
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
if os.path.exists(os.path.join(folder, 'slab_emitter.py')):
    import slab_emitter

os.chdir(folder)
scene = mi.load_file(f'{name}.xml', **parameters)
rows = np.loadtxt(sys.stdin, ndmin=2)
if task == 'rays':

    def radiance(origin, direction):
        hit = scene.ray_intersect(mi.Ray3f(mi.Point3f(origin), dr.normalize(mi.Vector3f(direction))))
        emitter = hit.emitter(scene)
        return [0, 0, 0] if emitter is None else emitter.eval(hit, hit.is_valid())

    if scalar:
        out = [radiance(row[:3], row[3:]) for row in rows.tolist()]
    else:
        out = np.array(radiance(rows[:, :3].T, rows[:, 3:].T)).T
else:
    sampler = mi.load_dict({'type': 'multijitter', 'sample_count': samples})
    samples = sampler.sample_count()  # it rounds
    rows = np.repeat(rows, samples, 0)
    sampler.set_samples_per_wavefront(samples)
    sampler.seed(0, len(rows))
    at = dr.zeros(mi.SurfaceInteraction3f, len(rows))
    at.p, at.n = mi.Point3f(rows[:, :3].T), mi.Normal3f(rows[:, 3:].T)
    at.t, at.sh_frame = mi.Float(1), mi.Frame3f(at.n)
    if task == 'sum':
        found = [emitter.sample_direction(at, sampler.next_2d()) for emitter in scene.emitters()]
    else:
        found = [scene.sample_emitter_direction(at, sampler.next_2d(), False)]
    out = 0
    for direction, weight in found:
        rgb = weight * dr.maximum(dr.dot(direction.d, at.n), 0)
        out = out + np.array(rgb, np.float64).T.reshape(-1, samples, 3).mean(1)
np.savetxt(sys.stdout, out, '%.9g')
