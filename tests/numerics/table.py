#!/usr/bin/env python3
"""table.py - makes table.inc: irradiance of small slabs in hard cases by mpmath, 50 digits.

tests/numerics/table.py > tests/numerics/table.inc   (python3-mpmath; some minutes)

A case is lengths of u and v, samples, window, st distance (0: infinity), receiver, seed of the
samples, irradiance. The slab lies at the origin along x, y and z. From light-slab(5) alone: along
an axis all lines of samples, seen from the receiver, are put in order; between two of them
radiance is the product of two linear functions. With x = sinh(t), y = sqrt(1 + x^2) sinh(r) the
kernel (n.(x, y, -1))/(1 + x^2 + y^2)^2 dx dy is smooth for every slope.
"""
import math
import random
from mpmath import mp, mpf, asinh, cosh, sinh, sqrt, floor, inf
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 50
NODES = [(mpf(x), mpf(w)) for x, w in GaussLegendre(mp).calc_nodes(4, 200)]  # 24 nodes


def sample(seed, number):
    """Of the raster, floats in order: 24 bits, so that a float holds it."""
    word = (number * 2654435761 + seed * 40503 + 12345) % 2**32
    word ^= word >> 15
    return mpf((word * 2246822519 % 2**32) >> 8) / 2**24


def pieces(length, q, z, kappa, uv, st, low, high):
    """(from, to, near samples, their weights at both ends, far samples, weights)."""
    a = [(mpf(k) / (2 * uv) - mpf(1) / 2) * length for k in range(2 * uv + 1)]
    s = [low + (high - low) * mpf(k) / (2 * st) for k in range(2 * st + 1)]
    slope_a = [(x - q) / z for x in a]
    lean = kappa * z - 1
    ends = [slope_a[0], slope_a[-1]]
    cuts = slope_a[1::2]
    if lean != 0:
        slope_s = [(x - kappa * q) / lean for x in s]
        ends = [max(ends[0], min(slope_s[0], slope_s[-1])), min(ends[1], max(slope_s[0], slope_s[-1]))]
        cuts += slope_s[1::2]
    elif not low <= kappa * q <= high:
        return []
    if ends[0] >= ends[1]:
        return []
    cuts = sorted(set([x for x in cuts if ends[0] < x < ends[1]] + ends))
    out = []
    for left, right in zip(cuts, cuts[1:]):
        grids = []
        for count, place in ((uv, lambda x: ((q + z * x) / length + mpf(1) / 2) * uv - mpf(1) / 2),
                             (st, lambda x: (kappa * q + lean * x - low) / (high - low) * st - mpf(1) / 2)):
            middle = place((left + right) / 2)
            if middle <= 0 or middle >= count - 1:
                index = 0 if middle <= 0 else count - 1
                grids.append((index, index, mpf(0), mpf(0)))
            else:
                index = int(floor(middle))
                grids.append((index, index + 1, place(left) - index, place(right) - index))
        out.append((left, right, grids[0], grids[1]))
    return out


def nodes(low, high):
    """Gauss nodes where every part is at most 1 long."""
    parts = max(1, int(mp.ceil(high - low)))
    for k in range(parts):
        half = (high - low) / parts / 2
        middle = low + (2 * k + 1) * half
        for x, w in NODES:
            yield middle + half * x, half * w


def weights(piece, x):
    left, right, near, far = piece
    at = (x - left) / (right - left)
    f = near[2] + (near[3] - near[2]) * at
    g = far[2] + (far[3] - far[2]) * at
    return [(near[0], far[0], (1 - f) * (1 - g)), (near[0], far[1], (1 - f) * g),
            (near[1], far[0], f * (1 - g)), (near[1], far[1], f * g)]


def inner(piece, x, normal):
    """Weights of a piece along y, times the kernel, at x."""
    n, root = normal, sqrt(1 + x * x)
    low, high = piece[0], piece[1]
    if n[1] > 0:
        low = max(low, (n[2] - n[0] * x) / n[1])
    elif n[1] < 0:
        high = min(high, (n[2] - n[0] * x) / n[1])
    elif n[0] * x - n[2] <= 0:
        return []
    if low >= high:
        return []
    total = {}
    for r, w in nodes(asinh(low / root), asinh(high / root)):
        y = root * sinh(r)
        value = w * (n[0] * x + n[1] * y - n[2]) / (root * cosh(r)) ** 3
        for i, k, weight in weights(piece, y):
            total[i, k] = total.get((i, k), 0) + value * weight
    return total.items()


def irradiance(case):
    lengths, samples, window, distance, p, n, seed = case
    kappa = 1 / mpf(distance) if distance else mpf(0)
    p, n = [mpf(x) for x in p], [mpf(x) for x in n]
    length = sqrt(sum(x * x for x in n))
    n = [x / length for x in n]
    axes = [pieces(mpf(lengths[k]), p[k], p[2], kappa, samples[k], samples[2 + k],
                   mpf(window[2 * k]), mpf(window[2 * k + 1])) for k in (0, 1)]
    rgb = [mpf(0)] * 3
    for u in axes[0]:
        for v in axes[1]:
            cuts = {u[0], u[1]}
            if n[0] != 0:
                cuts |= {x for x in ((n[2] - n[1] * y) / n[0] for y in v[:2]) if u[0] < x < u[1]}
            cuts = sorted(cuts)
            for low, high in zip(cuts, cuts[1:]):
                for t, w in nodes(asinh(low), asinh(high)):
                    x = sinh(t)
                    for (j, l), along in inner(v, x, n):
                        for i, k, weight in weights(u, x):
                            pixel = ((j * samples[3] + l) * samples[0] + i) * samples[2] + k
                            value = w * cosh(t) * along * weight
                            for c in range(3):
                                rgb[c] += value * sample(seed, 3 * pixel + c)
    return rgb


def cases():
    """Hard ones by turns; all numbers are doubles."""
    random.seed(1)
    uniform = random.uniform
    for number in range(56):
        kind = number % 8
        lengths, window, distance = [1.0, 1.0], [-0.75, 1.0, -0.875, 0.625], 0
        samples = random.choice([(2, 2, 2, 2), (3, 2, 2, 3), (1, 2, 3, 2), (2, 1, 1, 3)])
        z, aim = 10 ** uniform(-1, 1), [uniform(-.4, .4) for _ in range(4)]
        if kind == 0:
            z = 10 ** uniform(3, 9)
        if kind == 1:
            z = 10 ** uniform(-9, -3)
        if kind == 2:
            lengths[number // 8 % 2] = 10 ** uniform(-6, -2)
        if kind == 3:
            distance = 10 ** uniform(-6, 0)
        if kind == 4:
            distance = 10 ** uniform(0, 9)
        if kind == 5:
            wide = 10 ** uniform(2, 9)
            window = [-wide, wide, -wide, wide]
            z = uniform(1, 3) / wide
        s = [(window[2 * k] + window[2 * k + 1]) / 2 + aim[2 + k] * (window[2 * k + 1] - window[2 * k])
             for k in (0, 1)]
        a = [aim[k] * lengths[k] for k in (0, 1)]
        p = [a[k] + z * (s[k] - (a[k] / distance if distance else 0)) for k in (0, 1)] + [z]
        ray = [a[0] - p[0], a[1] - p[1], -z]
        size = max(abs(x) for x in ray)
        ray = [x / size for x in ray]
        n = [ray[k] + uniform(-.7, .7) for k in range(3)]
        if kind == 6:  # the tangent plane through the aperture
            across = [uniform(-1, 1) for _ in range(3)]
            dot = sum(x * y for x, y in zip(ray, across)) / sum(x * x for x in ray)
            n = [x - dot * y for x, y in zip(across, ray)]
        if kind == 7:  # grazing, from above
            across = [uniform(-1, 1) for _ in range(3)]
            dot = sum(x * y for x, y in zip(ray, across)) / sum(x * x for x in ray)
            n = [x + (10 ** uniform(-4, -1) - dot) * y for x, y in zip(across, ray)]
        size = math.sqrt(sum(x * x for x in n))
        yield lengths, samples, window, distance, p, [x / size for x in n], number


def main():
    print("/* Made by table.py: see there. */")
    for case in cases():
        rgb = irradiance(case)
        lengths, samples, window, distance, p, n, seed = case
        rows = [[repr(float(x)) for x in group] for group in (lengths, window, p, n)]
        joined = ["{" + ", ".join(row) + "}" for row in rows]
        print("{%s, {%s}, %s, %r,\n %s,\n %s, %d,\n {%s}}," % (
            joined[0], ", ".join(map(str, samples)), joined[1], float(distance), joined[2], joined[3],
            seed, ", ".join(mp.nstr(x, 21, min_fixed=0, max_fixed=0) + "L" for x in rgb)), flush=True)


main()
