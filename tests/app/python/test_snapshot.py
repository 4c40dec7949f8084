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
