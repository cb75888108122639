"""Walkers, probes and training."""

import threading

import numpy as np
import pytest

import roam


def test_walks_to_the_wall(room):
    walker = roam.Walker(room, [1, 0, 2])
    events = set()
    for _ in range(400):
        step = walker.step([1.4, 0, 0])
        events |= set(step.events)
    assert step.blocked and step.grounded and room.object_name(step.blocked_by) == "wall"
    assert step.end == pytest.approx([4.7, 0, 0.9], abs=0.01)
    assert 0 <= step.least_gap < 0.01
    assert {"landed", "blocked"} <= events
    assert walker.feet == pytest.approx(walker.position - [0, 0, 0.9])
    assert walker.settings["radius"] == 0.3 and walker.mode == "walk"


def test_a_copy_is_another_body(room):
    walker = roam.Walker(room, [1, 0, 1], radius=0.2, height=0.4, mode="fly", gravity=0.0)
    copy = walker.copy()
    walker.step([1, 0, 0], 0.5)
    assert copy.position[0] == 1 and walker.position[0] == pytest.approx(1.5)
    copy.mode = "ghost"
    assert (walker.mode, copy.mode) == ("fly", "ghost")
    copy.step([10, 0, 0], 0.5)
    assert copy.position[0] == pytest.approx(6)
    del room, walker
    assert copy.place([2, 2, 2]).end == pytest.approx([2, 2, 2])


def test_routes(room):
    walker = roam.Walker(room, [1, 0, 0.95])
    assert walker.follow([[1, 0, 0.9], [4, 2, 0.9]]).outcome == "reached"
    blocked = walker.follow([[1, 0, 0.9], [8, 0, 0.9]], speed=3)
    assert blocked.outcome == "blocked" and room.object_name(blocked.blocked_by) == "wall"
    assert blocked.waypoints == 1 and blocked.opening == 0


def test_wrong_arguments_are_named(room):
    with pytest.raises(TypeError, match="no setting hieght"):
        roam.Walker(room, [1, 0, 1], hieght=1.8)
    with pytest.raises(ValueError, match="radius"):
        roam.Walker(room, [1, 0, 1], radius=-1)
    with pytest.raises(ValueError, match="mode must be one of walk, fly, ghost"):
        roam.Walker(room, [1, 0, 1], mode="swim")
    with pytest.raises(TypeError, match="space must be a roam.World"):
        roam.Walker(None, [1, 0, 1])
    walker = roam.Walker(room, [1, 0, 1])
    with pytest.raises(ValueError, match="velocity must be"):
        walker.step([1, 0])
    with pytest.raises(ValueError, match="not a finite vector"):
        walker.step([np.nan, 0, 0])
    with pytest.raises(ValueError, match="acceleration must be above 0"):
        walker.step([1, 0, 0], acceleration=-1)
    with pytest.raises(ValueError):
        walker.step([1, 0, 0], dt=-1)
    with pytest.raises(ValueError):
        walker.follow(np.empty((0, 3)))


def test_one_walker_in_many_threads(room):
    walker = roam.Walker(room, [1, 0, 1])

    def work():
        for _ in range(300):
            walker.step([1, 0.2, 0])
            assert len(walker.position) == 3

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert walker.position[0] == pytest.approx(4.7, abs=0.01)


def box(x, y, z):
    corners = [[a, b, c] for c in (0, z) for b in (0, y) for a in (0, x)]
    return corners, [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3],
                     [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]


def test_probe_and_train(tmp_path):
    leaf = [[4, 0, 0], [4, 2, 0], [4, 2, 3], [4, 0, 3]], [[0, 1, 2], [0, 2, 3]]
    other = [[4, 3, 0], [4, 5, 0], [4, 5, 3], [4, 3, 3]], [[0, 1, 2], [0, 2, 3]]
    survey = roam.Survey.from_meshes([("room", *box(9, 5, 3)), ("left", *leaf), ("right", *other)])
    probe = survey.probe([1, 2.5, 1], [8, 2.5, 1], height=1.8)
    assert probe.passable and probe.limit == "door" and probe.widest_radius == pytest.approx(0.5, abs=0.002)
    assert probe.path.shape[1] == 3 and probe.path[0, 2] == pytest.approx(0.9, abs=0.01)
    wide = survey.probe([1, 2.5, 1], [8, 2.5, 1], radius=0.6, height=1.8)
    assert not wide.passable and wide.limit == "door" and wide.limit_size == pytest.approx(1.0, abs=0.004)
    with pytest.raises(ValueError):
        survey.probe([1, 2.5, 1], [8, 2.5, np.nan])

    seen = []
    training = survey.train(height=1.8, paths=2, progress=seen.append)
    assert training.feasible and training.places > 0 and 0 <= max(seen, default=0) <= 1
    training.profile.save(tmp_path / "room.obj.roam.json")
    profile = roam.Profile.beside(tmp_path / "room.obj")
    assert profile.body["radius"] == training.radius
    world = roam.World.from_arrays(*box(9, 5, 3))
    assert roam.Walker(world, [1, 1, 1], profile=profile).radius == training.radius
