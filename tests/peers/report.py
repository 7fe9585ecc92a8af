"""The table and the plot of `make peers`, from rows/ and the two halves of the truth.

The error of a picture x is the RMS of x - truth over the truth's mean, all 128 x 128 pixels of the
first view. The truth has noise of its own: with two halves a and b that know nothing of each
other, the mean of (x - a)(x - b) is the square of the error without it.

  1. Ways whose error is noise (light and path tracing): a run of C seconds that errs by e takes
     C (e/E)^2 to err by E; told are the median and the range over all runs.
  2. All others: the cheapest setting that errs by at most E, bake and one picture together.

  report.py ROWS   writes peers.md, peers.gnuplot
"""
import glob
import os
import sys

import mitsuba
import numpy as np

mitsuba.set_variant('scalar_rgb')
NAMES = {'light': 'Mitsuba, light tracing', 'path': 'Mitsuba, path tracing', 'photons': 'Radiance, photon map',
         'mkillum': 'Radiance, mkillum', 'lamp': 'POV-Ray, the whole lamp', 'renderslab': '**bakeslab, renderslab**',
         'include': '**bakeslab, POV-Ray include**'}
NOISE = ('light', 'path')
TARGETS = (0.05, 0.02)
PICTURES = 10


def picture(name):
    if os.path.exists(name + '.npy'):
        return np.load(name + '.npy').astype(float)
    return np.array(mitsuba.Bitmap(name + '.exr')).astype(float)[..., 1]


def error(x, a, b):
    """Relative RMS error, and the mean over the truth's."""
    mean = (a.mean() + b.mean())/2
    return max(((x - a)*(x - b)).mean(), 1e-8*mean*mean)**0.5/mean, x.mean()/mean


def rows(folder):
    """By (lamp, way): a list of (setting, bake, picture, error, mean)."""
    truths, table = {}, {}
    for name in sorted(glob.glob(f'{folder}/*.[0-9]*')):
        if name.endswith(('.npy', '.exr')) or not name.rsplit('.', 1)[1].isdigit():
            continue
        with open(name, encoding='utf-8') as stream:
            lamp, way, setting, _, bake, shown = stream.read().split('\t')
        if lamp not in truths:
            truths[lamp] = [np.load(f'truth-{lamp}-{half}.npy').astype(float) for half in (1, 2)]
        table.setdefault((lamp, way), []).append((setting, float(bake), float(shown), *error(picture(name), *truths[lamp])))
    return table


def seconds(x):
    return f'{x:.3g}' if x < 1000 else f'{x:.0f}'


def ranged(values):
    text = seconds(np.median(values))
    return text if len(values) == 1 else f'{text} ({seconds(min(values))}-{seconds(max(values))})'


def by_setting(measured):
    """Of each setting: bake, picture, error by median, and all pictures' seconds; cheapest first."""
    groups = {}
    for setting, *numbers in measured:
        groups.setdefault(setting, []).append(numbers)
    found = [(setting, *np.median(np.array(group)[:, :4], axis=0), [g[1] for g in group]) for setting, group in groups.items()]
    return sorted(found, key=lambda g: g[1] + g[2])


def reached(way, measured, target):
    """What a target takes: bake, a picture, that as text, and for how many pictures; or None."""
    if way in NOISE:
        values = [shown*(err/target)**2 for _, _, shown, err, _ in measured]
        return 0, float(np.median(values)), ranged(values), ''
    for setting, bake, shown, err, _, all_shown in by_setting(measured):
        if err <= target:
            return bake, shown, ranged(all_shown), setting
    return None


def best(measured):
    setting, bake, shown, err, mean, _ = min(by_setting(measured), key=lambda g: g[3])
    return f'{100*err:.3g} % in {seconds(bake + shown)} s ({setting}; mean {100*(mean - 1):+.1f} %)'


def tables(table):
    text = ''
    for lamp in sorted({key[0] for key in table}, reverse=True):
        text += f'\n`{lamp}`\n\n| | best picture tried | bake | a picture of 5 % | {PICTURES} of them | bake | a picture of 2 % | {PICTURES} of them |\n'
        text += '|---|---|---|---|---|---|---|---|\n'
        for way, name in NAMES.items():
            measured = table.get((lamp, way))
            if not measured:
                reason = 'not measured'
                if os.path.exists(f'rows/{way}.absent'):
                    with open(f'rows/{way}.absent', encoding='utf-8') as stream:
                        reason = stream.read().strip()
                text += f'| {name} | {reason} | | | | | | |\n'
                continue
            cells = []
            for target in TARGETS:
                found = reached(way, measured, target)
                cells += [seconds(found[0]) if found[0] else '-', found[2], seconds(found[0] + PICTURES*found[1])] if found else ['not reached', '', '']
            text += f'| {name} | {best(measured)} | ' + ' | '.join(cells) + ' |\n'
    return text


def plot(table):
    colours = dict(zip(NAMES, ('#d62728', '#7f7f7f', '#ff7f0e', '#9467bd', '#2ca02c', '#1f77b4', '#17becf')))
    lamps = sorted({key[0] for key in table}, reverse=True)
    text = "set terminal pngcairo size 1200,520 font 'sans,12'\nset output 'peers.png'\nset logscale xy\nset grid\n"
    text += "set xlabel 'CPU seconds of bake and pictures'\nset ylabel 'error of a picture (RMS/mean), %'\nset format '%g'\n"
    text += f'set multiplot layout 1,{len(lamps)}\n'
    for lamp in lamps:
        lines = []
        for number, (way, name) in enumerate(NAMES.items()):
            found = by_setting(table.get((lamp, way), []))
            if not found:
                continue
            text += f'$d{number} << END\n' + ''.join(f'{b + s} {100*e} {b + PICTURES*s}\n' for _, b, s, e, _, _ in found) + 'END\n'
            style = f"lw 2 ps 1.3 lc rgb '{colours[way]}'"
            lines += [f"$d{number} using 1:2 with linespoints pt 7 {style} title '{name.strip('*')}'",
                      f"$d{number} using 3:2 with linespoints pt 6 dt 3 {style} notitle"]
        text += f"set title '{lamp} (filled: one picture; open: {PICTURES})'\nset key top right\n"
        text += 'plot ' + ', '.join(lines + ["5 with lines lc 'black' dt 2 notitle", "2 with lines lc 'black' dt 2 notitle"]) + '\n'
    return text + 'unset multiplot\n'


def main(folder):
    table = rows(folder)
    with open('versions', encoding='utf-8') as stream:
        versions = '; '.join(stream.read().split('\n')).strip('; ')
    text = tables(table)
    with open('peers.md', 'w', encoding='utf-8') as stream:
        stream.write(text + f'\nVersions: {versions}.\n')
    with open('peers.gnuplot', 'w', encoding='utf-8') as stream:
        stream.write(plot(table))
    print(text)


main(*sys.argv[1:])
