"""Which bodies get where: probes, training and profiles."""

import ctypes
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _structs
from ._arrays import Floats, Path, Progress, array3
from ._library import Handle, call, library, run
from ._spaces import mesh_structs, world_options
from ._walkers import MODES

LIMITS = ("none", "door", "lintel", "gap", "edge", "start", "target", "height", "step", "apart")


class Profile:
    """The sizes of a body that suit a scene, for Walker(profile=...). docs/profile.md describes the file."""

    def __init__(self, handle: Any) -> None:
        if not isinstance(handle, Handle):
            raise TypeError("make a Profile by Profile.load, Profile.beside or Survey.train")
        self._handle = handle

    @classmethod
    def load(cls, path: Path) -> "Profile":
        """Reads a profile's file."""
        made = Handle("profile")
        call("roam_profile_load", _arrays.path_text(path), made.address)
        return cls(made)

    @classmethod
    def beside(cls, scene: Path) -> "Profile":
        """Reads the profile beside a scene: "dam.ply" has "dam.ply.roam.json"."""
        made = Handle("profile")
        call("roam_profile_beside", _arrays.path_text(scene), made.address)
        return cls(made)

    def save(self, path: Path) -> None:
        """Writes the file; readers see the old or the new one, never a part."""
        call("roam_profile_save", self._handle.value, _arrays.path_text(path))

    @property
    def body(self) -> Dict[str, float]:
        """radius, height, step and support_radius in metres, and slope_degrees."""
        settings = _structs.WalkerSettings()
        call("roam_walker_person", ctypes.byref(settings), ctypes.c_double(0.3), ctypes.c_double(1.8))
        call("roam_profile_apply", self._handle.value, ctypes.byref(settings))
        return {name: getattr(settings, name) for name in ("radius", "height", "step", "support_radius",
                                                           "slope_degrees")}


@dataclass(frozen=True)
class Probe:
    """Whether a body gets from one position to another, and what stops it. Lengths are metres."""

    passable: bool  #: a way is wide enough, and a walker has gone it
    wide_enough: bool  #: a way is wide enough
    proven: bool  #: the answer is certified: see roam/probe.h
    found: bool  #: there is a way for some radius
    path: Floats  #: (P, 3): positions of the centre, for Walker.follow; P is 0 if there is no way
    length: float  #: of the way
    widest_radius: float  #: the largest that passes; infinite: unlimited
    limit: str  #: what limits the way: "none", "door", "lintel", "gap", "edge", "start", "target", "height", ...
    limit_point: Floats  #: (3,): the middle of the measured distance
    limit_direction: Floats  #: (3,): unit vector along it
    limit_size: float  #: a width, a headroom, the height of a step
    limit_needed: float  #: by the body


@dataclass(frozen=True)
class Training:
    """The sizes of a body that pass everywhere and fall nowhere. Lengths are metres."""

    feasible: bool  #: one body without a support disc serves all paths
    radius: float
    height: float
    support_radius: float  #: 0: none is needed
    step: float
    slope_degrees: float
    smallest: float  #: lower end of the radii that serve: half the widest crack; 0: no crack
    largest: float  #: upper end: decided by the narrowest opening; infinite: none
    paths: int
    cracks: int
    places: int  #: free positions searched; 0: no body fits anywhere, and the rest says nothing
    profile: Profile


class Survey:
    """A scene with all that probes and training need: about 120 bytes a triangle."""

    def __init__(self, handle: Any) -> None:
        if not isinstance(handle, Handle):
            raise TypeError("make a Survey by Survey.from_arrays, Survey.from_meshes or Survey.open")
        self._handle = handle

    @classmethod
    def from_arrays(cls, vertices: ArrayLike, triangles: ArrayLike, *, threads: int = 0,
                    progress: Progress = None) -> "Survey":
        """As World.from_arrays."""
        return cls.from_meshes([("", vertices, triangles)], threads=threads, progress=progress)

    @classmethod
    def from_meshes(cls, meshes: Iterable[Tuple[str, ArrayLike, ArrayLike]], *, threads: int = 0,
                    progress: Progress = None) -> "Survey":
        """As World.from_meshes."""
        arrays, count = _arrays.meshes(meshes), _arrays.whole(threads, "threads")
        structs, made = mesh_structs(arrays), Handle("survey")

        def work(note: Any) -> None:
            call("roam_survey_build", structs, ctypes.c_size_t(len(arrays)), ctypes.byref(world_options(note, count)),
                 made.address)

        run(progress, work)
        return cls(made)

    @classmethod
    def open(cls, path: Path, *, up: Optional[str] = None, unit: str = "m", threads: int = 0,
             progress: Progress = None) -> "Survey":
        """As World.open."""
        text, count, made = _arrays.path_text(path), _arrays.whole(threads, "threads"), Handle("survey")

        def work(note: Any) -> None:
            options = world_options(note, count, True, up, unit)
            call("roam_survey_open", text, ctypes.byref(options), made.address)

        run(progress, work)
        return cls(made)

    def probe(self, from_: ArrayLike, to: ArrayLike, *, radius: float = 0.3, height: float = 0.0, mode: str = "walk",
              step: float = 0.3, spacing: float = 0.2, progress: Progress = None) -> Probe:
        """Whether a body gets from `from_` to `to`, (3,) each, and what stops it.

        The positions are of the feet or eyes, which drop to the floor; flying, of the centre. height 0 makes a sphere,
        1.8 a person. step: metres that it climbs. spacing: of the search; openings narrower than 0.7 * spacing may be
        overlooked.
        """
        step = _arrays.number(step, "step")
        if not step >= 0.0:
            raise ValueError(f"step must be at least 0; it is {step}")
        options = _structs.ProbeOptions(
            to=_arrays.vec3(_arrays.position(to, "to")), radius=_arrays.number(radius, "radius"),
            height=_arrays.number(height, "height"), mode=_arrays.one_of(mode, MODES, "mode"), step=step or -1.0,
            spacing=_arrays.positive(spacing, "spacing"))
        setattr(options, "from", _arrays.vec3(_arrays.position(from_, "from_")))
        answer, way = _structs.ProbeAnswer(), Handle("path")

        def work(note: Any) -> None:
            options.progress = note
            call("roam_probe", self._handle.value, ctypes.byref(options), ctypes.byref(answer), way.address)

        run(progress, work)
        count = ctypes.c_size_t()
        points = library.roam_path_points(way.value, ctypes.byref(count))
        path = np.empty((count.value, 3))
        ctypes.memmove(path.ctypes.data, points, path.nbytes)
        return Probe(bool(answer.passable), bool(answer.wide_enough), bool(answer.proven), bool(answer.found), path,
                     answer.length, answer.widest_radius, LIMITS[answer.limit], array3(answer.limit_point),
                     array3(answer.limit_direction), answer.limit_size, answer.limit_needed)

    def train(self, *, mode: str = "walk", height: float = 0.0, paths: int = 0, seed: int = 1,
              radius_min: float = 0.15, radius_max: float = 1.0, spacing: float = 0.2, threads: int = 0,
              progress: Progress = None) -> Training:
        """Finds the sizes of a body that pass everywhere and fall nowhere. docs/training.md explains it.

        height  of a walking body, metres: 1.8 for a person; 0: a sphere
        paths   how many are planned; 0: 5, or one for each dead-end room if there are more
        radius_min  narrower openings are ignored
        """
        options = _structs.TrainOptions(
            mode=_arrays.one_of(mode, MODES, "mode"), height=_arrays.number(height, "height"),
            paths=_arrays.whole(paths, "paths"), seed=_arrays.whole(seed, "seed", 1, 2**63),
            radius_min=_arrays.positive(radius_min, "radius_min"),
            radius_max=_arrays.positive(radius_max, "radius_max"), spacing=_arrays.positive(spacing, "spacing"),
            threads=_arrays.whole(threads, "threads"))
        facts, profile = _structs.Training(), Handle("profile")

        def work(note: Any) -> None:
            options.progress = note
            call("roam_train", self._handle.value, ctypes.byref(options), ctypes.byref(facts), profile.address)

        run(progress, work)
        return Training(bool(facts.feasible), facts.radius, facts.height, facts.support_radius, facts.step,
                        facts.slope_degrees, facts.smallest, facts.largest, facts.paths, facts.cracks, facts.places,
                        Profile(profile))
