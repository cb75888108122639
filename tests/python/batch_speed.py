"""batch_speed.py QUERY_ANSWERS: times of a million sweeps in one call, in Python and C++ in turns, on all cores."""

import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

import roam
from conftest import Clutter

clutter = Clutter(queries=1_000_000)
world = roam.World.from_arrays(clutter.vertices, clutter.triangles)
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "queries"
    clutter.save(file)
    with subprocess.Popen([sys.argv[1], file], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                          bufsize=1) as cpp:
        times = []
        for _ in range(16):
            cpp.stdin.write("go\n")
            of_cpp = float(cpp.stdout.readline())
            begun = time.perf_counter()
            world.sweep(clutter.radius, clutter.from_, clutter.motion, clutter.half_height)
            times.append((time.perf_counter() - begun, of_cpp))
        cpp.stdin.close()
of_python, of_cpp = np.array(times[1:]).T  # the first warms up
print(f"Python {np.median(of_python):.3f} s, C++ {np.median(of_cpp):.3f} s, ratio {np.median(of_python / of_cpp):.3f}, "
      f"least {of_python.min():.3f} and {of_cpp.min():.3f} s")
