import multiprocessing
import os

import numpy as np
import pytest

import heml


@pytest.mark.parametrize("out, words", [
    (np.empty((44, 3)), "shape (44, 3)"),
    (np.empty((45, 3), np.float32), "type 'f'"),
    (np.empty((3, 45)).T, "contiguous"),
    (np.empty((45, 6))[:, ::2], "contiguous"),
    ([[0, 0, 0]] * 45, "array"),
    ("text", "array"),
])
def test_a_wrong_out_is_refused(box, out, words):
    with pytest.raises(heml.InputError) as error:
        heml.World(box(), threads=1).positions(out=out)
    assert words in str(error.value) and "(45, 3)" in str(error.value)


def test_a_read_only_out_is_refused(box):
    out = np.empty((45, 3))
    out.flags.writeable = False
    with pytest.raises(heml.InputError, match="read-only"):
        heml.World(box(), threads=1).velocities(out=out)


@pytest.mark.parametrize("call, words", [
    (lambda w: w.step(-1), "ticks"),
    (lambda w: w.apply({"no_such": 1}), "no_such"),
    (lambda w: w.apply({}), "event"),
    (lambda w: w.apply({"checkpoint": "0" * 16}), "action"),
    (lambda w: w.apply({"grasp": {"node": 10**6}}), "grasp"),
    (lambda w: w.grasp(), "point"),
    (lambda w: w.grasp(node=1, point=[0, 0, 0]), "point"),
    (lambda w: w.move([0, 0]), "move"),
    (lambda w: w.move([0, 0, float("nan")]), "move[2]"),
    (lambda w: w.undo(), "undo"),
    (lambda w: w.record("/no/such/folder/r.jsonl"), "/no/such/folder"),
    (lambda w: heml.World(w.positions()), ""),
])
def test_wrong_calls_say_what_is_wrong_and_change_nothing(box, call, words):
    world = heml.World(box(), threads=1)
    world.step(3)
    before = world.hash()
    with pytest.raises((heml.InputError, TypeError)) as error:
        call(world)
    assert words in str(error.value)
    assert world.hash() == before
    world.step(1)


def test_a_closed_world_is_refused(box):
    world = heml.World(box(), threads=1)
    world.close()
    with pytest.raises(RuntimeError, match="closed"):
        world.step()


def test_the_exceptions_are_what_they_are_said_to_be():
    assert issubclass(heml.InputError, ValueError)
    assert issubclass(heml.NotConverged, RuntimeError) and issubclass(heml.Unstable, RuntimeError)
    assert heml.InputError.__module__ == "heml"


def test_a_forked_process_is_told_to_make_its_own_world(box):
    world = heml.World(box(), threads=2)
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            world.step()
            os.write(write, b"stepped")
        except RuntimeError as error:
            os.write(write, str(error).encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert b"fork" in os.read(read, 1000)
    world.step()


def stepped(scene):
    world = heml.World(scene, threads=1)
    world.step(20)
    return world.hash()


def test_spawned_processes_compute_the_same(box):
    scene = heml.Scene(box())
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(stepped, (scene,)) == stepped(scene)
