#!/usr/bin/env python3
"""Finds a million positions where a robot is free, with the room around each, for a planner of its ways.

    free_space.py cave.dae free.npz free.png [--samples 1000000] [--radius 0.25] [--reach 2] [--up y] [--unit in]

Needs python3-matplotlib. The robot is a sphere, such as a drone. free.npz has the arrays `position`, (N, 3), and
`room`, (N,): the certified distance to the nearest wall, metres, at most --reach.
"""

import argparse
import time

import matplotlib
import numpy as np

import roam

matplotlib.use("Agg")  # draws without a screen
import matplotlib.pyplot as plt  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("scene")
parser.add_argument("samples_file")
parser.add_argument("picture")
parser.add_argument("--samples", type=int, default=1_000_000)
parser.add_argument("--radius", type=float, default=0.25)
parser.add_argument("--reach", type=float, default=2.0)
parser.add_argument("--up")
parser.add_argument("--unit", default="m")
options = parser.parse_args()

world = roam.World.open(options.scene, up=options.up, unit=options.unit)
low, high = world.bounds
random = np.random.default_rng(1)


def inside(place):
    """Which positions have walls on both sides along two axes: not those in the rock around a tunnel, or in the sky."""
    pairs = [world.ray(place, way).hit & world.ray(place, -way).hit for way in np.diag(high - low)]
    return np.sum(pairs, axis=0) >= 2


# Positions in the box of the scene, in portions, until there are enough.
positions, rooms, tried, seconds = [], [], 0, 0.0
while sum(map(len, rooms)) < options.samples and tried < 200 * options.samples:
    place = random.uniform(low, high, (options.samples, 3))
    begun = time.perf_counter()
    near = world.clearance(0.0, place, options.reach)  # one call, on all cores
    seconds += time.perf_counter() - begun
    tried += len(place)
    free = near.gap > options.radius
    free[free] = inside(place[free])
    positions.append(place[free])
    rooms.append(near.gap[free])
position = np.concatenate(positions)[:options.samples]
room = np.concatenate(rooms)[:options.samples]
np.savez(options.samples_file, position=position, room=room)
print(f"{len(room)} free positions of {tried}; {tried / seconds / 1e6:.1f} million clearances a second")

# From above, each pixel with the widest room in its column; and how many positions have how much room.
wide = high[:2] - low[:2]
figure, (plan, chart) = plt.subplots(
    2, 1, figsize=(11, 4 + np.clip(10 * wide[1] / wide[0], 3, 14)), layout="constrained",
    gridspec_kw={"height_ratios": [np.clip(10 * wide[1] / wide[0], 3, 14), 3]})
order = np.argsort(room)  # the widest on top
dots = plan.scatter(*position[order, :2].T, c=room[order], s=1, lw=0, cmap="viridis", rasterized=True)
plan.set(title=f"{len(room):,} free positions of a robot of radius {options.radius} m, from above", xlabel="x, m",
         ylabel="y, m", aspect="equal")
figure.colorbar(dots, label="distance to the nearest wall, m", shrink=0.8)
chart.hist(room, bins=100)
chart.set(xlabel="distance to the nearest wall, m", ylabel="positions")
figure.savefig(options.picture, dpi=110)
