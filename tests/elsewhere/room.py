"""The room of `make elsewhere`, include-pov/room.obj without its normals, and where lamp and camera
are, for all renderers. Coordinates are the lamp's, left-handed with y up, in centimetres.

  room.py light | camera    what renderslab is asked for
  room.py mesh ROOM.obj     the room as written there, with flat faces
  room.py radiance          the room for Radiance; room.py view, place: options of vwrays, of xform
  room.py picture RAW WxH OUT.pfm   what rtrace has written, rows from the top, as a picture
"""
import math
import os
import sys

import numpy as np

MESH = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../include-pov/room.obj')
SIZE = 240, 180
EYE, TARGET, FOV = (-60, 140, -290), (0, 80, 0), 50   # the angle is the horizontal one
TURN, MOVE = (-15, 40, 10), (-20, 160, 0)             # of the lamp: POV-Ray's rotate, translate


def rows(path, key):
    """The words after a key, of each line that has it."""
    with open(path, encoding='ascii') as stream:
        return [words[1:] for words in map(str.split, stream) if words and words[0] in key]


def parts():
    """Of each object: name, albedo, faces as lists of corners."""
    albedo, found = {}, {}
    for line in rows(MESH.replace('.obj', '.mtl'), ('newmtl', 'Kd')):
        if len(line) == 1:
            name = line[0]
        else:
            albedo[name] = tuple(map(float, line))
    corners = [(float(x), float(y), -float(z)) for x, y, z in rows(MESH, ('v',))]
    for line in rows(MESH, ('usemtl', 'f')):
        if len(line) == 1:
            material = line[0]
        else:
            found.setdefault(material, []).append([corners[int(word.split('/')[0]) - 1] for word in line])
    return [(name, albedo[name], faces) for name, faces in found.items()]


def z_up(p):
    """Radiance's and Blender's space."""
    return p[0], p[2], p[1]


def y_up(p):
    """Mitsuba's space, and that of meshes."""
    return p[0], p[1], -p[2]


def text(numbers):
    return ' '.join('%.9g' % number for number in numbers)


def matrix():
    """The lamp's place as POV-Ray's matrix: rows are the images of x, y, z and of the origin."""
    (a, p), (b, q), (c, r) = ((math.cos(math.radians(angle)), math.sin(math.radians(angle))) for angle in TURN)
    turn = (np.array([[c, -r, 0], [r, c, 0], [0, 0, 1]]) @ [[b, 0, q], [0, 1, 0], [-q, 0, b]] @ [[1, 0, 0], [0, a, -p], [0, p, a]])
    return [*turn.T.ravel(), *MOVE]


def view():
    """Horizontal and vertical angle."""
    half = math.tan(math.radians(FOV/2))
    return FOV, 2*math.degrees(math.atan(half*SIZE[1]/SIZE[0]))


def mesh():
    count = number = 0
    yield 'mtllib room.mtl'
    for name, _, faces in parts():
        yield f'usemtl {name}'
        for face in faces:
            corners = [np.array(y_up(corner)) for corner in face]
            number += 1
            yield from ('v ' + text(corner) for corner in corners)
            yield 'vn ' + text(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
            yield 'f ' + ' '.join(f'{count + 1 + k}//{number}' for k in range(len(face)))
            count += len(face)


def radiance():
    for name, albedo, faces in parts():
        yield f'void plastic paint_{name}\n0\n0\n5 {text(albedo)} 0 0'
        for k, face in enumerate(faces):
            yield f'paint_{name} polygon {name}{k}\n0\n0\n{3*len(face)} ' + ' '.join(text(z_up(corner)) for corner in face)


def write(path, rgb):
    """A picture, rows from the top, as PFM."""
    with open(path, 'wb') as stream:
        stream.write(b'PF\n%d %d\n-1.0\n' % (rgb.shape[1], rgb.shape[0]))
        stream.write(np.ascontiguousarray(rgb[::-1], '<f4').tobytes())


def main(task, *rest):
    (a, b, c), (x, y, z) = TURN, MOVE
    toward = z_up(np.subtract(TARGET, EYE))
    if task == 'light':
        print('matrix=' + ','.join('%.12g' % number for number in matrix()))
    elif task == 'camera':
        print('from=%g,%g,%g at=%g,%g,%g fov=%g' % (*EYE, *TARGET, FOV))
    elif task == 'mesh':
        with open(rest[0], 'w', encoding='ascii') as stream:
            stream.write('\n'.join(mesh()) + '\n')
    elif task == 'radiance':
        print('\n'.join(radiance()))
    elif task == 'view':
        print('-vtv -vp', text(z_up(EYE)), '-vd', text(toward), '-vu 0 0 1 -vh %.9g -vv %.9g' % view())
    elif task == 'picture':
        raw, size, out = rest
        width, height = map(int, size.split('x'))
        write(out, np.fromfile(raw, '<f4').reshape(height, width, 3))
    elif task == 'place':
        print('-rx', -a, '-rz', -b, '-ry', -c, '-t', x, z, y)


if __name__ == '__main__':
    main(*sys.argv[1:])
