# slab_cells.py - where a light slab's light is, and samples that follow it, for slab_emitter.py.
# Public domain (CC0-1.0).
#
# 1. Cells: means of radiance times cos^4 over cells of (u, v, s, t), and those of 2x2 cells in
#    (u, v) and in (s, t), again and again.
# 2. A block of the aperture is found from the whole to its quarters, and so on (hierarchical sample
#    warping, Clarberg et al. 2005): quarter().
# 3. Within it the density is straight, along each axis, from its middle to those of its
#    neighbours: bend().
import drjit as dr
import mitsuba as mi
import numpy as np

JIT = dr.is_jit_v(mi.Float)
MOST_UV, MOST_ST = 16, 256  # cells an axis


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
                data.append(cells.ravel())
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

    def row(self, level, blocks, mip, active):
        """Where a block of the aperture, of 2^level x 2^level, has its cells of a mip."""
        known = min(level, self.most)
        i, j = (mi.UInt32(block) >> (level - (n.bit_length() - 1))
                for block, n in zip(blocks, self.counts[known]))
        nu, nv = self.counts[known]
        width, height = self.size(mip)
        start = nu * nv * fetch(self.before, mi.UInt32(mip), active) + self.first[known]
        return start + (j * nu + i) * height * width

    def at(self, level, blocks, mip, cell, active):
        """The mean of a block of the aperture towards a cell."""
        start = self.row(level, blocks, mip, active)
        return fetch(self.data, start + cell[1] * self.size(mip)[0] + cell[0], active)

    def between(self, level, blocks, mip, taps, active):
        """The mean towards slopes between two cells an axis: taps(), of each axis."""
        start, width = self.row(level, blocks, mip, active), self.size(mip)[0]
        return sum(fetch(self.data, start + l * width + k, active) * (x * y)
                   for k, x in taps[0] for l, y in taps[1])


def table(values, kind):
    """For fetch()."""
    if not JIT:
        return np.asarray(values).tolist()
    return kind(np.asarray(values, np.uint32 if kind is mi.UInt32 else np.float32))


def taps(x, count):
    """Two of `count` cells and their weights, for the place x in cells."""
    x = dr.clip(x - .5, 0, mi.Float(count) - 1)
    low = mi.UInt32(x)
    x = x - mi.Float(low)
    return (low, 1 - x), (dr.minimum(low + 1, count - 1), x)


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


def bend(ends, middle, width, values, x, given):
    """A density between two ends that is straight from the middle of a block, where it is
    values[1], to those of its neighbours: the place for the sample x, or x where that is given as
    a place, and its density."""
    def value(place):
        side = dr.select(place < middle, values[0], values[2])
        return values[1] + (side - values[1]) * dr.abs(place - middle) / width

    places = ends[0], dr.clip(middle, *ends), dr.maximum(*ends)
    f = [value(place) for place in places]
    areas = [(f[k] + f[k + 1]) * (places[k + 1] - places[k]) / 2 for k in (0, 1)]
    if not given:
        last, x = choose(*areas, x)
        low, p, q = (dr.select(last, second, first) for first, second in
                     zip((places[0], *f[:2]), (places[1], *f[1:])))
        size = dr.select(last, places[2] - places[1], places[1] - places[0])
        x = low + size * ratio(x * (p + q), p + dr.sqrt(p * p + x * (q * q - p * p)))
    return x, ratio(value(x), areas[0] + areas[1])


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
