"""Queries: the results of C++ to the bit, any layout of arrays, and many threads."""

import gc
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import roam
from conftest import Clutter


def test_a_million_results_are_those_of_cpp_to_the_bit(clutter_world, tmp_path):
    clutter = Clutter(queries=1_000_000)  # in the same triangles
    n = len(clutter.from_)
    clutter.save(tmp_path / "in")
    subprocess.run([os.environ["ROAM_QUERY_ANSWERS"], tmp_path / "in", tmp_path / "out"], check=True)
    expected = np.fromfile(tmp_path / "out", np.dtype([
        ("hit", "?"), ("unknown", "?"), ("fits", "?"), ("found", "?"), ("object", "i4"), ("time", "f8"), ("gap", "f8"),
        ("point", "f8", 3), ("normal", "f8", 3), ("triangle", "i8"), ("near_gap", "f8"), ("near_point", "f8", 3),
        ("near_triangle", "i8"), ("count", "i8"), ("contacts", "i8", 4)]))
    assert len(expected) == n

    swept = clutter_world.sweep(clutter.radius, clutter.from_, clutter.motion, clutter.half_height)
    hit = expected["hit"]
    assert 0.2 < hit.mean() < 0.98
    for name in ("hit", "triangle", "object", "unknown"):
        assert (getattr(swept, name) == expected[name]).all(), name
    for name in ("time", "gap", "point", "normal"):
        assert getattr(swept, name)[hit].tobytes() == expected[name][hit].tobytes(), name
        assert np.isnan(getattr(swept, name)[~hit]).all(), name

    near = clutter_world.clearance(clutter.radius, clutter.from_, 1.5, clutter.half_height)
    assert (near.found == expected["found"]).all()
    assert near.gap.tobytes() == expected["near_gap"].tobytes()
    assert near.point[near.found].tobytes() == expected["near_point"][near.found].tobytes()
    assert (near.triangle == expected["near_triangle"]).all()
    contacts = clutter_world.contacts(clutter.radius, clutter.from_, 1.5, clutter.half_height, most=4)
    assert (contacts.count == expected["count"]).all()
    assert (contacts.triangle == expected["contacts"]).all()
    assert (np.isnan(contacts.gap) == (contacts.triangle == -1)).all()
    fits = clutter_world.fits(clutter.radius, clutter.from_, clutter.half_height)
    assert (fits == expected["fits"]).all()
    assert 0.02 < fits.mean() < 0.98


def test_a_single_position_gives_results_without_n(room):
    hit = room.sweep(0.3, [1, 0, 1.5], (8, 0, 0))
    assert bool(hit.hit) is True
    assert hit.time.shape == () and hit.point.shape == (3,)
    assert 8 * hit.time == pytest.approx(3.7, abs=0.003)
    assert hit.normal == pytest.approx([-1, 0, 0])
    assert room.object_name(hit.triangle) == "wall"
    assert room.ray([1, 0, 1.5], [8, 0, 0]).time == pytest.approx(0.5, abs=1e-3)
    assert room.clearance(0.3, [4, 0, 1.5], 5.0).gap == pytest.approx(0.7, abs=0.003)
    assert room.fits(0.3, [4, 0, 1.5]) and not room.fits(1.3, [4, 0, 1.5])
    miss = room.sweep(0.3, [1, 0, 1.5], (1, 0, 0))
    assert not miss.hit and np.isnan(miss.time) and miss.triangle == -1 and miss.object == -1
    assert room.object_name(miss.triangle) == ""


def test_one_value_serves_all_queries(room):
    from_ = np.array([[1, y, 1.5] for y in np.linspace(-3, 4, 50)])
    all_rows = room.sweep(np.full(50, 0.3), from_, np.tile([8.0, 0, 0], (50, 1)), np.full(50, 0.2))
    one = room.sweep(0.3, from_, [8, 0, 0], 0.2)
    assert all_rows.time.tobytes() == one.time.tobytes()
    assert (room.sweep(np.linspace(0, 1, 50), [1, 0, 1.5], [8, 0, 0]).time[1:] > 0).all()


@pytest.mark.parametrize("change", [
    lambda a: a[::-1][::-1], lambda a: np.asfortranarray(a), lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a[:, ::-1].copy()[:, ::-1], lambda a: a.tolist(), lambda a: a.astype(">f8"),
    lambda a: np.frombuffer(b"x" + a.tobytes(), np.float64, offset=1).reshape(a.shape)])
def test_arrays_of_any_layout(clutter, clutter_world, change):
    some = slice(0, 500)
    expected = clutter_world.sweep(0.2, clutter.from_[some], clutter.motion[some])
    got = clutter_world.sweep(0.2, change(clutter.from_[some]), change(clutter.motion[some]))
    assert got.time.tobytes() == expected.time.tobytes()


def test_read_only_and_other_types(clutter_world, clutter):
    from_ = clutter.from_[:100].copy()
    from_.flags.writeable = False
    assert (clutter_world.sweep(0.2, from_, [1, 0, 0]).hit == clutter_world.sweep(0.2, from_, [1, 0, 0]).hit).all()
    single = from_.astype(np.float32)
    assert (clutter_world.fits(0.2, single) == clutter_world.fits(0.2, single.astype(float))).all()
    assert clutter_world.sweep(np.float32(0.25), np.zeros((3, 3), int), np.ones((3, 3), np.int8)).hit.shape == (3,)


def test_empty_arrays_and_worlds(room):
    none = room.sweep(0.3, np.empty((0, 3)), [1, 0, 0])
    assert none.time.shape == (0,) and none.point.shape == (0, 3)
    assert room.contacts(0.3, np.empty((0, 3)), 1.0).gap.shape == (0, 16)
    empty = roam.World.from_arrays([], [])
    assert empty.triangles == 0 and np.isnan(empty.bounds).all()
    assert not empty.sweep(0.3, [0, 0, 0], [9, 9, 9]).hit


def test_ignored_objects(room):
    assert room.ray([1, 0, 1], [8, 0, 0]).object == 1
    assert not room.ray([1, 0, 1], [8, 0, 0], ignored=[1]).hit
    open_room = room.without({1})
    assert not open_room.ray([1, 0, 1], [8, 0, 0]).hit
    assert open_room.ray([1, 0, 1], [0, 0, -8]).object == 0


def test_many_threads_give_the_same_bits(clutter, clutter_world):
    expected = clutter_world.sweep(clutter.radius, clutter.from_, clutter.motion).time.tobytes()
    wrong = []

    def work():
        for _ in range(3):
            if clutter_world.sweep(clutter.radius, clutter.from_, clutter.motion).time.tobytes() != expected:
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_arrays_that_change_in_another_thread(clutter, clutter_world):
    from_, motion, ended = clutter.from_.copy(), clutter.motion.copy(), threading.Event()

    def change():
        rng = np.random.default_rng(3)
        while not ended.is_set():
            some = rng.integers(0, len(from_), 100)
            from_[some] = rng.choice([np.nan, np.inf, -1e300, 1e9, 0.0, 2.0], (100, 1))
            motion[some] = rng.choice([np.nan, 1e300, 1e6, 0.0, 1.0], (100, 1))

    thread = threading.Thread(target=change)
    thread.start()
    refused = 0
    for _ in range(20):
        try:
            swept = clutter_world.sweep(clutter.radius, from_, motion)
            assert swept.time.shape == (len(from_),)
        except ValueError as error:
            assert "query" in str(error)
            refused += 1
    ended.set()
    thread.join()
    assert refused > 0
    # What was computed beside the changes has left no trace.
    expected = clutter_world.sweep(clutter.radius, clutter.from_, clutter.motion).time
    assert clutter_world.sweep(clutter.radius, clutter.from_, clutter.motion).time.tobytes() == expected.tobytes()


def resident():
    """Bytes of memory of this process."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_ten_thousand_calls_leave_no_memory(room):
    from_, motion = np.zeros((20, 3)), np.ones((20, 3))
    walker = roam.Walker(room, [1, 0, 1])

    def work(times):
        for i in range(times):
            room.sweep(0.1, from_, motion)
            room.contacts(0.1, from_, 5.0, most=8)
            walker.step([0.1, 0, 0], 1e-3)
            if i % 10 == 0:
                with pytest.raises(ValueError):
                    room.sweep(0.1, from_ * np.nan, motion)
                roam.Walker(room.without([1]), [1, 0, 1])
                room.fits(0.1, np.zeros((300, 3)))  # in a thread of its own
        gc.collect()

    work(1000)
    before = resident()
    work(10_000)
    assert resident() - before < 10_000 * 100  # bytes a call


def test_a_batch_of_many_contacts_can_be_interrupted(room, monkeypatch):
    from roam import _queries
    began, run = [], _queries.run
    monkeypatch.setattr(_queries, "run", lambda *arguments: (began.append(1), run(*arguments)))
    room.contacts(0.1, np.zeros((2, 3)), 5.0, most=10)
    assert not began
    room.contacts(0.1, np.zeros((2, 3)), 1000.0, most=1000)
    assert began  # in another thread, while this one takes signals


def test_references_are_given_back(room):
    from_, motion = np.zeros((300, 3)), np.ones((300, 3))
    before = sys.getrefcount(from_), sys.getrefcount(motion)
    for _ in range(50):
        result = room.sweep(0.1, from_, motion)
        with pytest.raises(ValueError):
            room.sweep(-1.0, from_, motion)
    gc.collect()  # of the exceptions
    assert (sys.getrefcount(from_), sys.getrefcount(motion)) == before
    count = sys.getrefcount(result.time)
    assert count == 2  # that of `result`, and the argument


def test_bounds_and_counts(room):
    assert room.bounds == pytest.approx(np.array([[0, -4, 0], [9, 5, 3]]), abs=1e-3)
    assert (room.triangles, room.objects) == (4, 2)
    assert room.bytes > 0 and "4 triangles" in repr(room)


def test_facts_of_a_store_are_not_read_beside_its_queries(store, monkeypatch):
    from roam._spaces import SpaceHandle
    opened = roam.Store.open(store)
    monkeypatch.delattr(SpaceHandle, "facts")
    assert (opened.triangles, opened.objects) == (4, 2) and opened.bytes > 0 and "4 triangles" in repr(opened)
    assert opened.bounds == pytest.approx(np.array([[0, -4, 0], [9, 5, 3]]), abs=1e-3)
