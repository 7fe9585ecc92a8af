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
# 1. Cells: means of radiance times cos^4 over cells of (u, v, s, t), and those of 2x2 cells in
#    (u, v) and in (s, t), again and again.
# 2. A point of the aperture is found from the whole to its quarters, and so on (hierarchical
#    sample warping, Clarberg et al. 2005): a quarter's weight is its visible area times the mean
#    over the cell of slopes, large enough, through which the receiver sees it.
# 3. A ray from the lamp: (u, v) by the quarters of all light, (s, t) by those of the chosen cell.
import itertools
import json
import os

import drjit as dr
import mitsuba as mi
import numpy as np

JIT = dr.is_jit_v(mi.Float)
MOST_UV, MOST_ST = 16, 256  # cells an axis


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


def cell_means(count, cells):
    """Matrix: the means, over cells of an axis, of what is linear between `count` samples."""
    points = 8 * max(1, count // cells)
    x = np.clip((np.arange(cells * points) + .5) / (cells * points) * count - .5, 0, count - 1)
    low = np.minimum(x.astype(int), max(count - 2, 0))
    rows, matrix = np.arange(len(x)), np.zeros((len(x), count))
    matrix[rows, low] += 1 - (x - low)
    matrix[rows, np.minimum(low + 1, count - 1)] += x - low
    return matrix.reshape(cells, points, count).mean(1)


def halve(cells, axis):
    """Means of two neighbours; a single cell stays."""
    if cells.shape[axis] == 1:
        return cells
    pairs = cells.shape[:axis] + (cells.shape[axis] // 2, 2) + cells.shape[axis + 1:]
    return cells.reshape(pairs).mean(axis + 1)


def spread(cells, axis):
    """Each cell and a share of its neighbours, so that a slope near a border finds both sides."""
    count, sides = cells.shape[axis], [(int(k == axis),) * 2 for k in range(4)]
    wide = np.pad(cells, sides, 'edge')
    return sum(wide.take(range(k, k + count), axis) * w for k, w in enumerate((.25, .5, .25)))


class Cells:
    """Means over cells of (v, u, t, s), at every level: level 0 of uv is the whole aperture, level
    0 of st the finest. Of a uv level, `first` is where it begins in `data`, `counts` its size."""

    def __init__(self, page, light):
        nu, nv, ns, nt = page['samples']
        power = [1 << max(0, n - 1).bit_length() for n in (nu, nv, ns, nt)]
        self.uv = [min(n, MOST_UV) for n in power[:2]]
        self.st = [min(n, MOST_ST) for n in power[2:]]
        matrices = [cell_means(n, c) for n, c in
                    ((nv, self.uv[1]), (nu, self.uv[0]), (nt, self.st[1]), (ns, self.st[0]))]
        y = np.abs(light) @ np.array((.2126, .7152, .0722))
        cells = np.einsum('jv,iu,lt,ks,vuts->jilk', *matrices, y, optimize=True)
        cells = cells * self.cosine4(page)
        by_level = [cells]
        while by_level[0].shape[0] > 1 or by_level[0].shape[1] > 1:
            by_level.insert(0, halve(halve(by_level[0], 0), 1))
        self.most = len(by_level) - 1
        self.mips = max(self.st).bit_length()
        sizes = [max(1, self.st[0] >> mip) * max(1, self.st[1] >> mip) for mip in range(self.mips)]
        self.before = table(np.cumsum([0] + sizes[:-1]), mi.UInt32)
        self.counts, self.first, data = [], [], []
        for cells in by_level:
            self.counts.append(cells.shape[1::-1])
            self.first.append(sum(map(len, data)))
            for _ in range(self.mips):
                data.append(spread(spread(cells, 2), 3).ravel())
                cells = halve(halve(cells, 2), 3)
        self.data = table(np.concatenate(data), mi.Float)

    def cosine4(self, page):
        """cos^4 of the middle of each cell: d(solid angle) cos = cos^4 ds dt."""
        s0, s1, t0, t1 = page['st_window']
        kappa = 1 / page['st_distance'] if page.get('st_distance') else 0.0
        middles = [(np.arange(n) + .5) / n for n in (*self.uv, *self.st)]
        a = (middles[0] - .5) * np.linalg.norm(page['u'])
        b = (middles[1] - .5) * np.linalg.norm(page['v'])
        s, t = s0 + (s1 - s0) * middles[2], t0 + (t1 - t0) * middles[3]
        x = (s[None, :] - kappa * a[:, None])[None, :, None, :]
        y = (t[None, :] - kappa * b[:, None])[:, None, :, None]
        return 1 / (1 + x * x + y * y) ** 2

    def size(self, mip):
        """Cells along s and t."""
        return [dr.maximum(mi.UInt32(n) >> mip, 1) for n in self.st]

    def at(self, level, blocks, mip, slopes, active):
        """The mean of a block of the aperture, of 2^level x 2^level, towards cell `slopes`."""
        known = min(level, self.most)
        i, j = (mi.UInt32(block) >> (level - (n.bit_length() - 1))
                for block, n in zip(blocks, self.counts[known]))
        nu, nv = self.counts[known]
        width, height = self.size(mip)
        start = nu * nv * fetch(self.before, mi.UInt32(mip), active) + self.first[known]
        cell = ((j * nu + i) * height + slopes[1]) * width + slopes[0]
        return fetch(self.data, start + cell, active)


def table(values, kind):
    """For fetch()."""
    if not JIT:
        return np.asarray(values).tolist()
    return kind(np.asarray(values, np.uint32 if kind is mi.UInt32 else np.float32))


def fetch(data, index, active, kind=None):
    """An entry of a table; of the kind mi.Color3f, three neighbours."""
    if JIT:
        return dr.gather(kind or type(data), data, index, active)
    if kind:
        return kind(data[3 * index:3 * index + 3] if active else 0)
    return data[index] if active else 0


def ratio(x, y):
    """0 where y is."""
    return dr.select(y > 0, x / dr.select(y > 0, y, 1), 0)


def choose(first, second, x):
    """Whether x in [0, 1] chooses the second of two weights, and where in the chosen one it is."""
    share = ratio(first, first + second)
    last = x >= share
    x = dr.select(last, ratio(x - share, 1 - share), ratio(x, share))
    return last, dr.clip(x, 0, 1)


def quarter(weights, blocks, share, x, point=None, split=None):
    """Of a block's quarters, weights[right][upper], the one that the sample x chooses, or that has
    the point, which the split tells: the new blocks, their share of all, what is left of x."""
    columns = weights[0][0] + weights[0][1], weights[1][0] + weights[1][1]
    right, x0 = choose(*columns, x[0]) if point is None else (point[0] >= split[0], None)
    rows = [dr.select(right, weights[1][k], weights[0][k]) for k in (0, 1)]
    upper, x1 = choose(*rows, x[1]) if point is None else (point[1] >= split[1], None)
    share = share * ratio(dr.select(upper, rows[1], rows[0]), columns[0] + columns[1])
    return [2 * block + dr.select(last, mi.UInt32(1), mi.UInt32(0))
            for block, last in zip(blocks, (right, upper))], share, (x0, x1)


def descend(steps, at, x, share):
    """Quarters by the weights at(step, blocks): what is left of x, the blocks and their share."""
    blocks = [mi.UInt32(0), mi.UInt32(0)]
    for step in steps:
        weights = [[at(step, (2 * blocks[0] + k, 2 * blocks[1] + m)) for m in (0, 1)]
                   for k in (0, 1)]
        blocks, share, x = quarter(weights, blocks, share, x)
    return x, blocks, share


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
        by area in lamp units. 0 where it is never chosen."""
        blocks, share, x = [mi.UInt32(0), mi.UInt32(0)], mi.Float(1), sample
        levels = MOST_UV.bit_length() - 1 if self.sampling == 'energy' else 0
        for level in range(1, levels + 1):
            weights = self.quarters(level, blocks, receiver, seen, active)
            split = [mi.Float(2 * block + 1) * (edge / (1 << level)) - edge / 2
                     for block, edge in zip(blocks, self.edges)]
            blocks, share, x = quarter(weights, blocks, share, x, point, split)
        spans = [self.part(axis, levels, blocks[axis], seen[axis]) for axis in (0, 1)]
        sizes = [high - low for low, high in spans]
        if point is None:
            point = [low + size * t for (low, _), size, t in zip(spans, sizes, x)]
        else:
            for value, (low, high), edge in zip(point, spans, self.edges):
                active = active & (value >= low - 1e-6 * edge) & (value <= high + 1e-6 * edge)
        return point, dr.select(active, ratio(share, sizes[0] * sizes[1]), 0)

    def part(self, axis, level, block, seen):
        """What is seen of one of the 2^level blocks of an axis: low and high end."""
        edge = self.edges[axis]
        width = edge / (1 << level)
        low = mi.Float(block) * width - edge / 2
        return dr.maximum(low, seen[0]), dr.minimum(low + width, seen[1])

    def quarters(self, level, blocks, receiver, seen, active):
        """Weights [right][upper] of a block's quarters, which are blocks of `level`."""
        z = receiver[2]
        s0, s1, t0, t1 = self.window
        turn = dr.abs(self.kappa - 1 / z) / (1 << level)  # slopes seen through a block, by its edge
        cells = [turn * edge / (high - low) * count for edge, low, high, count in
                 zip(self.edges, (s0, t0), (s1, t1), self.cells.st)]
        mip = dr.ceil(dr.log2(dr.maximum(dr.maximum(*cells), 1)))
        mip = mi.UInt32(dr.minimum(mip, self.cells.mips - 1))
        size = self.cells.size(mip)
        sides = []  # of each axis, of each half: block, what is seen of it, cell of slopes
        for axis, (low, high) in enumerate(((s0, s1), (t0, t1))):
            halves = []
            for k in (0, 1):
                block = 2 * blocks[axis] + k
                ends = self.part(axis, level, block, seen[axis])
                middle = (ends[0] + ends[1]) / 2
                slope = (receiver[axis] - middle) / z + self.kappa * middle
                count = mi.Float(size[axis])
                at = dr.clip(dr.floor((slope - low) / (high - low) * count), 0, count - 1)
                halves.append((block, dr.maximum(ends[1] - ends[0], 0), mi.UInt32(at)))
            sides.append(halves)
        return [[right[1] * upper[1] * self.cells.at(
            level, (right[0], upper[0]), mip, (right[2], upper[2]), active)
                 for upper in sides[1]] for right in sides[0]]

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
        ds = dr.zeros(mi.DirectionSample3f)
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
