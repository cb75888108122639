"""The scripts of examples/python: what they print, keep and draw."""

import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import roam

pytest.importorskip("matplotlib", reason="the examples draw with python3-matplotlib")
from matplotlib.image import imread  # noqa: E402

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


def run(name, *arguments):
    """What an example prints. Its last argument is its picture, which must show something in colours."""
    said = subprocess.run([sys.executable, "-B", str(EXAMPLES / name), *map(str, arguments)], capture_output=True,
                          text=True, check=False)
    assert (said.returncode, said.stderr) == (0, ""), said.stderr
    pixels = imread(arguments[-1])[..., :3]
    assert pixels.shape[0] > 200 and pixels.shape[1] > 800
    coloured = np.ptp(pixels, axis=-1) > 0.2
    assert coloured.mean() > 0.001
    return said.stdout


def wall(x0, y0, x1, y1, height=2.8):
    """A box, 0.2 m thick about a line along x or y, closed."""
    x0, x1 = (x0 - 0.1, x0 + 0.1) if x0 == x1 else (x0, x1)
    y0, y1 = (y0 - 0.1, y0 + 0.1) if y0 == y1 else (y0, y1)
    corners = [[x, y, z] for z in (0, height) for y in (y0, y1) for x in (x0, x1)]
    return corners, [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3],
                     [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]


@pytest.fixture(scope="module")
def flat(tmp_path_factory):
    """Three rooms of 4 m by 4 m in a row, with doors of 0.9 m at (4, 1.45) and of 0.7 m at (8, 2.65)."""
    floor = [[0, 0, 0], [12, 0, 0], [12, 4, 0], [0, 4, 0]], [[0, 1, 2], [0, 2, 3]]
    parts = [floor, wall(-0.1, 0, 12.1, 0), wall(-0.1, 4, 12.1, 4), wall(0, 0, 0, 4), wall(12, 0, 12, 4),
             wall(4, 0, 4, 1), wall(4, 1.9, 4, 4), wall(8, 0, 8, 2.3), wall(8, 3, 8, 4)]
    path, first, lines = tmp_path_factory.mktemp("flat") / "flat.obj", 1, []
    for corners, triangles in parts:
        lines += ["v {} {} {}".format(*corner) for corner in corners]
        lines += ["f {} {} {}".format(*(first + i for i in triangle)) for triangle in triangles]
        first += len(corners)
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def gallery(tmp_path_factory):
    path = tmp_path_factory.mktemp("gallery") / "gallery.ply"
    subprocess.run([os.environ["ROAM_PROGRAM"], "make", "gallery", "-o", str(path), "--triangles", "20k"], check=True,
                   capture_output=True)
    return path


def test_the_doors_of_a_flat(flat, tmp_path):
    said = run("doors.py", flat, tmp_path / "doors.png")
    doors = [tuple(map(float, found)) for found in re.findall(r"([0-9.]+) m at ([-0-9.]+), ([-0-9.]+)", said)]
    assert "2 doors" in said and len(doors) == 2
    assert doors[0] == pytest.approx((0.7, 8, 2.65), abs=0.11) and doors[0][0] == pytest.approx(0.7, abs=0.011)
    assert doors[1] == pytest.approx((0.9, 4, 1.45), abs=0.11) and doors[1][0] == pytest.approx(0.9, abs=0.011)


def test_the_map_of_a_flat(flat, tmp_path):
    said = run("clearance_map.py", flat, "--grid", 0.05, tmp_path / "map.png")
    # In each room of 3.8 m by 3.8 m a person's axis keeps 0.3 m from the walls; in the doors it has 0.3 and 0.1 m.
    expected = 3 * 3.2**2 + 0.8 * (0.3 + 0.1)
    assert float(said.split()[0]) == pytest.approx(expected, rel=0.02)
    assert said.endswith("m2 of floor have room for a person 0.6 m wide\n")
    lost = subprocess.run([sys.executable, str(EXAMPLES / "clearance_map.py"), str(flat), str(tmp_path / "no.png"),
                           "--level", "-5"], capture_output=True, text=True, check=False)
    assert lost.returncode == 1 and "no floor below -5.0 m" in lost.stderr


def test_the_maps_of_narrow_and_of_full_floors(tmp_path):
    def scene(name, *parts):
        lines, first = [], 1
        for corners, triangles in parts:
            lines += ["v {} {} {}".format(*corner) for corner in corners]
            lines += ["f {} {} {}".format(*(first + i for i in triangle)) for triangle in triangles]
            first += len(corners)
        (tmp_path / name).write_text("\n".join(lines) + "\n")
        return tmp_path / name

    beam = [[0, 0, 0], [9, 0, 0], [9, 0.15, 0], [0, 0.15, 0]], [[0, 1, 2], [0, 2, 3]]
    run("clearance_map.py", scene("beam.obj", beam, wall(4, 0, 4, 1)), "--grid", 0.2, "--level", 1.5,
        tmp_path / "beam.png")
    shelves = [([[x, y, z] for x, y in ((0, 0), (3, 0), (3, 3), (0, 3))], [[0, 1, 2], [0, 2, 3]]) for z in (0, 1.2)]
    full = subprocess.run([sys.executable, str(EXAMPLES / "clearance_map.py"), str(scene("full.obj", *shelves)),
                           str(tmp_path / "full.png"), "--level", "1.1"], capture_output=True, text=True, check=False)
    assert full.returncode == 1 and "no room for anybody on the floor below 1.1 m\n" in full.stderr
    assert "Traceback" not in full.stderr


def test_the_map_of_a_gallery(gallery, tmp_path):
    said = run("clearance_map.py", gallery, "--grid", 2, tmp_path / "map.png")
    assert 500 < float(said.split()[0]) < 2000  # some 500 m of tunnel; a mesh so coarse narrows it


def test_free_positions_of_a_gallery(gallery, tmp_path):
    said = run("free_space.py", gallery, "--samples", 20000, "--reach", 1.5, tmp_path / "free.npz",
               tmp_path / "free.png")
    assert said.startswith("20000 free positions of ")
    kept = np.load(tmp_path / "free.npz")
    position, room = kept["position"], kept["room"]
    assert position.shape == (20000, 3) and room.shape == (20000,)
    assert len(np.unique(position, axis=0)) == 20000
    assert (room > 0.25).all() and (room <= 1.5).all() and room.min() < 0.3 and np.ptp(room) > 0.5
    world = roam.World.open(gallery)
    assert world.fits(room - 0.003, position).all()  # the promise
    near = room < 1.49
    assert not world.fits(room[near] + 0.003, position[near]).any()  # and no less
    low, high = world.bounds
    assert ((position > low) & (position < high)).all()
