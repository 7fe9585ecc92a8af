"""The table and the pictures of `make elsewhere`: elsewhere.md, elsewhere.png.

Two pictures differ by the RMS of their difference over that of their mean, all channels, without
the pixels of silhouettes: those whose nine rays (corners, middles of edges, centre) meet more
than one object, surfaces that are turned by more than 20 degrees, or distances more than 20 cm
apart. Pictures with noise are drawn twice: their noise is that of one, over the square root of 2
in their mean, which is compared.
"""
import os
import subprocess

import numpy as np

import room

WAYS = {'povray': 'POV-Ray', 'renderslab': 'renderslab', 'cycles': 'Cycles', 'radiance': 'Radiance', 'mitsuba': 'Mitsuba'}
WIDTH, HEIGHT = room.SIZE


def numbers(path):
    """Of a picture, rows from the top."""
    if path.endswith('.exr'):
        text = subprocess.run(('oiiotool', '--dumpdata', path), capture_output=True, text=True, check=True).stdout
        rows = [line.split(':')[1].split()[:3] for line in text.splitlines() if 'Pixel (' in line]
        return np.array(rows, float)
    with open(path, 'rb') as stream:
        for _ in range(3):
            stream.readline()
        return np.fromfile(stream, '<f4').astype(float)


def read(path):
    """A picture; means of four where it is twice as fine."""
    rgb = numbers(path).ravel()
    fine = round((rgb.size/3/WIDTH/HEIGHT)**0.5)
    rgb = rgb.reshape(HEIGHT*fine, WIDTH*fine, 3)
    if path.endswith('.pfm'):
        rgb = rgb[::-1]
    return rgb.reshape(HEIGHT, fine, WIDTH, fine, 3).mean((1, 3))


def directions():
    """Of the rays through corners, edges and centres of all pixels; their distances are along the
    view's axis."""
    ahead = np.subtract(room.TARGET, room.EYE).astype(float)
    ahead /= np.linalg.norm(ahead)
    right = np.cross((0, 1, 0), ahead)      # left-handed
    right /= np.linalg.norm(right)
    up = np.cross(ahead, right)
    half = np.tan(np.radians(room.view())/2)
    x, y = (half[k]*np.linspace(-1, 1, 2*n + 1) for k, n in enumerate(room.SIZE))
    return ahead + x[None, :, None]*right - y[:, None, None]*up


def meet(rays):
    """What the rays meet first: distance, number of the object, normal."""
    distance, what = np.full(rays.shape[:2], np.inf), np.full(rays.shape[:2], -1)
    normal = np.zeros_like(rays)
    for number, (_, _, faces) in enumerate(room.parts()):
        for face in faces:
            corners = np.subtract(face, room.EYE)
            n = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            n = n/np.linalg.norm(n)
            with np.errstate(divide='ignore', invalid='ignore'):
                t = (corners[0] @ n)/(rays @ n)
            at, inside = rays*t[..., None], (t > 0) & (t < distance)
            turns = [((at - p) @ np.cross(n, q - p)) for p, q in zip(corners, np.roll(corners, -1, 0))]
            inside &= np.all(np.greater_equal(turns, 0), 0) | np.all(np.less_equal(turns, 0), 0)
            distance[inside], what[inside], normal[inside] = t[inside], number, n
    facing = np.sign((normal*rays).sum(-1, keepdims=True))
    return distance, what, normal*facing


def nine(values):
    """Of each pixel, those of its nine rays."""
    return np.stack([values[j:j + 2*HEIGHT:2, i:i + 2*WIDTH:2] for j in range(3) for i in range(3)])


def smooth():
    """The pixels that are compared."""
    distance, what, normal = map(nine, meet(directions()))
    apart = distance.max(0) - distance.min(0)
    turned = (normal*normal[4]).sum(-1).min(0)
    return (what.max(0) == what.min(0)) & (what.min(0) >= 0) & (apart < 20) & (turned > np.cos(np.radians(20)))


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


def off(a, b):
    return rms(a - b)/rms((a + b)/2)


def show(pictures):
    """All pictures side by side, equally bright."""
    whole = np.concatenate([pictures.get(way, np.zeros((HEIGHT, WIDTH, 3))) for way in WAYS], 1)
    white = np.percentile(np.concatenate(list(pictures.values())), 99.5)
    room.write('elsewhere.pfm', whole/white)
    subprocess.run(('oiiotool', 'elsewhere.pfm', '--powc', '0.4545', '--clamp:min=0:max=1', '-d', 'uint8', '-o', 'elsewhere.png'), check=True)


def main():
    seconds, pictures, noise, absent = {}, {}, {}, {}
    for way in WAYS:
        if os.path.exists(f'{way}.absent'):
            with open(f'{way}.absent', encoding='utf-8') as stream:
                absent[way] = stream.read().strip().replace('|', '/')
            continue
        with open(f'{way}.cpu', encoding='ascii') as stream:
            seconds[way] = float(stream.read())
        drawn = [read(name) for k in (1, 2) for name in (f'{way}-{k}.exr', f'{way}-{k}.pfm') if os.path.exists(name)]
        pictures[way] = np.mean(drawn, 0)
        noise[way] = drawn
    compared = smooth()
    lines = ['| | CPU s | noise | ' + ' | '.join(WAYS.values()) + ' |', '|---'*(3 + len(WAYS)) + '|']
    for way, name in WAYS.items():
        if way in absent:
            lines.append(f'| {name} | {absent[way]}' + ' | '*(1 + len(WAYS)) + ' |')
            continue
        drawn = [picture[compared] for picture in noise[way]]
        told = f'{100*off(*drawn)/2:.2f} %' if len(drawn) == 2 else 'none'
        cells = ['' if other == way or other in absent else f'{100*off(pictures[way][compared], pictures[other][compared]):.2f}' for other in WAYS]
        lines.append(f'| {name} | {seconds[way]:.3g} | {told} | ' + ' | '.join(cells) + ' |')
    lines += ['', f'{100*compared.mean():.0f} % of the pixels are compared.']
    with open('elsewhere.md', 'w', encoding='utf-8') as stream:
        stream.write('\n'.join(lines) + '\n')
    print('\n'.join(lines))
    show(pictures)


main()
