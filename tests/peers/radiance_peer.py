"""One picture of the floor by Radiance, on one thread. Prints the CPU seconds of preparing, once
for all pictures of the scene, and of rendering.

  radiance_peer.py FOLDER LAMP photons N-K OUT.npy       N thousand photons, K of them a look-up
  radiance_peer.py FOLDER LAMP mkillum N-D-S OUT.npy     the aperture in N x N pieces, D directions
                                                         a steradian (projected), S rays for each

Photons start at bulbs that are `light`; mkillum looks for bulbs of `glow`, since it leaves out
sources of `light`, which Radiance cannot follow through a mirror.
"""
import glob
import os
import resource
import subprocess
import sys

import numpy as np

import lamps

HALF = {'parabolic': (10, 10), 'headlight': (9, 6)}   # of the aperture


def run(*words, into=None, given=None):
    """CPU seconds of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, input=given, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit(f'{words[0]}: ' + done.stderr.decode(errors='replace').strip()[-300:])
    if into:
        with open(into, 'wb') as stream:
            stream.write(done.stdout)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def mirrored(p):
    return '%.9g %.9g %.9g' % (p[0], p[1], -p[2])


def polygon(material, name, corners):
    return f'{material} polygon {name}\n0\n0\n{3*len(corners)} ' + ' '.join(mirrored(p) for p in corners) + '\n'


def scene(folder, lamp, light):
    text = ''
    for path in sorted(glob.glob(f'{folder}/*-*.obj')):
        kind, value, name = os.path.basename(path)[:-4].split('-', 2)
        mesh = path[:-4] + '.rtm'
        if not os.path.exists(mesh):
            run('obj2mesh', path, mesh)
        text += f'void {"metal" if kind == "mirror" else "plastic"} is_{name}\n0\n0\n5 {value} {value} {value} {int(kind == "mirror")} 0\n'
        text += f'is_{name} mesh {name}\n1 {mesh}\n0\n0\n'
    for k, (centre, radius, radiance) in enumerate(lamps.lamp(lamp)[1]):
        text += f'void {light} is_bulb{k}\n0\n0\n' + (f'3 {3*f"{radiance} "}' if light == 'light' else f'4 {3*f"{radiance} "} 0')
        text += f'\nis_bulb{k} sphere bulb{k}\n0\n0\n4 {mirrored(centre)} {radius}\n'
    for part, albedo in zip(lamps.scene(lamp), (lamps.ALBEDO, 0)):
        text += f'void plastic is_{part.name}\n0\n0\n5 {albedo} {albedo} {albedo} 0 0\n'
        for k in range(0, len(part.points), 4):
            text += polygon(f'is_{part.name}', f'{part.name}{k}', part.points[k:k + 4][::-1])
    return text


def aperture(lamp, pieces, directions, rays):
    turn = np.eye(3) if lamp == 'parabolic' else np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    text = f'#@mkillum i=window d={directions} s={rays}\n'
    a, b = HALF[lamp]
    for i in range(pieces):
        for j in range(pieces):
            x, y = [-a + 2*a*k/pieces for k in (i, i + 1)], [-b + 2*b*k/pieces for k in (j, j + 1)]
            corners = [(x[0], 0, y[0]), (x[1], 0, y[0]), (x[1], 0, y[1]), (x[0], 0, y[1])]
            if lamp == 'headlight':
                corners = [turn @ (p[0], p[2], 0) for p in corners]
            text += polygon('void', f'window{i}_{j}', corners)   # facing down, to the floor
    return text.encode()


def octree(name, text, *more):
    with open(name + '.rad', 'w', encoding='ascii') as stream:
        stream.write(text)
    return run('oconv', name + '.rad', *more, into=name + '.oct')


def picture(lamp, tree, out, *options):
    eye, target = lamps.camera(lamp, 0)
    cpu = run('rpict', '-w', '-vtv', '-vp', *mirrored(eye).split(), '-vd', *mirrored(target - eye).split(), '-vu', '0', '1', '0',
              '-vh', str(lamps.FOV), '-vv', str(lamps.FOV), '-x', str(lamps.SIZE), '-y', str(lamps.SIZE), '-av', '0', '0', '0',
              *options, tree, into=out + '.hdr')
    run('pvalue', '-h', '-H', '-df', '-b', out + '.hdr', into=out + '.f32')
    np.save(out, np.fromfile(out + '.f32', '<f4').reshape(lamps.SIZE, lamps.SIZE))
    return cpu


def photons(lamp, folder, name, setting, out):
    count, near = setting.split('-')
    bake = octree(name, scene(folder, lamp, 'light'))
    kind = '-apc' if lamp == 'headlight' else '-apg'
    bake += run('mkpmap', '-n', '1', '-fo+', '-apr', '1', kind, name + '.pm', count + 'k', name + '.oct')
    # Without -ab the photons of the floor are not gathered; -1 looks at them directly.
    return bake, picture(lamp, name + '.oct', out, '-ap', name + '.pm', near, '-ab', '0' if lamp == 'headlight' else '-1')


def mkillum(lamp, folder, name, setting, out):
    pieces, directions, rays = setting.split('-')
    text = scene(folder, lamp, 'glow')
    bake = octree(name, text)
    bake += run('mkillum', '-n', '1', '-w', '-ab', '2', '-ad', '256', '-as', '0', '-aa', '0.1', '-lw', '1e-4', '-lr', '8', name + '.oct',
                given=aperture(lamp, int(pieces), directions, rays), into=name + '-illum.rad')
    bake += octree(name + '-lit', text, name + '-illum.rad')
    return bake, picture(lamp, name + '-lit.oct', out, '-ab', '0', '-dc', '1', '-dt', '0', '-dj', '0', '-ds', '0')


def main(folder, lamp, way, setting, out):
    name = out[:-4] + '-scene'
    bake, shown = {'photons': photons, 'mkillum': mkillum}[way](lamp, folder, name, setting, out)
    print(f'{bake:.4f} {shown:.4f}')


main(*sys.argv[1:])
