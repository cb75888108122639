"""Batches of queries and their results."""

import ctypes
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._arrays import Floats, Progress, check_memory, lengths, number, objects, positions
from ._library import call, run

# So few results are there before a thread has begun.
_FEW = 256


@dataclass(frozen=True)
class Sweep:
    """First impacts of N motions. In a miss, numbers are NaN, and triangle and object are -1."""

    hit: NDArray[np.bool_]  #: (N,): the body meets something on its way, or starts in touch with it
    time: Floats  #: (N,): fraction of the motion that is certified free, in [0, 1]
    point: Floats  #: (N, 3): the contact, on the triangle
    normal: Floats  #: (N, 3): unit vector from the point towards the body's axis
    triangle: NDArray[np.int64]  #: (N,): its number, in the order of the scene; in a store only for object_name()
    object: NDArray[np.int32]  #: (N,): number of its mesh; -1 in a store
    gap: Floats  #: (N,): certified lower bound of the gap at `time`; negative: starts so deep in it
    unknown: NDArray[np.bool_]  #: (N,): what is hit is a part of a store that is not loaded


@dataclass(frozen=True)
class Clearance:
    """The gaps between N bodies and what is nearest. Where nothing is found, the gap is the reach."""

    found: NDArray[np.bool_]  #: (N,): something is within the reach
    gap: Floats  #: (N,): certified lower bound of the distance from the body's surface; <= 0: touches
    point: Floats  #: (N, 3): the nearest point, on the triangle; NaN: not found
    normal: Floats  #: (N, 3): unit vector from the point towards the body's axis; NaN: not found
    triangle: NDArray[np.int64]  #: (N,)
    object: NDArray[np.int32]  #: (N,)
    unknown: NDArray[np.bool_]  #: (N,)


@dataclass(frozen=True)
class Contacts:
    """The M nearest triangles of N bodies, nearest first. Beyond `count`, numbers are NaN or -1."""

    count: NDArray[np.int64]  #: (N,): how many were found, at most M; fewer than M means all within the reach
    gap: Floats  #: (N, M)
    point: Floats  #: (N, M, 3)
    normal: Floats  #: (N, M, 3)
    triangle: NDArray[np.int64]  #: (N, M)
    object: NDArray[np.int32]  #: (N, M)
    unknown: NDArray[np.bool_]  #: (N, M)


class Batch:
    """N bodies and motions; each argument is for all of them, or has a row for each."""

    def __init__(self, from_: ArrayLike, motion: Optional[ArrayLike], radius: ArrayLike, half_height: ArrayLike,
                 place_name: str = "from_") -> None:
        self.arguments: Dict[str, Optional[Floats]] = {
            place_name: positions(from_, place_name),
            "motion": None if motion is None else positions(motion, "motion"),
            "radius": lengths(radius, "radius"),
            "half_height": lengths(half_height, "half_height"),
        }
        self.count, self.single = 1, True
        named = ""
        for name, array in self.arguments.items():
            if array is None or array.ndim == (1 if name in (place_name, "motion") else 0):
                continue
            if not self.single and len(array) != self.count:
                raise ValueError(f"{name} has {len(array)} rows, and {named} has {self.count}; "
                                 "give each the same number, or one for all")
            self.count, self.single, named = len(array), False, name

    def run(self, space: Any, function: str, results: Dict[str, NDArray[Any]], ignored: Iterable[int],
            progress: Progress, reach: float = 0.0, most: int = 1) -> None:
        """Calls a function of the library that takes a roam_batch of these and of `results`."""
        left_out = np.array(objects(ignored, "ignored"), np.uint32)
        batch = _structs.Batch(count=self.count, ignored=left_out.ctypes.data, ignored_count=len(left_out), reach=reach,
                               most=most)
        for member, array in zip(("from", "motion", "radius", "half_height"), self.arguments.values()):
            if array is not None:
                one_each = array.ndim == (2 if member in ("from", "motion") else 1)
                setattr(batch, member, _structs.Input(array.ctypes.data, array.strides[0] if one_each else 0))
        for member, array in results.items():
            setattr(batch, member, _structs.Output(array.ctypes.data, array.strides[0]))
        kept = (self, results, left_out)  # as long as the work, which knows only their addresses
        if space.is_store:
            run(progress, lambda note, kept=kept: _in_store(space, function, batch, results, note), space.alone())
        elif self.count * most <= _FEW and progress is None:
            call(function, space.handle.value, ctypes.byref(batch))
        else:
            def work(note: Any, kept: Any = kept) -> None:
                batch.progress = note
                call(function, space.handle.value, ctypes.byref(batch))
            run(progress, work)

    def room(self, kinds: Dict[str, Any], most: Optional[int] = None) -> Dict[str, NDArray[Any]]:
        """Arrays for the results: names to their types, or to (type, columns)."""
        rows = (self.count,) if most is None else (self.count, most)
        shapes = {name: (rows + (3,), kind[0]) if isinstance(kind, tuple) else (rows, kind)
                  for name, kind in kinds.items()}
        check_memory(sum(int(np.prod(shape, dtype=object)) * np.dtype(kind).itemsize
                         for shape, kind in shapes.values()), "the results")
        return {name: np.empty(shape, kind) for name, (shape, kind) in shapes.items()}

    def shaped(self, results: Dict[str, NDArray[Any]]) -> Dict[str, Any]:
        return {name: array[0] for name, array in results.items()} if self.single else results


def _in_store(space: Any, function: str, batch: _structs.Batch, results: Dict[str, NDArray[Any]], note: Any) -> None:
    """One query after another: each that meets unknown space loads what it needs, and is made again."""
    columns = [(name, kind, getattr(batch, name).data, getattr(batch, name).stride)
               for name, kind in batch._fields_ if kind in (_structs.Input, _structs.Output)]
    count, batch.count = batch.count, 1
    i = 0
    loading = _structs.PROGRESS(lambda _done, _data: note(i / count, None))  # of queries, not of the time to load

    def met_unknown() -> Optional[int]:
        """Makes query i. Returns the first number of unknown space in its results."""
        try:
            call(function, space.handle.value, ctypes.byref(batch))
        except ValueError as error:
            raise ValueError(str(error).replace("query 0", f"query {i}", 1)) from None
        met = np.flatnonzero(results["unknown"][i])
        return int(np.ravel(results["triangle"][i])[met[0]]) % 2**64 if len(met) > 0 else None

    for i in range(count):
        if note(i / count, None):
            return
        for name, kind, data, stride in columns:
            if data:
                setattr(batch, name, kind(data + i * stride, stride))
        if met_unknown() is None:
            continue
        space.load(_surroundings(batch), loading)
        triangle = met_unknown()
        reason = "" if triangle is None else space.reason_if_unreadable(triangle)
        if reason:
            raise OSError(f"query {i} meets a part of the store that cannot be read: {reason}")


def _surroundings(batch: _structs.Batch) -> _structs.Query:
    """The body and motion of one query, with a radius that contains all within its reach."""
    body = _structs.Query(radius=min(1000.0, _value(batch.radius) + batch.reach), half_height=_value(batch.half_height))
    setattr(body, "from", _structs.Vec3.from_address(getattr(batch, "from").data))
    if batch.motion.data:
        body.motion = _structs.Vec3.from_address(batch.motion.data)
    return body


def _value(column: _structs.Input) -> float:
    return ctypes.c_double.from_address(column.data).value if column.data else 0.0


_NEAR = {"gap": np.float64, "point": (np.float64, 3), "normal": (np.float64, 3), "triangle": np.int64,
         "object": np.int32, "unknown": np.bool_}


def sweep(space: Any, batch: Batch, ignored: Iterable[int], progress: Progress) -> Sweep:
    results = batch.room({"hit": np.bool_, "time": np.float64, **_NEAR})
    batch.run(space, "roam_sweep_batch", results, ignored, progress)
    miss = ~results["hit"]
    for name in ("time", "gap", "point", "normal"):
        results[name][miss] = np.nan
    return Sweep(**batch.shaped(results))


def clearance(space: Any, batch: Batch, reach: float, ignored: Iterable[int], progress: Progress) -> Clearance:
    results = batch.room({"hit": np.bool_, **_NEAR})
    batch.run(space, "roam_clearance_batch", results, ignored, progress, number(reach, "reach"))
    results["found"] = results.pop("hit")
    for name in ("point", "normal"):
        results[name][~results["found"]] = np.nan
    return Clearance(**batch.shaped(results))


def contacts(space: Any, batch: Batch, reach: float, most: int, ignored: Iterable[int],
             progress: Progress) -> Contacts:
    results = batch.room(_NEAR, most)
    results["found"] = batch.room({"found": np.int64})["found"]
    batch.run(space, "roam_contacts_batch", results, ignored, progress, number(reach, "reach"), most)
    results["count"] = results.pop("found")
    none = np.arange(most) >= results["count"][:, None]
    for name in ("gap", "point", "normal"):
        results[name][none] = np.nan
    return Contacts(**batch.shaped(results))


def fits(space: Any, batch: Batch, ignored: Iterable[int], progress: Progress) -> Any:
    in_the_way = {"triangle": np.int64, "unknown": np.bool_} if space.is_store else {}
    results = batch.room({"hit": np.bool_, **in_the_way})
    batch.run(space, "roam_fits_batch", results, ignored, progress)
    return batch.shaped(results)["hit"]
