"""libroam.so: calls without the GIL, which Ctrl-C and a progress function can end, and errors as exceptions."""

import atexit
import ctypes
import os
import pathlib
import queue
import sysconfig
import threading
from typing import Any, Callable, Dict, List, Optional

from ._structs import PROGRESS

# The ROAM_INTERFACE of roam.h that this package is written for.
_INTERFACE = 3
# Seconds between two looks at signals.
_BETWEEN_SIGNALS = 0.03

_OK, _CANCELLED = 0, 5
_EXCEPTIONS = {1: ValueError, 2: FileNotFoundError, 3: OSError, 4: MemoryError}


def _load() -> ctypes.CDLL:
    above = pathlib.Path(__file__).resolve().parent.parent.parent
    name = "libroam.so.0"
    # Of a build; of an installation, in lib or in lib/<architecture>; or wherever the system looks.
    places = [above / name, above.parent / name]
    places.append(above.parent / (sysconfig.get_config_var("MULTIARCH") or "") / name)
    path = next((str(place) for place in places if place.is_file()), name)
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"the module roam needs {name}, which is not in {', '.join(str(p.parent) for p in places)}, "
                          f"nor where the system looks ({error}); build or install roam") from error
    library.roam_interface.restype = ctypes.c_uint32
    if library.roam_interface() < _INTERFACE:
        raise ImportError(f"{path} is older than the module roam; install the two of one version")
    for function in ("roam_version", "roam_error"):
        getattr(library, function).restype = ctypes.c_char_p
    for function in ("roam_space_free", "roam_walker_free", "roam_survey_free", "roam_profile_free", "roam_path_free"):
        getattr(library, function).restype = None
    library.roam_object_name.restype = ctypes.c_size_t
    library.roam_path_points.restype = ctypes.c_void_p
    return library


library = _load()


class StoreLock:
    """The lock of a store, which one thread uses at a time, in the process that opened it.

    A forked process lacks the store's threads: a query would wait for them, and so would the end of the store.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process = os.getpid()

    @property
    def is_of_this_process(self) -> bool:
        return os.getpid() == self._process

    def here(self) -> threading.Lock:
        """The lock. An interruption cannot come between its acquisition and the block of a `with`."""
        if not self.is_of_this_process:
            raise RuntimeError("a store cannot be used in a process that was forked after Store.open; open it there")
        return self._lock


class Handle:
    """A handle of the library, freed with the last reference to it; that of a store, with `lock`, not after a fork."""

    def __init__(self, kind: str, lock: Optional[StoreLock] = None) -> None:
        self.value = ctypes.c_void_p()
        self.lock = lock
        self._free = getattr(library, f"roam_{kind}_free")

    def __del__(self) -> None:
        if self.lock is None or self.lock.is_of_this_process:
            self._free(self.value)

    @property
    def address(self) -> Any:
        """Where a function puts the handle."""
        return ctypes.byref(self.value)


def call(name: str, *arguments: Any) -> None:
    """Calls a function that returns a roam_status; raises what it reports."""
    status = getattr(library, name)(*arguments)
    if status != _OK:
        raise _error(status)


def _error(status: int) -> Exception:
    text = (library.roam_error() or b"").decode("utf-8", "replace")
    return _EXCEPTIONS.get(status, RuntimeError)(text)


class _Running:
    """The work that run() has begun. It ends before the interpreter does.

    A thread that comes back to Python later is ended in the middle of C++, which aborts the whole process.
    """

    def __init__(self) -> None:
        self._closed = False
        self.forget()
        atexit.register(self.close)

    def forget(self) -> None:
        """After a fork the child has no other threads."""
        self._lock = threading.Lock()
        self._cancelled_of: Dict[threading.Event, threading.Event] = {}

    def ends_here(self) -> bool:
        """Whether the interpreter is about to end this daemon thread. Functions at exit still work."""
        return self._closed and threading.current_thread() is not threading.main_thread()

    def add(self, ended: threading.Event, cancelled: threading.Event) -> None:
        with self._lock:
            if self.ends_here():
                raise SystemExit  # ends a thread without a word
            self._cancelled_of[ended] = cancelled

    def remove(self, ended: threading.Event) -> None:
        with self._lock:
            self._cancelled_of.pop(ended, None)

    def close(self) -> None:
        with self._lock:
            self._closed = True
            all_running = dict(self._cancelled_of)
        for cancelled in all_running.values():
            cancelled.set()
        for ended in all_running:
            ended.wait()


_running = _Running()


class _Helper:
    """A thread that does work, and then waits for more: oneTBB 2021.8 leaks 9 KB for each thread that ends."""

    idle: "List[_Helper]" = []

    def __init__(self) -> None:
        self._work: "queue.SimpleQueue[Callable[[], None]]" = queue.SimpleQueue()
        threading.Thread(target=self._serve, name="roam", daemon=True).start()

    def _serve(self) -> None:
        while True:
            self._work.get()()

    @classmethod
    def begin(cls, work: Callable[[], None], end: Callable[[], None]) -> None:
        """Does `work`, which must not raise, in a thread that is idle, or a new one; then calls `end`."""
        try:
            helper = cls.idle.pop()
        except IndexError:
            helper = cls()

        def all_of_it() -> None:
            work()
            cls.idle.append(helper)
            end()

        helper._work.put(all_of_it)


os.register_at_fork(after_in_child=_Helper.idle.clear)
os.register_at_fork(after_in_child=_running.forget)


def run(progress: Optional[Callable[[float], object]], work: Callable[[Any], None],
        lock: Optional[threading.Lock] = None) -> None:
    """Runs `work` in another thread, with `lock` if given, and passes it a PROGRESS.

    Meanwhile this thread takes signals and calls `progress` with the fraction done. An exception of either ends the
    work and is raised.
    """
    state = {"done": 0.0}
    cancelled, ended = threading.Event(), threading.Event()

    @PROGRESS
    def note(done: float, _data: Any) -> int:
        state["done"] = done
        return int(cancelled.is_set())

    failure = []
    ticket = [True]  # who takes it decides whether the work begins

    def body() -> None:
        if not _taken(ticket):
            return
        try:
            if lock is not None:
                while not lock.acquire(timeout=_BETWEEN_SIGNALS):
                    if cancelled.is_set():
                        return
            try:
                work(note)
            finally:
                if lock is not None:
                    lock.release()
        except BaseException as error:
            failure.append(error)

    try:
        _running.add(ended, cancelled)
        _Helper.begin(body, ended.set)
        while not ended.wait(_BETWEEN_SIGNALS):
            if progress is not None:
                progress(state["done"])
    except BaseException:
        cancelled.set()
        if not _taken(ticket):
            _join(ended)
        _running.remove(ended)
        raise
    _running.remove(ended)
    if failure:
        raise SystemExit if _running.ends_here() else failure[0]


def _taken(ticket: List[bool]) -> bool:
    try:
        return ticket.pop()
    except IndexError:
        return False


def _join(ended: threading.Event) -> None:
    """Waits for work that was cancelled: its arguments must live as long. Another Ctrl-C does not shorten that."""
    while True:
        try:
            ended.wait()
            return
        except BaseException:
            continue


def free_memory() -> Optional[int]:
    """Bytes that are free; None if the system does not say."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next(int(line.split()[1]) << 10 for line in lines if line.startswith("MemAvailable:"))
    except (OSError, StopIteration):
        return None
