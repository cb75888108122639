#!/usr/bin/env python3
"""Draws how much room there is around a person on one floor of a scene: a mine, a plant, an office.

    clearance_map.py mine.dae mine.png [--level 1.5] [--grid 0.1] [--up y] [--unit in]

Needs python3-matplotlib. --level is a height inside the storey, in metres; else 1.5 m above the lowest triangle.
--grid is the distance of its points; else 0.1 m, or more in a large scene.
"""

import argparse

import matplotlib
import numpy as np

import roam

matplotlib.use("Agg")  # draws without a screen
import matplotlib.pyplot as plt  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("scene")
parser.add_argument("picture")
parser.add_argument("--level", type=float)
parser.add_argument("--grid", type=float)
parser.add_argument("--up")
parser.add_argument("--unit", default="m")
options = parser.parse_args()

world = roam.World.open(options.scene, up=options.up, unit=options.unit)
low, high = world.bounds
level = low[2] + 1.5 if options.level is None else options.level
grid = options.grid or max(0.1, np.sqrt(np.prod(high[:2] - low[:2]) / 2e6))  # at most two million places

# A grid of places at that level, and the floor below each: a ray of 4 m that ends on something level.
x = np.arange(low[0] + grid / 2, high[0], grid)
y = np.arange(low[1] + grid / 2, high[1], grid)
places = np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), level)], axis=-1).reshape(-1, 3)
down = world.ray(places, [0, 0, -4])
floor = down.hit & (down.normal[:, 2] > 0.7)
if not floor.any():
    raise SystemExit(f"There is no floor below {level:.1f} m: the scene is from {low[2]:.1f} to {high[2]:.1f} m high")

# The body is a vertical line from 0.9 m to 1.5 m above the floor. Its gap is the radius of the widest body that fits
# there. At 0.9 m the floor is as near as any wall, so wider bodies are not measured. All queries are one call.
gap = world.clearance(0.0, down.point[floor] + [0, 0, 1.2], reach=0.9, half_height=0.3).gap
room = np.full(len(places), np.nan)
room[floor] = np.where(gap > 0, gap, np.nan)
room = room.reshape(len(y), len(x))

print(f"{grid**2 * np.sum(room >= 0.3):.1f} m2 of floor have room for a person 0.6 m wide")

if np.isnan(room).all():
    raise SystemExit(f"There is no room for anybody on the floor below {level:.1f} m")

# Only the part of the grid that has room.
columns, rows = (np.flatnonzero((~np.isnan(room)).any(axis=axis)) for axis in (0, 1))
room = room[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]
x, y = x[columns[0]:columns[-1] + 1], y[rows[0]:rows[-1] + 1]
half = grid / 2
figure, axes = plt.subplots(figsize=(11, np.clip(10 * len(y) / len(x), 3, 14)), layout="constrained")
shown = axes.imshow(room, origin="lower", extent=(x[0] - half, x[-1] + half, y[0] - half, y[-1] + half), vmin=0,
                    vmax=0.9, cmap="viridis")
axes.set(title=f"Room around a person, on the floor below {level:.1f} m", xlabel="x, m", ylabel="y, m")
bar = figure.colorbar(shown, label="radius of the widest body, m (0.9: or wider)", shrink=0.8)
bar.ax.axhline(0.3, color="red")
if min(room.shape) > 1 and np.nanmin(room) < 0.3 < np.nanmax(room):
    axes.contour(x, y, room, levels=[0.3], colors="red", linewidths=0.5)  # where a person of 0.6 m must stop
figure.savefig(options.picture, dpi=110)
