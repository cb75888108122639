"""Scenes and the C++ program that the tests compare with."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import roam

# A floor of 9 m by 9 m and a wall 3 m high along x = 5.
FLOOR = ("floor", [[0, -4, 0], [9, -4, 0], [9, 5, 0], [0, 5, 0]], [[0, 1, 2], [0, 2, 3]])
WALL = ("wall", [[5, -4, 0], [5, 5, 0], [5, 5, 3], [5, -4, 3]], [[0, 1, 2], [0, 2, 3]])


@pytest.fixture
def room():
    return roam.World.from_meshes([FLOOR, WALL])


@pytest.fixture
def room_file(tmp_path):
    path = tmp_path / "room.obj"
    lines, first = [], 1
    for name, vertices, triangles in (FLOOR, WALL):
        lines.append(f"o {name}")
        lines += ["v {} {} {}".format(*v) for v in vertices]
        lines += ["f {} {} {}".format(*(first + i for i in t)) for t in triangles]
        first += len(vertices)
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture
def store(room_file):
    subprocess.run([os.environ["ROAM_PROGRAM"], "build", str(room_file)], check=True, capture_output=True)
    return pathlib.Path(f"{room_file}.roam")


class Clutter:
    """Random triangles and queries."""

    def __init__(self, seed=1, triangles=3000, queries=20000):
        rng = np.random.default_rng(seed)
        middle = rng.uniform(-5, 5, (triangles, 1, 3))
        self.vertices = (middle + rng.uniform(-0.7, 0.7, (triangles, 3, 3))).reshape(-1, 3)
        self.triangles = np.arange(3 * triangles, dtype=np.uint32).reshape(-1, 3)
        self.radius = rng.uniform(0, 0.5, queries)
        self.half_height = np.where(rng.random(queries) < 0.3, rng.uniform(0, 1, queries), 0.0)
        self.from_ = rng.uniform(-6, 6, (queries, 3))
        self.motion = rng.uniform(-5, 5, (queries, 3))


    def save(self, path):
        """Writes what query_answers reads."""
        with open(path, "wb") as file:
            np.array([len(self.vertices), len(self.triangles), len(self.from_)], np.uint64).tofile(file)
            for array in (self.vertices, self.triangles, self.radius, self.half_height, self.from_, self.motion):
                array.tofile(file)


@pytest.fixture(scope="session")
def clutter():
    return Clutter()


@pytest.fixture(scope="session")
def clutter_world(clutter):
    return roam.World.from_arrays(clutter.vertices, clutter.triangles)
