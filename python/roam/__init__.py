"""Collision queries and walking bodies in 3D scenes of any size, for numpy.

    import roam
    world = roam.World.open("house.glb")
    hit = world.sweep(0.3, [[1, 2, 1.5]], [[9, 0, 0]])
    print(hit.time, hit.point)

Lengths are metres, times seconds, +z is up. A body is a sphere, or an upright capsule whose axis has the length
2 * half_height. Arrays of positions have the shape (N, 3); a single position of shape (3,) gives results without N.
float64 arrays whose x, y and z lie side by side are used as they are; other numbers and lists are converted.

Errors: ValueError for a value or shape out of range, TypeError for other things than numbers, FileNotFoundError,
OSError for a file that cannot be read, MemoryError before the machine runs out of memory. Long calls run on all cores
without the GIL. Ctrl-C ends them, and so does an exception in `progress`, which gets the fraction done.
All objects may be used from any threads.
"""

from ._library import library as _library
from ._queries import Clearance, Contacts, Sweep
from ._spaces import Space, Store, World
from ._surveys import Probe, Profile, Survey, Training
from ._walkers import Route, Step, Walker

__version__ = _library.roam_version().decode()
__all__ = ["Clearance", "Contacts", "Probe", "Profile", "Route", "Space", "Step", "Store", "Survey", "Sweep",
           "Training", "Walker", "World"]
