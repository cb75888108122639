"""Bad input raises the right exception, which names what is wrong; it never ends the interpreter."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import roam


def raises(kind, *parts):
    return pytest.raises(kind, match="(?s)" + ".*".join(parts))


def test_shapes_and_types_are_named(room):
    with raises(ValueError, r"from_", r"\(N, 3\)", r"\(4, 2\)"):
        room.sweep(0.3, np.zeros((4, 2)), [1, 0, 0])
    with raises(ValueError, r"motion has 3 rows", r"from_ has 4"):
        room.sweep(0.3, np.zeros((4, 3)), np.zeros((3, 3)))
    with raises(TypeError, "from_", "numbers", "<U1"):
        room.sweep(0.3, ["a", "b", "c"], [1, 0, 0])
    with raises(TypeError, "from_", "complex"):
        room.sweep(0.3, np.zeros((4, 3), complex), [1, 0, 0])
    with raises(TypeError, "from_", "object"):
        room.sweep(0.3, [None, 1, 2], [1, 0, 0])
    with raises(TypeError, "from_", "without a mask"):
        room.sweep(0.3, np.ma.masked_less(np.zeros((4, 3)), 1), [1, 0, 0])
    with raises(ValueError, "from_", "differ in length"):
        room.sweep(0.3, [[1, 2, 3], [1, 2]], [1, 0, 0])
    with raises(ValueError, "radius", r"\(2, 2\)"):
        room.sweep(np.ones((2, 2)), [1, 0, 0], [1, 0, 0])
    with raises(TypeError, "reach", "object"):
        room.clearance(0.3, [1, 0, 0], object())
    with raises(ValueError, "most", "0"):
        room.contacts(0.3, [1, 0, 0], 1.0, most=0)


def test_values_are_named(room):
    from_ = np.zeros((1000, 3))
    from_[700, 1] = np.nan
    with raises(ValueError, "query 700", "not finite"):
        room.sweep(0.3, from_, [1, 0, 0])
    with raises(ValueError, "radius is -1 m"):
        room.sweep(-1, [0, 0, 0], [1, 0, 0])
    with raises(ValueError, "reach is 2000 m"):
        room.clearance(0.3, [0, 0, 0], 2000)
    with raises(ValueError, "ignored", "-1"):
        room.sweep(0.3, [0, 0, 0], [1, 0, 0], ignored=[-1])
    with raises(TypeError, "ignored", "int"):
        room.sweep(0.3, [0, 0, 0], [1, 0, 0], ignored=3)
    with raises(ValueError, "reach must be a number below"):
        room.clearance(0.3, [0, 0, 0], 10**400)
    survey = roam.Survey.from_arrays([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]])
    with raises(ValueError, "spacing is 5e-324 m", "at least 0.001"):
        survey.probe([1, 1, 1], [2, 2, 1], spacing=5e-324)
    with raises(ValueError, "spacing must be above 0"):
        survey.probe([1, 1, 1], [2, 2, 1], spacing=0)
    for name in ("radius_min", "radius_max", "spacing"):
        with raises(ValueError, f"{name} must be above 0; it is 0"):
            survey.train(**{name: 0})


def test_meshes_are_checked():
    corners = np.eye(3)
    with raises(ValueError, "triangle 1", "index 3", "3 vertices"):
        roam.World.from_arrays(corners, [[0, 1, 2], [0, 1, 3]])
    with raises(ValueError, "triangle 0", "index -1"):
        roam.World.from_arrays(corners, [[0, 1, -1]])
    with raises(TypeError, "triangles", "integers", "float64"):
        roam.World.from_arrays(corners, [[0.0, 1, 2]])
    with raises(ValueError, "triangles", "differ in length"):
        roam.World.from_arrays(corners, [[0, 1, 2], [0, 1]])
    with raises(ValueError, "name", "null byte"):
        roam.World.from_arrays(corners, [[0, 1, 2]], name="a\0b")
    with raises(ValueError, "vertices", r"\(3, 2\)"):
        roam.World.from_arrays(corners[:, :2], [[0, 1, 2]])
    with raises(ValueError, "finite"):
        roam.World.from_arrays(corners * np.nan, [[0, 1, 2]])
    with raises(TypeError, "tuple"):
        roam.World.from_meshes([1])
    with raises(TypeError, "World.from_arrays"):
        roam.World(None)


def test_more_than_the_memory_is_refused(room):
    with raises(MemoryError, "the world"):
        roam.World.from_arrays(np.eye(3), np.broadcast_to(np.array([0, 1, 2], np.uint32), (2**31, 3)))
    with raises(MemoryError, "the results"):
        room.sweep(0.3, np.broadcast_to(np.zeros(3), (2**40, 3)), [1, 0, 0])
    with raises(MemoryError):
        room.fits(0.3, np.broadcast_to(np.float32(0), (2**40, 3)))


def test_files(tmp_path, room_file):
    world = roam.World.open(room_file)
    assert world.triangles == 4 and world.object_name(2) == "wall"
    assert roam.World.open(str(room_file), unit="in").bounds[1, 0] == pytest.approx(9 * 0.0254)
    assert roam.World.open(os.fsencode(room_file), up="-z").bounds[0, 2] == pytest.approx(-3, abs=1e-3)
    with raises(FileNotFoundError, "none.obj"):
        roam.World.open(tmp_path / "none.obj")
    (tmp_path / "empty.obj").write_text("\n")
    with raises(OSError, "empty.obj"):
        roam.World.open(tmp_path / "empty.obj")
    with raises(ValueError, "ell"):
        roam.World.open(room_file, unit="ell")
    with raises(ValueError, "null byte"):
        roam.World.open("a\0b")
    with pytest.raises(TypeError):
        roam.World.open(5)
    with raises(OSError, "opened as a store"):
        roam.World.open("http://127.0.0.1:1/x.roam")
    with raises(FileNotFoundError, "none.roam"):
        roam.Store.open(tmp_path / "none.roam")
    with raises(FileNotFoundError):
        roam.Profile.beside(room_file)


def test_a_store_answers_as_its_scene(room, store, tmp_path):
    opened = roam.Store.open(store, memory="16M")
    assert opened.triangles == 4
    from_ = np.array([[1, y, 1.5] for y in np.linspace(-3, 4, 20)])
    found = opened.sweep(0.3, from_, [8, 0, 0])
    assert not found.unknown.any()
    assert found.time == pytest.approx(room.sweep(0.3, from_, [8, 0, 0]).time, abs=1e-4)
    assert opened.fits(0.3, from_).all()
    walker = roam.Walker(opened, [1, 0, 0.95])
    assert walker.follow([[1, 0, 0.9], [3, 1, 0.9]]).outcome == "reached"
    assert walker.step([1, 0, 0]).grounded
    for wrong in ("64X", "M", "", "-1M"):
        with raises(ValueError, "memory"):
            roam.Store.open(store, memory=wrong)
    with raises(ValueError, "memory"):
        roam.Store.open(store, memory="1M")
    with raises(ValueError, "cache_size"):
        roam.Store.open(store, cache_size="much")
    with raises(ValueError, "4 MiB"):
        roam.Store.open("http://127.0.0.1:1/x.roam", cache=tmp_path / "web.cache", cache_size="1M")
    for wrong in (-1, 0):
        with raises(ValueError, "web_patience must be above 0"):
            roam.Store.open("http://127.0.0.1:1/x.roam", web_patience=wrong)
    begin = time.monotonic()
    with raises(OSError, "no connection"):
        roam.Store.open("http://127.0.0.1:1/x.roam", web_patience=0.1)
    assert time.monotonic() - begin < 10


def test_a_store_loads_all_that_is_within_reach(room, store):
    opened, place = roam.Store.open(store), [[4, 0, 30]]
    near = opened.clearance(0.0, place, reach=50)
    assert not near.unknown.any() and near.gap == pytest.approx(room.clearance(0.0, place, reach=50).gap, abs=1e-3)
    opened = roam.Store.open(store)
    contacts = opened.contacts(0.0, place, reach=50)
    assert contacts.count == [4] and not contacts.unknown.any()


def test_a_bad_row_of_a_store_is_named_before_anything_loads(store):
    opened = roam.Store.open(store, patience=1e6)
    from_ = np.array([[1, 0, 1.5]] * 9)
    motion = np.array([[0, 0, 100.0]] * 9)
    motion[7, 0] = np.nan
    with raises(ValueError, "query 7: cannot answer a query: the motion is not finite"):
        opened.sweep(0.3, from_, motion)
    motion[3] = 2e6
    with raises(ValueError, "query 3: .*motion"):
        opened.sweep(0.3, from_, motion)


def test_progress_in_a_store_counts_queries(store, monkeypatch):
    from roam._spaces import SpaceHandle
    seen = []

    def load(_self, _query, note):
        for _ in range(4):
            note(0.9, None)  # of the time
            time.sleep(0.05)

    monkeypatch.setattr(SpaceHandle, "load", load)
    roam.Store.open(store).fits(0.3, [1, 0, 1.5], progress=seen.append)
    assert seen and max(seen) == 0


def test_a_store_whose_files_are_cut_off(store):
    opened = roam.Store.open(store)
    for pack in pathlib.Path(store).glob("packs/*"):
        os.chmod(pack, 0o644)
        os.truncate(pack, 0)
    with raises(OSError, "query 0", "cannot be read: .* cannot be used: "):
        opened.sweep(0.3, [[1, 0, 1.5]], [[8, 0, 0]])
    assert opened.fits(0.3, [4, 0, 30]) and opened.clearance(0.3, [4, 0, 30], 5).gap == 5
    with raises(OSError, "cannot be read: .* cannot be used: "):
        opened.fits(0.3, [1, 0, 1.5])
    for query in opened.clearance, opened.contacts:
        with raises(OSError, "query 1", "cannot be read: .* cannot be used: "):
            query(0.3, [[4, 0, 90], [4, 0, 30]], 50)
    shutil.rmtree(store)
    with pytest.raises(OSError):
        opened.sweep(0.3, [[1, 0, 1.5]], [[8, 0, 0]])
    with pytest.raises(FileNotFoundError):
        roam.Store.open(store)


def test_a_store_names_its_objects_and_why_space_is_unknown(store):
    opened = roam.Store.open(store)
    hit = opened.sweep(0.3, [1, 0, 1.5], [8, 0, 0])
    assert opened.object_name(hit.triangle) == "wall"
    assert opened.object_name(-1) == ""
    hasty = roam.Store.open(store, patience=0).sweep(0.3, [1, 0, 1.5], [8, 0, 0])
    assert hasty.unknown and hasty.triangle < -1
    assert roam.Store.open(store).object_name(hasty.triangle) == "not loaded yet"
    with raises(ValueError, "triangle"):
        opened.object_name(2**64)


def interrupted(call):
    """Seconds from Ctrl-C to the end of the call."""
    sent = []

    def press():
        time.sleep(0.3)
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    ended = time.monotonic()
    thread.join()
    return ended - sent[0]


def test_ctrl_c_ends_a_batch(clutter_world):
    from_ = np.broadcast_to(np.zeros(3), (2**25, 3))
    # 0.1 s on an idle machine. The tests run beside others, which may delay one of these.
    assert min(interrupted(lambda: clutter_world.fits(0.3, from_, 0.2)) for _ in range(3)) < 1.0


def test_ctrl_c_ends_the_wait_for_a_web_server():
    assert interrupted(lambda: roam.Store.open("http://127.0.0.1:1/x.roam", web_patience=60)) < 30


def test_an_exception_in_progress_ends_the_call(clutter, clutter_world):
    seen = []

    def progress(done):
        seen.append(done)
        if len(seen) == 2:
            raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        clutter_world.fits(0.3, np.broadcast_to(np.zeros(3), (2**25, 3)), progress=progress)
    assert len(seen) == 2 and all(0 <= done <= 1 for done in seen)


def test_the_module_may_lie_in_a_folder_below_the_root(monkeypatch):
    module = sys.modules["roam._library"]
    monkeypatch.setattr(module, "__file__", "/app/roam/_library.py")
    assert module._load().roam_version() == roam.__version__.encode()  # which is loaded already


PROGRAM_THAT_UNLOADS = """
import _ctypes, numpy as np, roam
from roam._library import library
world = roam.World.from_arrays(np.random.default_rng(1).random((30000, 3)), np.arange(30000).reshape(-1, 3))
_ctypes.dlclose(library._handle)
print("libroam.so.0" in open("/proc/self/maps").read())
"""


def test_the_library_stays_loaded_while_it_has_threads():
    said = subprocess.run([sys.executable, "-c", PROGRAM_THAT_UNLOADS], capture_output=True, text=True)
    assert (said.returncode, said.stdout, said.stderr) == (0, "True\n", "")


PROGRAM_THAT_ENDS = """
import threading, time, numpy as np, roam
corners = np.random.default_rng(1).random((3000, 3)) * 30
world = roam.World.from_arrays(corners, np.arange(3000).reshape(-1, 3))
begun = threading.Event()
def work():
    world.sweep(0.3, np.broadcast_to(corners[0], (2_000_000, 3)), [1, 0, 0], progress=lambda done: begun.set())
threading.Thread(target=work, daemon=True).start()
begun.wait()
"""


def test_a_daemon_thread_at_work_ends_with_the_program():
    ended = subprocess.run([sys.executable, "-c", PROGRAM_THAT_ENDS], capture_output=True, text=True)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")


FORKED_WHILE_A_THREAD_IS_AT_WORK = PROGRAM_THAT_ENDS + """
import os, signal, sys
child = os.fork()
if child == 0:
    signal.alarm(20)
    here = world.sweep(0.3, corners, [1, 0, 0]).hit
    sys.exit(0 if here.shape == (3000,) else 1)
print(os.waitpid(child, 0)[1])
"""

FORKED_WITH_A_STORE = """
import os, signal, sys, roam
store = roam.Store.open(sys.argv[1])
walker = roam.Walker(store.without([]), [1, 0, 1])
child = os.fork()
if child == 0:
    signal.alarm(20)
    try:
        for use in (lambda: store.fits(0.3, [1, 0, 1]), lambda: walker.step([1, 0, 0]), lambda: store.object_name(0)):
            try:
                use()
                sys.exit(1)
            except RuntimeError as error:
                assert "forked" in str(error)
        assert store.triangles == 4 and roam.Store.open(sys.argv[1]).fits(0.3, [1, 0, 1])
    finally:
        del store, walker
    sys.exit(0)
print(os.waitpid(child, 0)[1], store.fits(0.3, [1, 0, 1]))
"""


def test_a_forked_process_needs_no_thread_of_its_parent(store):
    for program, said in ((FORKED_WHILE_A_THREAD_IS_AT_WORK, "0\n"), (FORKED_WITH_A_STORE, "0 True\n")):
        ended = subprocess.run([sys.executable, "-c", program, store], capture_output=True, text=True)
        assert (ended.returncode, ended.stdout, ended.stderr) == (0, said, "")
