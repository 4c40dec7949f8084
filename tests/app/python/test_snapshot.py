import pickle
import subprocess
import sys

import pytest

import heml


def driven(box, sweep):
    world = heml.World(box(events=[{"step": 12, "gravity": [0, 0, -9.81]}]), threads=1)
    world.step(10)
    world.cut(sweep)
    world.grasp(point=[0.1, 0.04, 0.04], radius=0.02)
    world.move([0.12, 0.05, 0.04])
    world.step(15)
    world.apply({"gravity": [0, 1, 0]})
    return world


def test_a_pickled_snapshot_leads_to_the_same_bits_in_another_process(box, sweep, tmp_path):
    world = driven(box, sweep)
    snapshot = world.snapshot()
    (tmp_path / "state").write_bytes(pickle.dumps((heml.Scene(box(events=[{"step": 12, "gravity": [0, 0, -9.81]}])), snapshot)))
    world.step(30)
    program = f"""
import pickle, heml
scene, snapshot = pickle.load(open({str(tmp_path / "state")!r}, "rb"))
world = heml.World(scene, threads=1)
world.restore(snapshot)
assert world.ticks == 25
world.step(30)
print(world.hash())
"""
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout.strip() == world.hash()


def test_a_snapshot_of_another_build_is_refused(box):
    world = heml.World(box(), threads=1)
    world.step(3)
    state = world.snapshot().__getstate__()
    other = heml.Snapshot.__new__(heml.Snapshot)
    other.__setstate__(("another compiler",) + state[1:])
    assert other.build == "another compiler"
    with pytest.raises(heml.InputError, match="another compiler"):
        world.restore(other)
    assert world.ticks == 3


def test_a_snapshot_of_another_body_is_refused(box):
    small = heml.World(box(mesh={"box": {"size": [0.1, 0.04, 0.04], "cells": [1, 1, 1]}}), threads=1)
    with pytest.raises(heml.InputError, match="another body"):
        small.restore(heml.World(box(), threads=1).snapshot())


@pytest.mark.parametrize("key, value", [
    ("gravity", [0, -1, 0]),
    ("materials", [{"law": "neo_hookean", "young": 2e4, "poisson": 0.45}]),
    ("boundary", [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True, "axes": "xy"}]),
    ("loads", [{"nodes": [9], "force": [0, 1e-3, 0]}]),
    ("solver", {"damping": 2}),
    ("tables", [{"point": [0, -0.01, 0], "normal": [0, 1, 0]}]),
])
def test_a_snapshot_of_another_scene_on_the_same_mesh_is_refused_and_changes_nothing(box, key, value):
    world = heml.World(box(), threads=1)
    world.step(3)
    before = world.hash()
    other = heml.World(box(**{key: value}), threads=1)
    other.step(5)
    for snapshot in (other.snapshot(), pickle.loads(pickle.dumps(other.snapshot()))):
        with pytest.raises(heml.InputError, match=f"another scene, which has other '{key}'"):
            world.restore(snapshot)
    assert (world.ticks, world.hash()) == (3, before)
    again = heml.World(box(), threads=1)
    again.restore(pickle.loads(pickle.dumps(world.snapshot())))
    assert again.hash() == before


def test_a_snapshot_fits_the_same_scene_whatever_its_events_outputs_and_threads_are(box, sweep):
    taken = driven(box, sweep)
    taken.apply({"material": {"law": "neo_hookean", "young": 2e4, "poisson": 0.3}})
    taken.step(5)
    scene = heml.Scene(box(name="again", view={"field": "J"}, outputs={"times": [0.5]}, solver={"threads": 2}))
    for given in (scene, heml.Scene(scene.to_dict()), pickle.loads(pickle.dumps(scene))):
        world = heml.World(given)
        world.restore(taken.snapshot())
        assert world.hash() == taken.hash()
        away = heml.World(box(), threads=1)
        away.restore(pickle.loads(pickle.dumps(world.snapshot())))
        assert away.hash() == taken.hash()
