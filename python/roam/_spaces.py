"""Spaces that bodies move in."""

import ctypes
import contextlib
import threading
import time
from typing import Any, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _queries, _structs
from ._arrays import Floats, Path, Progress
from ._library import Handle, StoreLock, call, library, run

_NO_TRIANGLE = 2**64 - 1
# Seconds in which a store reads a name, if its disk is not slow.
_FOR_A_NAME = 0.1


class SpaceHandle:
    """The handle of a space. A store is used by one thread at a time, which holds `lock`."""

    def __init__(self, lock: Optional[StoreLock] = None, patience: float = 0.0) -> None:
        self.handle = Handle("space", lock)
        self.lock = lock
        self.patience = patience

    @property
    def is_store(self) -> bool:
        return self.lock is not None

    def alone(self) -> Optional[threading.Lock]:
        """What a thread holds while it uses a store; None: any number of threads may use the space."""
        return None if self.lock is None else self.lock.here()

    def facts(self) -> _structs.Facts:
        facts = _structs.Facts()
        call("roam_space_get_facts", self.handle.value, ctypes.byref(facts))
        return facts

    def name_of(self, triangle: int, not_yet: Sequence[str] = ("",)) -> str:
        """A store has another thread read the name; waits a moment while it is one of `not_yet`."""
        self.alone()  # raises in a forked process
        name = self._known_name_of(triangle)
        if self.lock is not None and triangle != _NO_TRIANGLE:
            end = time.monotonic() + _FOR_A_NAME
            while name in not_yet and time.monotonic() < end:
                time.sleep(0.002)
                name = self._known_name_of(triangle)
        return name

    def _known_name_of(self, triangle: int) -> str:
        number = ctypes.c_uint64(triangle)
        room = 256
        while True:
            name = ctypes.create_string_buffer(room)
            length = library.roam_object_name(self.handle.value, number, name, ctypes.c_size_t(room))
            if length < room:
                return name.value.decode("utf-8", "surrogateescape")
            room = length + 1

    def load(self, query: _structs.Query, note: Any) -> None:
        """Loads what surrounds a body and its motion; nothing to do in a world."""
        call("roam_space_load", self.handle.value, ctypes.byref(query), ctypes.c_double(self.patience), note, None,
             ctypes.byref(ctypes.c_int32()))

    def reason_if_unreadable(self, triangle: int) -> str:
        """Why a part of a store cannot be read, from the number of an unknown triangle; "" if it can."""
        not_yet = ("", "not loaded yet")
        reason = self.name_of(triangle, not_yet) if self.facts().failed else ""
        return "" if reason in not_yet else reason


def world_options(note: Any, threads: int, lossless: bool = False, up: Optional[str] = None,
                  unit: str = "m") -> _structs.WorldOptions:
    for name, text in (("up", up), ("unit", unit)):
        if not isinstance(text, str) and not (name == "up" and text is None):
            raise TypeError(f"{name} must be a str; it is a {type(text).__name__}")
    return _structs.WorldOptions(threads=threads, lossless=lossless, up=None if up is None else up.encode(),
                                 unit=unit.encode(), progress=note)


def mesh_structs(meshes: List[Tuple[str, Floats, NDArray[np.uint32]]]) -> Any:
    """An array of roam_mesh. The arrays of numpy must outlive it."""
    return (_structs.Mesh * len(meshes))(*(
        _structs.Mesh(name=name.encode("utf-8", "surrogateescape"), vertices=vertices.ctypes.data,
                      vertex_count=len(vertices), triangles=triangles.ctypes.data, triangle_count=len(triangles))
        for name, vertices, triangles in meshes))


class Space:
    """All that bodies move in: a World, a Store, or one of these without some objects.

    Queries take N bodies at once and use all cores. Of their arguments, each is one for all or has N rows.
    """

    def __init__(self, handle: SpaceHandle) -> None:
        if not isinstance(handle, SpaceHandle):
            raise TypeError(f"make a {type(self).__name__} by World.from_arrays, World.open or Store.open")
        self._handle = handle
        self._facts = handle.facts()  # of a store they cannot be read beside a query; those shown never change

    def sweep(self, radius: ArrayLike, from_: ArrayLike, motion: ArrayLike, half_height: ArrayLike = 0.0, *,
              ignored: Iterable[int] = (), progress: Progress = None) -> _queries.Sweep:
        """The first impact of each body that moves from `from_` by `motion`.

        radius       one number or (N,), metres, [0, 1000]; 0 makes a point
        from_        (N, 3), metres: the centre at time 0
        motion       (N, 3), metres, each component at most 1e6: the centre at time 1 minus `from_`
        half_height  one number or (N,), metres, [0, 1000]: half the length of a capsule's axis
        ignored      numbers of objects to ignore
        """
        return _queries.sweep(self._handle, _queries.Batch(from_, motion, radius, half_height), ignored, progress)

    def ray(self, from_: ArrayLike, motion: ArrayLike, *, ignored: Iterable[int] = (),
            progress: Progress = None) -> _queries.Sweep:
        """The first triangle on each segment from `from_`, (N, 3), to `from_ + motion`, in metres."""
        return _queries.sweep(self._handle, _queries.Batch(from_, motion, 0.0, 0.0), ignored, progress)

    def clearance(self, radius: ArrayLike, place: ArrayLike, reach: float, half_height: ArrayLike = 0.0, *,
                  motion: Optional[ArrayLike] = None, ignored: Iterable[int] = (),
                  progress: Progress = None) -> _queries.Clearance:
        """The gap between each body and what is nearest to its surface, within `reach` metres, [0, 1000].

        `place` is (N, 3): the centres. With a `motion`, (N, 3), it is the least gap on the way. The other arguments are
        as in sweep().
        """
        batch = _queries.Batch(place, motion, radius, half_height, "place")
        return _queries.clearance(self._handle, batch, reach, ignored, progress)

    def contacts(self, radius: ArrayLike, place: ArrayLike, reach: float, half_height: ArrayLike = 0.0, *,
                 most: int = 16, motion: Optional[ArrayLike] = None, ignored: Iterable[int] = (),
                 progress: Progress = None) -> _queries.Contacts:
        """The triangles within `reach` metres of each body's surface, nearest first, at most `most` of each."""
        batch = _queries.Batch(place, motion, radius, half_height, "place")
        most = _arrays.whole(most, "most", 1, 65536)
        return _queries.contacts(self._handle, batch, reach, most, ignored, progress)

    def fits(self, radius: ArrayLike, place: ArrayLike, half_height: ArrayLike = 0.0, *, ignored: Iterable[int] = (),
             progress: Progress = None) -> NDArray[np.bool_]:
        """Whether each body is free at its `place`, (N, 3): an array of N bool."""
        batch = _queries.Batch(place, None, radius, half_height, "place")
        return _queries.fits(self._handle, batch, ignored, progress)

    def without(self, objects: Iterable[int]) -> "Space":
        """This space without these objects. It shares the triangles."""
        numbers = np.array(_arrays.objects(objects, "objects"), np.uint32)
        made = SpaceHandle(self._handle.lock, self._handle.patience)
        with self._handle.alone() or contextlib.nullcontext():
            call("roam_filtered_create", self._handle.handle.value, made.handle.address)
            call("roam_filtered_ignore_only", made.handle.value, ctypes.c_void_p(numbers.ctypes.data),
                 ctypes.c_size_t(len(numbers)))
            return Space(made)

    def object_name(self, triangle: int) -> str:
        """The name of the object of a triangle; "" if there is none, or a slow store has not read it yet.

        Of a triangle that is `unknown` it is the reason.
        """
        return self._handle.name_of(_arrays.whole(triangle, "triangle", -2**63, 2**64 - 1) % 2**64)

    @property
    def bounds(self) -> Floats:
        """The box of all triangles, metres: (2, 3), the lower and the upper corner. NaN for an empty world."""
        box = np.array([_arrays.array3(self._facts.lower), _arrays.array3(self._facts.upper)])
        return box if (box[0] <= box[1]).all() else np.full((2, 3), np.nan)

    @property
    def triangles(self) -> int:
        """The number of triangles."""
        return self._facts.triangles

    @property
    def objects(self) -> int:
        """The number of objects."""
        return self._facts.objects

    @property
    def bytes(self) -> int:
        """Memory for triangles and index; of a store all that it may take."""
        return self._facts.bytes

    def __repr__(self) -> str:
        return f"<roam.{type(self).__name__} of {self.triangles} triangles>"


class World(Space):
    """Triangles in memory, with an index: 11 to 25 bytes a triangle."""

    @classmethod
    def from_arrays(cls, vertices: ArrayLike, triangles: ArrayLike, *, name: str = "", threads: int = 0,
                    lossless: bool = False, progress: Progress = None) -> "World":
        """A world of one object. The arrays are copied.

        vertices   (V, 3), metres, finite, at most 1e9
        triangles  (T, 3), integers: indices into vertices; either winding, also without area
        name       of the object, see object_name()
        threads    at most one a core; 0: one a core
        lossless   bodies stop up to 0.01 mm before a wall instead of 2 mm, for up to 9 more bytes a triangle
        """
        return cls.from_meshes([(name, vertices, triangles)], threads=threads, lossless=lossless, progress=progress)

    @classmethod
    def from_meshes(cls, meshes: Iterable[Tuple[str, ArrayLike, ArrayLike]], *, threads: int = 0,
                    lossless: bool = False, progress: Progress = None) -> "World":
        """A world of several objects: tuples (name, vertices, triangles), numbered from 0 as they come."""
        arrays, count = _arrays.meshes(meshes), _arrays.whole(threads, "threads")
        structs, made = mesh_structs(arrays), SpaceHandle()

        def work(note: Any) -> None:
            call("roam_world_build", structs, ctypes.c_size_t(len(arrays)),
                 ctypes.byref(world_options(note, count, lossless)), made.handle.address)

        run(progress, work)
        return cls(made)

    @classmethod
    def open(cls, path: Path, *, up: Optional[str] = None, unit: str = "m", threads: int = 0, lossless: bool = False,
             progress: Progress = None) -> "World":
        """Reads a scene file, or a folder of photogrammetry tiles. docs/importing.md lists the formats.

        up    the axis of the file that points up: "x", "y", "z", "-x", "-y" or "-z"; None: y for glTF, else z
        unit  of the file's coordinates: "m", "cm", "mm", "ft" or "in"
        """
        text, count, made = _arrays.path_text(path), _arrays.whole(threads, "threads"), SpaceHandle()

        def work(note: Any) -> None:
            options = world_options(note, count, lossless, up, unit)
            call("roam_world_open", text, ctypes.byref(options), made.handle.address)

        run(progress, work)
        return cls(made)


class Store(Space):
    """A scene on disk or on a web server, of any size, in fixed memory. `roam build` makes one.

    Each query first loads what it needs; so queries run one after another. Space that does not fit into memory, or does
    not come within `patience` seconds, is `unknown` in the results, and hit as if it were solid; so may be what lies
    more than 1000 m from the start of a motion. A store has no objects to ignore. OSError if it cannot be read. After
    os.fork(), open a store anew.
    """

    @classmethod
    def open(cls, path: Path, memory: Union[int, str] = "64M", *, loaders: int = 0,
             patience: float = 10.0, cache: Optional[Path] = None, cache_size: Union[int, str] = "1G",
             redirects: bool = False, web_patience: float = 20.0) -> "Store":
        """Opens a store. `memory`: bytes, or a text such as "64M", at least 8M. `loaders`: loading threads, 1 to 16; 0:
        1 for a folder, up to 8 for a web server. `patience`: seconds that a query waits for what it needs, as far as
        memory holds that. `path` may be an address; only then `cache` is a file of `cache_size` for what is read,
        `redirects` follows the server to other hosts and folders, and `web_patience` is the time in seconds, 0.1 to
        3600, for which a failing request is tried again."""
        patience = _arrays.number(patience, "patience")
        if not 0.0 <= patience < float("inf"):
            raise ValueError(f"patience must be at least 0 seconds; it is {patience}")
        options = _structs.StoreOptions(memory=_arrays.memory_bytes(memory),
                                        loaders=_arrays.whole(loaders, "loaders", 0, 16),
                                        cache=None if cache is None else _arrays.path_text(cache),
                                        cache_bytes=_arrays.memory_bytes(cache_size, "cache_size"),
                                        patience=_arrays.positive(web_patience, "web_patience"),
                                        redirects=bool(redirects))
        text, made = _arrays.path_text(path), SpaceHandle(StoreLock(), patience)

        def work(note: Any) -> None:
            options.progress = note
            call("roam_store_open", text, ctypes.byref(options), made.handle.address)

        run(None, work)
        return cls(made)
