"""Bodies that walk and fly."""

import ctypes
import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _structs
from ._arrays import Floats, Progress, array3
from ._library import Handle, call, run
from ._spaces import Space

if TYPE_CHECKING:
    from ._surveys import Profile

MODES = ("walk", "fly", "ghost")
EVENTS = ("slid", "blocked", "stepped_up", "stepped_down", "jumped", "airborne", "landed", "fell", "crouched", "stood",
          "placed", "freed", "held", "put_back", "returned", "throttled", "met_unknown", "slowed", "narrowed",
          "widened", "bridged")
OUTCOMES = ("reached", "blocked", "left_scene", "fell", "held")


def _signed(triangle: int) -> int:
    return triangle - 2**64 if triangle >= 2**63 else triangle


class Step:
    """What one call did to a walker. Lengths are metres, times seconds."""

    def __init__(self, facts: _structs.Step) -> None:
        self.start: Floats = array3(getattr(facts, "from"))  #: (3,): the centre before
        self.end: Floats = array3(facts.to)  #: (3,): the centre now
        self.radius: float = facts.radius  #: of the body now
        self.height: float = facts.height  #: of the body now
        self.gap: float = facts.gap  #: certified, at `end`; <= 0: none, as of a ghost, or of a body that overlaps
        self.least_gap: float = facts.least_gap  #: certified, over the whole move
        self.length: float = facts.length  #: of the way
        self.elapsed: float = facts.elapsed  #: simulated time: dt, or a part of it
        self.landing_speed: float = facts.landing_speed  #: m/s; 0: no landing
        self.grounded: bool = bool(facts.grounded)  #: stands on something
        self.blocked: bool = bool(facts.blocked)  #: could not go on
        self.blocked_by: int = _signed(facts.blocked_by)  #: the triangle that stops it; -1: none
        self.held: bool = bool(facts.held)  #: cannot move at all
        self.unknown: bool = bool(facts.unknown)  #: touches a part of a store that is not loaded
        self._bits: int = facts.events

    @property
    def events(self) -> Tuple[str, ...]:
        """Events such as "slid", "blocked", "stepped_up", "landed"; roam/step_report.h explains each."""
        return tuple(name for bit, name in enumerate(EVENTS) if self._bits >> bit & 1)


@dataclass(frozen=True)
class Route:
    """How following a route ended. Lengths are metres."""

    outcome: str  #: "reached", "blocked", "left_scene", "fell" or "held"
    waypoints: int  #: how many were reached, with the start
    steps: int
    length: float  #: of the way
    simulated: float  #: seconds
    least_gap: float  #: certified, over all of it
    end: Floats  #: (3,): the centre
    blocked_by: int  #: the triangle; -1: none
    blocked_at: Floats  #: (3,), on that triangle
    opening: float  #: width of the opening that is too small; 0: a closed wall


class Walker:
    """A body that walks or flies at your command, and never through a wall. docs/walking.md has its rules.

    space    a World, a Store or another Space
    start    (3,): the centre. A body that does not fit there is freed to the nearest free position, or held
    radius, height   metres; height 2 * radius makes a sphere
    mode     "walk", "fly" or "ghost"
    profile  sizes and regions of a Profile instead of radius and height
    others   eye, step, slope_degrees, support_radius, gravity, jump_height, crouch_height, clearance_reach
    """

    def __init__(self, space: Space, start: ArrayLike, *, radius: float = 0.3, height: float = 1.8,
                 mode: str = "walk", profile: Optional["Profile"] = None, **others: float) -> None:
        if not isinstance(space, Space):
            raise TypeError(f"space must be a roam.World or roam.Store; it is a {type(space).__name__}")
        known = ("eye", "step", "slope_degrees", "support_radius", "gravity", "jump_height", "crouch_height",
                 "clearance_reach")
        for name in others:
            if name not in known:
                raise TypeError(f"a walker has no setting {name}; it has {', '.join(known)}")
        at = _arrays.vec3(_arrays.position(start, "start"))
        number = _arrays.one_of(mode, MODES, "mode")
        settings = _structs.WalkerSettings()
        call("roam_walker_person", ctypes.byref(settings), ctypes.c_double(_arrays.number(radius, "radius")),
             ctypes.c_double(_arrays.number(height, "height")))
        if profile is not None:
            call("roam_profile_apply", profile._handle.value, ctypes.byref(settings))
        for name, value in others.items():
            setattr(settings, name, _arrays.number(value, name))
        self.space, self._handle = space, Handle("walker", space._handle.lock)
        self._own_lock = threading.Lock()

        def work(note: Any) -> None:
            where = space._handle
            if where.is_store:
                body = _structs.Query(radius=settings.radius, half_height=0.5 * settings.height - settings.radius)
                setattr(body, "from", at)
                where.load(body, note)
            call("roam_walker_create", where.handle.value, ctypes.byref(settings), number, at, self._handle.address)
            if profile is not None:
                call("roam_walker_set_regions", self._handle.value, profile._handle.value)

        run(None, work, self._lock) if space._handle.is_store else work(None)

    @property
    def _lock(self) -> threading.Lock:
        """In a store, walkers and queries wait for each other."""
        return self.space._handle.alone() or self._own_lock

    def _call(self, function: str, *arguments: Any) -> Step:
        """A call that reports a step. In a store, what has been loaded is then taken into use."""
        step = _structs.Step()
        with self._lock:
            call(function, self._handle.value, *arguments, ctypes.byref(step))
            if self.space._handle.is_store:
                call("roam_space_update", self.space._handle.handle.value, self._handle.value, None)
        return Step(step)

    def _state(self) -> _structs.WalkerState:
        state = _structs.WalkerState()
        with self._lock:
            call("roam_walker_get_state", self._handle.value, ctypes.byref(state))
        return state

    def step(self, velocity: ArrayLike, dt: float = 1.0 / 60.0, *, jump: bool = False, crouch: bool = False,
             acceleration: float = np.inf, braking: float = np.inf) -> Step:
        """Moves for `dt` seconds at `velocity`, (3,) in m/s; on foot only its horizontal part counts.

        acceleration, braking   m/s2, > 0: how fast the body approaches that velocity
        """
        wish = _structs.WalkerInput(velocity=_arrays.vec3(_arrays.position(velocity, "velocity")),
                                    acceleration=_arrays.positive(acceleration, "acceleration"),
                                    braking=_arrays.positive(braking, "braking"), jump=bool(jump), crouch=bool(crouch))
        return self._call("roam_walker_step", ctypes.byref(wish), ctypes.c_double(_arrays.number(dt, "dt")))

    def place(self, centre: ArrayLike) -> Step:
        """Puts the body at rest with its centre at `centre`, (3,)."""
        return self._call("roam_walker_place", _arrays.vec3(_arrays.position(centre, "centre")))

    def place_feet(self, feet: ArrayLike) -> Step:
        """Puts the body at rest with its lowest point at `feet`, (3,), which may lie on the floor."""
        return self._call("roam_walker_place_feet", _arrays.vec3(_arrays.position(feet, "feet")))

    def follow(self, waypoints: ArrayLike, *, speed: float = 1.4, dt: float = 1.0 / 60.0, patience: float = 1.0,
               wait: float = 10.0, progress: Progress = None) -> Route:
        """Puts the body at the first waypoint and heads for each in turn; it searches no path.

        waypoints  (N, 3): positions of the centre
        speed      m/s;  dt  seconds of a step;  patience  seconds without progress after which the body is blocked
        wait       seconds of real time to wait for a store
        progress   gets the fraction of the waypoints reached; in a store 0
        """
        path = np.require(np.atleast_2d(_arrays.positions(waypoints, "waypoints")), requirements="CA")
        options, end = _structs.RouteOptions(), _structs.RouteResult()
        for name, value in (("speed", speed), ("dt", dt), ("patience", patience), ("wait", wait)):
            setattr(options, name, _arrays.positive(value, name))

        def work(note: Any) -> None:
            options.progress = note
            call("roam_route_follow", self._handle.value, ctypes.c_void_p(path.ctypes.data),
                 ctypes.c_size_t(len(path)), ctypes.byref(options), ctypes.byref(end))

        run(progress, work, self._lock)
        return Route(OUTCOMES[end.outcome], end.waypoints, end.steps, end.length, end.simulated, end.least_gap,
                     array3(end.end), _signed(end.blocked_by), array3(end.blocked_at), end.opening)

    def copy(self) -> "Walker":
        """A second body in the same state, such as a snapshot to return to."""
        made = Walker.__new__(Walker)
        made.space, made._handle = self.space, Handle("walker", self._handle.lock)
        made._own_lock = threading.Lock()
        with self._lock:
            call("roam_walker_copy", self._handle.value, made._handle.address)
        return made

    @property
    def mode(self) -> str:
        """"walk", "fly" or "ghost"."""
        return MODES[self._state().mode]

    @mode.setter
    def mode(self, mode: str) -> None:
        self._call("roam_walker_set_mode", _arrays.one_of(mode, MODES, "mode"))

    @property
    def position(self) -> Floats:
        """(3,): the centre."""
        return array3(self._state().position)

    @property
    def feet(self) -> Floats:
        """(3,): the lowest point."""
        return array3(self._state().feet)

    @property
    def eye(self) -> Floats:
        """(3,): the camera."""
        return array3(self._state().eye)

    @property
    def velocity(self) -> Floats:
        """(3,), m/s: over the last call."""
        return array3(self._state().velocity)

    @property
    def radius(self) -> float:
        """Of the body now, metres."""
        return self._state().radius

    @property
    def height(self) -> float:
        """Of the body now, metres: less when it crouches."""
        return self._state().height

    @property
    def grounded(self) -> bool:
        """Stands on something."""
        return bool(self._state().grounded)

    @property
    def crouched(self) -> bool:
        return bool(self._state().crouched)

    @property
    def held(self) -> bool:
        """Cannot move: it does not fit, or the space around it is unknown."""
        return bool(self._state().held)

    @property
    def settings(self) -> Dict[str, float]:
        """The body, standing, and what it can do, with its present radius."""
        settings = _structs.WalkerSettings()
        with self._lock:
            call("roam_walker_get_settings", self._handle.value, ctypes.byref(settings))
        return {name: getattr(settings, name) for name, _ in settings._fields_ if name != "size"}
