#!/usr/bin/env python3
"""Finds and measures the doors of a floor, and draws them on its plan.

    doors.py office.dae doors.png [--level 1.0] [--grid 0.5] [--up y] [--unit in]

Needs python3-matplotlib. --level is a height inside the storey, in metres; else 1 m above the lowest triangle.
A door is found if a body of 0.4 m gets through, and the grid has a place in the room behind it.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor

import matplotlib
import numpy as np

import roam

matplotlib.use("Agg")  # draws without a screen
import matplotlib.pyplot as plt  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("scene")
parser.add_argument("picture")
parser.add_argument("--level", type=float)
parser.add_argument("--grid", type=float, default=0.5)
parser.add_argument("--up")
parser.add_argument("--unit", default="m")
options = parser.parse_args()

world = roam.World.open(options.scene, up=options.up, unit=options.unit)
survey = roam.Survey.open(options.scene, up=options.up, unit=options.unit)
low, high = world.bounds
level = low[2] + 1.0 if options.level is None else options.level


def places(grid):
    """Points at that level, of shape (rows, columns, 3), and which have a floor at most 2 m below."""
    x, y = (np.arange(low[i] + grid / 2, high[i], grid) for i in (0, 1))
    points = np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), level)], axis=-1)
    return points, world.ray(points.reshape(-1, 3), [0, 0, -2]).hit.reshape(points.shape[:2])


# Places that are wider than a door, four steps of the grid apart, with something narrower between them.
points, free = places(options.grid)
free &= world.fits(0.5, points.reshape(-1, 3), 0.3).reshape(free.shape)
pairs = []
for first, second in ((np.s_[:, :-4], np.s_[:, 4:]), (np.s_[:-4], np.s_[4:])):
    both = free[first] & free[second]
    start, end = points[first][both], points[second][both]
    narrow = world.sweep(0.5, start, end - start, 0.3).hit
    pairs += zip(start[narrow], end[narrow])

# A probe finds the widest way from one to the other, and the place that limits it. A survey serves many threads.
with ThreadPoolExecutor() as threads:
    probes = list(threads.map(lambda pair: survey.probe(*pair, radius=0.2, height=1.8), pairs))
doors = []
for probe in sorted((p for p in probes if p.passable and p.limit == "door"), key=lambda p: p.limit_size):
    # Several ways lead through one door: their measures lie side by side.
    if all(np.linalg.norm(probe.limit_point - other.limit_point) > 0.5 for other in doors):
        doors.append(probe)
print(f"{len(pairs)} probes, {len(doors)} doors")
for probe in doors:
    print("{:6.2f} m at {:.2f}, {:.2f}".format(probe.limit_size, *probe.limit_point[:2]))

fine, floor = places(max(0.05, np.sqrt(np.prod(high[:2] - low[:2]) / 2e6)))
open_space = floor & world.fits(0.02, fine.reshape(-1, 3)).reshape(floor.shape)
figure, axes = plt.subplots(figsize=(14, 1 + 13 * (high[1] - low[1]) / (high[0] - low[0])), layout="constrained")
axes.imshow(~open_space, origin="lower", extent=(low[0], high[0], low[1], high[1]), cmap="Greys", vmax=2)
for probe in doors:
    at, along = probe.limit_point[:2], probe.limit_direction[:2] * probe.limit_size / 2
    axes.plot(*np.transpose([at - along, at + along]), color="red" if probe.limit_size < 0.8 else "green", lw=3)
    axes.annotate(f"{probe.limit_size:.2f}", at, fontsize=8, xytext=(3, 3), textcoords="offset points")
axes.set(title=f"{len(doors)} doors, their widths in metres (red: narrower than 0.8)", xlabel="x, m", ylabel="y, m")
figure.savefig(options.picture, dpi=110)
