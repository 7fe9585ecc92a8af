# slab_emitter.py - light slabs in Mitsuba 3.6 or newer, RGB variants; needs numpy. Public domain
# (CC0-1.0). import slab_emitter, after mi.set_variant, adds the emitter "slab"; NAME.xml shows it
# in XML, and lamp() makes the dict of a whole lamp:
#     scene = mi.load_dict({'type': 'scene', ..., **slab_emitter.lamp('NAME.json', to_world)})
#
# Frames: lamp space (x, y, z) is left-handed; it is (x, y, -z) here. The emitter belongs into a
# `rectangle` whose to_world maps x to u/2, y to v/2 and z to the normal, so that to_world alone
# places, scales and mirrors. Radiance of the ray through (a, b, s, t): light-slab(5).
#
# Sampling: a receiver at (q, r, z) in the page's frame sees the point a with the slope
# s = q/z + (kappa - 1/z) a, so that the window [s0, s1] leaves an interval of a.
# 1. A point of the aperture is found from the whole to its quarters, and so on (slab_cells.py): a
#    quarter's weight is its visible area times the mean over the cells of slopes, large enough,
#    through which the receiver sees it.
# 2. A ray from the lamp: (u, v) by the quarters of all light, (s, t) by those of the chosen cell.
import itertools
import json
import os

import drjit as dr
import mitsuba as mi
import numpy as np

from slab_cells import JIT, MOST_UV, Cells, bend, descend, fetch, quarter, ratio, table, taps


def read(path):
    """The pages of NAME.json."""
    with open(path, encoding='utf-8') as file:
        lamp = json.load(file)
    if lamp.get('format') != 'light-slab-pages' or lamp.get('version') != 1:
        raise ValueError(f'{path}: is no lamp of bakeslab export, version 1')
    return lamp['pages']


def page_to_world(page):
    """The rectangle [-1, 1]^2 at z = 0 becomes the aperture."""
    matrix = np.eye(4)
    for column, (key, scale) in enumerate((('u', .5), ('v', .5), ('normal', 1), ('center', 1))):
        matrix[:3, column] = np.array(page[key]) * (scale, scale, -scale)
    return mi.ScalarTransform4f(matrix)


def lamp(path, to_world=None, gain=1.0, sampling='energy'):
    """Shapes for mi.load_dict, one a page, placed by a mi.ScalarTransform4f."""
    place = to_world or mi.ScalarTransform4f()
    name = os.path.splitext(os.path.basename(path))[0]
    return {
        f'{name}_page_{number}': {
            'type': 'rectangle', 'to_world': place @ page_to_world(page), 'bsdf': {'type': 'null'},
            'emitter': {'type': 'slab', 'filename': path, 'page': number, 'gain': float(gain),
                        'sampling': sampling}}
        for number, page in enumerate(read(path))}


class Slab(mi.Emitter):
    def __init__(self, props):
        mi.Emitter.__init__(self, props)
        if not mi.is_rgb or mi.is_polarized:
            raise ValueError('slab: needs an RGB variant of Mitsuba that is not polarised')
        path = str(mi.file_resolver().resolve(props['filename']))
        pages, number = read(path), props.get('page', 0)
        if not 0 <= number < len(pages):
            raise ValueError(f'slab: {path} has no page {number}; the first is 0')
        page = pages[number]
        self.sampling = props.get('sampling', 'energy')
        if self.sampling not in ('energy', 'visible'):
            raise ValueError(f'slab: sampling {self.sampling}: must be energy or visible')
        nu, nv, ns, nt = self.samples = page['samples']
        image = mi.Bitmap(os.path.join(os.path.dirname(path), page['image']))
        image = np.array(image.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))
        if image.shape[:2] != (nv * nt, nu * ns):
            raise ValueError(f'slab: {page["image"]}: its size contradicts {path}')
        light = image.reshape(nv, nt, nu, ns, 3).transpose(0, 2, 1, 3, 4) * props.get('gain', 1.0)
        self.radiances = table(light.ravel(), mi.Float)
        self.window = [float(x) for x in page['st_window']]
        self.edges = [float(np.linalg.norm(page[key])) for key in 'uv']
        self.kappa = 1 / page['st_distance'] if page.get('st_distance') else 0.0
        self.cells = Cells(page, light)
        self.m_flags = mi.EmitterFlags.Surface | mi.EmitterFlags.SpatiallyVarying
        self.m_needs_sample_2 = self.m_needs_sample_3 = True

    def frame(self):
        """Middle, unit u and v, normal in the scene, and lamp units a unit there: of the shape."""
        shape = self.get_shape()
        middle, right, up = (shape.eval_parameterization(mi.Point2f(x, y))
                             for x, y in ((.5, .5), (1, .5), (.5, 1)))
        u, v = right.p - middle.p, up.p - middle.p
        half = dr.norm(u)
        return middle.p, u / half, dr.normalize(v), mi.Vector3f(middle.n), self.edges[0] / (2 * half)

    def local(self, frame, point):
        middle, u, v, n, unit = frame
        d = (point - middle) * unit
        return dr.dot(d, u), dr.dot(d, v), dr.dot(d, n)

    def ray(self, frame, point, direction):
        """a, b, s, t of a ray from the aperture, and whether it leaves to the front."""
        a, b, _ = self.local(frame, point)
        cosine = dr.dot(direction, frame[3])
        front = cosine > 1e-9
        cosine = dr.select(front, cosine, 1)
        return (a, b, dr.dot(direction, frame[1]) / cosine + self.kappa * a,
                dr.dot(direction, frame[2]) / cosine + self.kappa * b, front)

    def radiance(self, a, b, s, t, active):
        """Quadrilinear; 0 outside."""
        (lu, lv), (s0, s1, t0, t1) = self.edges, self.window
        active = active & (s >= s0) & (s <= s1) & (t >= t0) & (t <= t1)
        active = active & (dr.abs(a) < .5000005 * lu) & (dr.abs(b) < .5000005 * lv)  # rounded
        ranges = (-lu / 2, lu / 2), (-lv / 2, lv / 2), (s0, s1), (t0, t1)
        taps = []
        for x, (low, high), count in zip((a, b, s, t), ranges, self.samples):
            x = dr.clip((x - low) / (high - low) * count - .5, 0, count - 1)
            i = dr.minimum(mi.UInt32(x), max(count - 2, 0))
            x = x - mi.Float(i)
            taps.append(((i, 1 - x), (dr.minimum(i + 1, count - 1), x)) if count > 1 else ((i, 1),))
        nu, _, ns, nt = self.samples
        total = mi.Color3f(0)
        for (i, wi), (j, wj), (k, wk), (l, wl) in itertools.product(*taps):
            pixel = ((j * nu + i) * nt + l) * ns + k
            total += fetch(self.radiances, pixel, active, mi.Color3f) * (wj * wi * wl * wk)
        return dr.select(active, total, mi.Color3f(0))

    def seen(self, axis, q, z):
        """The interval of a (axis 0) or b (1) that the window leaves a receiver."""
        half, (low, high) = self.edges[axis] / 2, self.window[2 * axis:2 * axis + 2]
        g = 1 - self.kappa * z
        g = dr.select(dr.abs(g) < 1e-7, dr.select(g < 0, mi.Float(-1e-7), mi.Float(1e-7)), g)
        ends = (q - low * z) / g, (q - high * z) / g
        return (dr.clip(dr.minimum(*ends), -half, half), dr.clip(dr.maximum(*ends), -half, half))

    def warp(self, receiver, seen, active, sample=None, point=None):
        """The point that a sample of the unit square becomes, or the given one, and its density
        by area in lamp units: 0 where it is never chosen."""
        blocks, share, x, places = [mi.UInt32(0), mi.UInt32(0)], mi.Float(1), sample, []
        levels = MOST_UV.bit_length() - 1 if self.sampling == 'energy' else 0
        for level in range(1, levels + 1):
            weights = self.quarters(level, blocks, receiver, seen, active)
            split = [mi.Float(2 * block + 1) * (edge / (1 << level)) - edge / 2
                     for block, edge in zip(blocks, self.edges)]
            blocks, share, x = quarter(weights, blocks, share, x, point, split)
        means = self.means(levels, blocks, receiver, active)
        for value, axis, values in zip(point or x, (0, 1), means):
            ends = self.part(axis, levels, blocks[axis], seen[axis])
            width = self.edges[axis] / (1 << levels)
            middle = self.middle(axis, levels, blocks[axis])
            place, density = bend(ends, middle, width, values, value, point is not None)
            places.append(place)
            share = share * density
            slack = 1e-6 * self.edges[axis]
            active = active & (place >= ends[0] - slack) & (place <= ends[1] + slack)
        return places, dr.select(active, share, 0)

    def middle(self, axis, level, block):
        """Of one of the 2^level blocks of an axis."""
        return (mi.Float(block) + .5) * (self.edges[axis] / (1 << level)) - self.edges[axis] / 2

    def part(self, axis, level, block, seen):
        """What is seen of a block: low and high end."""
        middle, half = self.middle(axis, level, block), self.edges[axis] / (2 << level)
        return dr.maximum(middle - half, seen[0]), dr.minimum(middle + half, seen[1])

    def mip(self, level, z):
        """That whose cells are as large as what is seen through a block; how many these are."""
        turn = dr.abs(self.kappa - 1 / z) / (1 << level)  # slopes seen through a block, by its edge
        s0, s1, t0, t1 = self.window
        cells = [turn * edge / (high - low) * count for edge, low, high, count in
                 zip(self.edges, (s0, t0), (s1, t1), self.cells.st)]
        mip = dr.ceil(dr.log2(dr.maximum(dr.maximum(*cells), 1)))
        mip = mi.UInt32(dr.minimum(mip, self.cells.mips - 1))
        return mip, self.cells.size(mip)

    def towards(self, axis, place, receiver, size):
        """The cells of slopes through which the receiver sees a place."""
        slope = (receiver[axis] - place) / receiver[2] + self.kappa * place
        low, high = self.window[2 * axis:2 * axis + 2]
        return taps((slope - low) / (high - low) * mi.Float(size[axis]), size[axis])

    def quarters(self, level, blocks, receiver, seen, active):
        """Weights [right][upper] of a block's quarters, which are blocks of `level`."""
        mip, size = self.mip(level, receiver[2])
        sides = []  # of each axis, of each half: block, what is seen of it, cells of slopes
        for axis in (0, 1):
            halves = []
            for k in (0, 1):
                block = 2 * blocks[axis] + k
                ends = self.part(axis, level, block, seen[axis])
                cells = self.towards(axis, (ends[0] + ends[1]) / 2, receiver, size)
                halves.append((block, dr.maximum(ends[1] - ends[0], 0), cells))
            sides.append(halves)
        return [[right[1] * upper[1] * self.cells.between(
            level, (right[0], upper[0]), mip, (right[2], upper[2]), active)
                 for upper in sides[1]] for right in sides[0]]

    def means(self, level, blocks, receiver, active):
        """For each axis those of the block before, of the block, and of the next one."""
        if level == 0:
            return ((mi.Float(1),) * 3,) * 2
        mip, size = self.mip(level, receiver[2])

        def mean(*at):
            cells = [self.towards(axis, self.middle(axis, level, at[axis]), receiver, size)
                     for axis in (0, 1)]
            return self.cells.between(level, at, mip, cells, active)

        before = [dr.maximum(block, 1) - 1 for block in blocks]
        after = [dr.minimum(block + 1, (1 << level) - 1) for block in blocks]
        own = mean(*blocks)
        return ((mean(before[0], blocks[1]), own, mean(after[0], blocks[1])),
                (mean(blocks[0], before[1]), own, mean(blocks[0], after[1])))

    def view(self, it, active):
        """The frame, the receiver in it, what it sees of the aperture, and whether it does."""
        frame = self.frame()
        receiver = self.local(frame, it.p)
        front = receiver[2] > 1e-9 * self.edges[0]
        receiver = receiver[:2] + (dr.select(front, receiver[2], 1),)
        seen = [self.seen(k, receiver[k], receiver[2]) for k in (0, 1)]
        return frame, receiver, seen, active & front

    def density(self, frame, ds, density, active):
        """By solid angle, of a density by area in lamp units."""
        density = density * frame[4] ** 2 * ds.dist * ds.dist
        return dr.select(active, ratio(density, dr.maximum(-dr.dot(ds.d, frame[3]), 0)), 0)

    def sample_direction(self, it, sample, active=True):
        frame, receiver, seen, active = self.view(it, active)
        (a, b), density = self.warp(receiver, seen, active, sample=(sample.x, sample.y))
        middle, u, v, n, unit = frame
        ds = mi.DirectionSample3f()
        ds.p = middle + u * (a / unit) + v * (b / unit)
        ds.n = mi.Normal3f(n)
        ds.uv = mi.Point2f(a / self.edges[0] + .5, b / self.edges[1] + .5)
        ds.time, ds.delta = it.time, mi.Bool(False)
        ds.emitter = mi.EmitterPtr(self) if JIT else self
        ds.d = ds.p - it.p
        ds.dist = dr.norm(ds.d)
        ds.d = ds.d / ds.dist
        ds.pdf = self.density(frame, ds, density, active)
        light = self.eval_direction(it, ds, active & (ds.pdf > 0))
        return ds, dr.select(ds.pdf > 0, light / dr.select(ds.pdf > 0, ds.pdf, 1), mi.Color3f(0))

    def pdf_direction(self, it, ds, active=True):
        frame, receiver, seen, active = self.view(it, active)
        _, density = self.warp(receiver, seen, active, point=self.local(frame, ds.p)[:2])
        return self.density(frame, ds, density, active)

    def eval_direction(self, it, ds, active=True):
        *abst, front = self.ray(self.frame(), ds.p, -ds.d)
        return self.radiance(*abst, front & active)

    def eval(self, si, active=True):
        *abst, front = self.ray(self.frame(), si.p, si.to_world(si.wi))
        return self.radiance(*abst, front & active)

    def sample_position(self, time, sample, active=True):
        ps = self.get_shape().sample_position(time, sample, active)
        return ps, dr.select(active, ratio(1, ps.pdf), 0)

    def sample_wavelengths(self, si, sample, active=True):
        return mi.Color0f(), self.eval(si, active)

    def sample_ray(self, time, wavelength_sample, sample2, sample3, active=True):
        cells, top, zero = self.cells, self.cells.mips - 1, mi.UInt32(0)
        (x, y), uv, share = descend(range(1, cells.most + 1), lambda level, blocks: cells.at(
            level, blocks, top, (zero, zero), active), (sample2.x, sample2.y), mi.Float(1))

        def towards(mip, slopes):  # blocks of 2^(top - mip) an axis; an axis may have fewer cells
            excess = [top - mip - max(0, n.bit_length() - 1 - mip) for n in cells.st]
            return cells.at(cells.most, uv, mip, [k >> e for k, e in zip(slopes, excess)], active)

        (z, w), st, share = descend(range(top - 1, -1, -1), towards, (sample3.x, sample3.y), share)
        (lu, lv), (s0, s1, t0, t1) = self.edges, self.window
        a = ((mi.Float(uv[0]) + x) / (1 << cells.most) - .5) * lu
        b = ((mi.Float(uv[1]) + y) / (1 << cells.most) - .5) * lv
        s = s0 + (s1 - s0) * (mi.Float(st[0]) + z) / (1 << top)
        t = t0 + (t1 - t0) * (mi.Float(st[1]) + w) / (1 << top)
        middle, u, v, n, unit = self.frame()
        right, up = s - self.kappa * a, t - self.kappa * b
        # d(area) cos d(solid angle) = da db ds dt / (1 + right^2 + up^2)^2
        volume = lu * lv * (s1 - s0) * (t1 - t0) * 0.25 ** (cells.most + top)
        weight = ratio(volume, dr.square(1 + right * right + up * up) * unit * unit * share)
        direction = dr.normalize(n + u * right + v * up)
        start = middle + u * (a / unit) + v * (b / unit) + direction * (1e-6 * lu / unit)
        light = self.radiance(a, b, s, t, active)
        return mi.Ray3f(start, direction, time, mi.Color0f()), light * weight


mi.register_emitter('slab', Slab)
