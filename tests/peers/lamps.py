"""The lamps lamps/parabolic.pov and lamps/headlight.pov as triangles and spheres, for renderers
that have no quadrics, and the floor that they light.

Centimetres, in scene space: POV-Ray's, left-handed, y up. The lamp's aperture is in y = 0, since
renderers offset rays in proportion to coordinates (Mitsuba by 0.07 cm at 800: as much as the
headlight's filament is thick); it shines down on a floor HEIGHT below. A sphere of a bulb is exact; curved walls are triangles with the normals
of the true surface, fine enough that neither area nor reflection is off by more than 1e-4.
Numbers are those of the scripts; `run.sh` compares the light of the two.

  lamps.py LAMP FOLDER   writes into FOLDER: PART.obj, right-handed (z is mirrored), PART being
                         matt-ALBEDO-NAME or mirror-RHO-NAME; floor.obj with floor.mtl; camera-K,
                         the cameras for renderslab; floor.inc, floor and first camera for
                         POV-Ray, in the space of the lamp's script
"""
import math
import os
import sys

import numpy as np

HEIGHT = {'parabolic': 100.0, 'headlight': 800.0}   # of the lamp; the scene is as large
ALBEDO = 0.2       # of the floor: low, since what it sends back into the lamp is not compared
# In heights of the lamp:
FLOOR = 4.0        # half its side
POST = ((0.22, 0, -0.04), (0.30, 0.25, 0.04))   # two corners; black
EYE = (1.2, 1.5)   # from the axis, and above the floor
SIZE = 128         # pixels a side
FOV = 40.0         # horizontal and vertical


def camera(name, view):
    """Eye and target of view 0 to 9: a circle around the lamp; the lamp itself is out of sight."""
    angle = 2*math.pi*view/10
    eye = np.array((EYE[0]*math.sin(angle), EYE[1] - 1, -EYE[0]*math.cos(angle)))
    return eye*HEIGHT[name], np.array((0, -HEIGHT[name], 0))


class Part:
    """A triangle mesh: points (n,3), normals (n,3) or None, triangles (m,3) of one material."""

    def __init__(self, name, points, triangles, normals=None):
        self.name, self.points = name, np.asarray(points, float)
        self.triangles = np.asarray(triangles, int)
        self.normals = None if normals is None else np.asarray(normals, float)

    def turned(self, turn):
        normals = None if self.normals is None else self.normals @ turn.T
        return Part(self.name, self.points @ turn.T, self.triangles, normals)


def grid(name, position, rows, columns, normal=None):
    """A surface position(row, column), both from 0 to 1, as rows x columns cells of two triangles."""
    where = [(i/rows, j/columns) for i in range(rows + 1) for j in range(columns + 1)]
    points = [position(a, b) for a, b in where]
    normals = [normal(a, b) for a, b in where] if normal else None
    triangles = []
    for i in range(rows):
        for j in range(columns):
            k = i*(columns + 1) + j
            triangles += [(k, k + 1, k + columns + 2), (k, k + columns + 2, k + columns + 1)]
    part = Part(name, points, triangles, normals)
    if normals:   # windings as the normals
        a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
        wrong = (np.cross(b - a, c - a)*part.normals[part.triangles[:, 0]]).sum(axis=1) < 0
        part.triangles[wrong] = part.triangles[wrong][:, ::-1]
    return part


def box(name, low, high, faces='xXyYzZ'):
    """The faces of a box that are named: x at its low x, X at its high x. Normals point outwards."""
    points, normals, triangles = [], [], []
    for face in faces:
        axis, side = 'xyz'.index(face.lower()), face.isupper()
        across = [k for k in range(3) if k != axis]
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
            point = np.array((low, high)[side], float)
            point[across] = (low, high)[a][across[0]], (low, high)[b][across[1]]
            points.append(point)
            normals.append(np.eye(3)[axis]*(1 if side else -1))
        n = len(points)
        triangles += [(n - 4, n - 3, n - 2), (n - 4, n - 2, n - 1)]
    return Part(name, points, triangles, normals)


def turned(radius, y, angle):
    return (radius*math.cos(2*math.pi*angle), y, radius*math.sin(2*math.pi*angle))


def parabolic():
    radius, focus, height, thick = 10.0, 2.5, 4.0, 0.2
    top = height + radius*radius/(4*focus)
    parts = [grid('matt-0.8-bowl', lambda a, b: turned(a*radius, top - (a*radius)**2/(4*focus), b), 64, 256),
             grid('matt-0.02-collar', lambda a, b: turned(radius, 0.1 + a*(height - 0.1), b), 1, 256)]
    for i in (-1, 0, 1):
        at, half = i*radius/2, math.sqrt(radius*radius - (i*radius/2)**2)
        parts += [box(f'matt-0.02-along{i}', (-half, 0.1, at - thick/2), (half, height, at + thick/2)),
                  box(f'matt-0.02-across{i}', (at - thick/2, 0.1, -half), (at + thick/2, height, half))]
    return parts, [((0, top - focus, 0), 1.5, 500.0)], np.eye(3)


def facet(x0, y0, wide, high, up, right, focal, focus):
    """A piece of a paraboloid about `focus`, turned by up and right (degrees), above a rectangle."""
    a, b = -math.radians(up), math.radians(right)
    about_x = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    about_y = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    turn = about_y @ about_x
    along = turn.T @ (0, 0, 1)

    def local(s, t):   # on x^2 + y^2 = 4 f (z + f), where the line along z meets it first
        start = turn.T @ (x0 + s*wide - focus[0], y0 + t*high - focus[1], 0)
        qa = along[0]**2 + along[1]**2
        qb = 2*(start[0]*along[0] + start[1]*along[1]) - 4*focal*along[2]
        qc = start[0]**2 + start[1]**2 - 4*focal*(start[2] + focal)
        return start + 2*qc/(-qb + math.sqrt(qb*qb - 4*qa*qc))*along

    def normal(s, t):
        p = local(s, t)
        n = np.array([-p[0], -p[1], 2*focal])
        return turn @ n/np.linalg.norm(n)

    return grid('mirror-0.88-facet', lambda s, t: turn @ local(s, t) + focus, 4, 16, normal)


def joined(parts):
    """Parts of one material as one."""
    starts = np.cumsum([0] + [len(p.points) for p in parts])
    return Part(parts[0].name, np.concatenate([p.points for p in parts]),
                np.concatenate([p.triangles + s for p, s in zip(parts, starts)]),
                np.concatenate([p.normals for p in parts]))


def below(part, z):
    """What of a part is below a plane of constant z: the corners of each triangle, cut there."""
    points, normals, triangles = [], [], []
    for triangle in part.triangles:
        kept = []
        for k in range(3):
            a, b = triangle[k], triangle[(k + 1) % 3]
            za, zb = part.points[a][2] - z, part.points[b][2] - z
            if za <= 0:
                kept.append((part.points[a], part.normals[a]))
            if za*zb < 0:
                w = za/(za - zb)
                kept.append(((1 - w)*part.points[a] + w*part.points[b], (1 - w)*part.normals[a] + w*part.normals[b]))
        triangles += [(len(points), len(points) + k, len(points) + k + 1) for k in range(1, len(kept) - 1)]
        points += [p for p, _ in kept]
        normals += [n for _, n in kept]
    return Part(part.name, points, triangles, normals)


def headlight():
    width, height, columns, rows, focal, filament = 18.0, 12.0, 36, 6, 2.6, 0.25
    focus = np.array((0, 0, -9.0))
    facets = []
    for i in range(columns):
        for j in range(rows):
            x0, y0 = i*width/columns - width/2, j*height/rows - height/2
            x, y = x0 + width/columns/2, y0 + height/rows/2
            image = math.degrees(math.atan2(filament, focal + (x*x + y*y)/(4*focal)))
            right, up = 22*math.sin(math.pi*2*x/width), -image - 0.4
            if x < -0.28*width:
                right = image + 14*abs(math.sin(math.pi*2*x/width))
                up += 0.26*right
            facets.append(facet(x0, y0, width/columns, height/rows, up, right, focal, focus))
    mirror = below(joined(facets), -0.01)

    def shell(radius):   # of the cap, in front of z = focus + 0.5
        last = math.acos(0.5/radius)
        return grid(f'matt-0.01-cap{radius}', lambda a, b: np.array(turned(radius*math.sin(a*last), 0, b))[[0, 2, 1]]
                    + (0, 0, focus[2] + radius*math.cos(a*last)), 32, 128)

    def rim(a, b):
        inner, outer = math.sqrt(1 - 0.25), math.sqrt(1.1**2 - 0.25)
        return np.array(turned(inner + a*(outer - inner), 0, b))[[0, 2, 1]] + (0, 0, focus[2] + 0.5)

    parts = [mirror, shell(1.0), shell(1.1), grid('matt-0.01-rim', rim, 1, 128),
             box('matt-0.01-walls', (-width/2, -height/2, -12.7), (width/2, height/2, -0.01), 'xXyYz')]
    bulbs = [((0, 0, focus[2] + i*filament*2/3), filament/3, 20000*0.93) for i in (-1, 0, 1)]   # green
    return parts, bulbs, np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])   # rotate 90*x


def lamp(name):
    """Parts and bulbs (centre, radius, radiance) of a lamp in scene space."""
    parts, bulbs, turn = {'parabolic': parabolic, 'headlight': headlight}[name]()
    return [p.turned(turn) for p in parts], [(turn @ np.array(c), r, l) for c, r, l in bulbs]


def scene(name):
    """What the lamp lights: a floor, and a post on it."""
    size = HEIGHT[name]
    return [box('floor', (-FLOOR*size, -size, -FLOOR*size), (FLOOR*size, -size, FLOOR*size), 'Y'),
            box('post', *(np.array(POST) - (0, 1, 0))*size, 'xXzZY')]


def write_obj(stream, part, first=1):
    for p in part.points*(1, 1, -1):
        stream.write('v %.9g %.9g %.9g\n' % tuple(p))
    if part.normals is not None:
        for n in part.normals*(1, 1, -1):
            stream.write('vn %.9g %.9g %.9g\n' % tuple(n))
    for t in part.triangles[:, ::-1] + first:
        stream.write('f ' + ' '.join(f'{k}//{k}' if part.normals is not None else str(k) for k in t) + '\n')


def camera_text(name, view):
    eye, target = (','.join(f'{x:.9g}' for x in p) for p in camera(name, view))
    return f'from={eye} at={target} fov={FOV:g}'


def pov_floor(name):
    """Turned back from scene space to that of the script."""
    size, turn = HEIGHT[name], 'rotate -90*x' if name == 'headlight' else ''
    eye, target = ('<%.9g, %.9g, %.9g>' % tuple(p) for p in camera(name, 0))
    post = ', '.join('<%.9g, %.9g, %.9g>' % tuple((np.array(p) - (0, 1, 0))*size) for p in POST)
    return (f'#declare Matt = finish {{ diffuse 1 ambient 0 }}\n'
            f'plane {{ y, {-size} pigment {{ rgb {ALBEDO} }} finish {{ Matt }} {turn} no_radiosity }}\n'
            f'box {{ {post} pigment {{ rgb 0 }} finish {{ Matt }} {turn} }}\n'
            f'camera {{ location {eye} right x up y look_at {target} angle {FOV:g} {turn} }}\n')


def main(name, folder):
    os.makedirs(folder, exist_ok=True)

    def write(file, text):
        with open(f'{folder}/{file}', 'w', encoding='ascii') as stream:
            stream.write(text)

    for part in lamp(name)[0]:
        with open(f'{folder}/{part.name}.obj', 'w', encoding='ascii') as stream:
            write_obj(stream, part)
    with open(f'{folder}/floor.obj', 'w', encoding='ascii') as stream:
        stream.write('mtllib floor.mtl\n')
        first = 1
        for part in scene(name):
            stream.write(f'usemtl {part.name}\n')
            write_obj(stream, part, first)
            first += len(part.points)
    write('floor.mtl', f'newmtl floor\nKd {ALBEDO} {ALBEDO} {ALBEDO}\nnewmtl post\nKd 0 0 0\n')
    write('floor.inc', pov_floor(name))
    for view in range(10):
        write(f'camera-{view}', camera_text(name, view))


if __name__ == '__main__':
    main(*sys.argv[1:])
