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
    (np.empty((45, 3), ">f8"), "type '>d'"),
    (np.empty((45, 3), np.int64), "type 'l'"),
    (np.empty((45, 3), object), "type 'O'"),
    (np.empty((45, 3, 1)), "shape (45, 3, 1)"),
    (np.empty(135), "shape (135,)"),
    (np.empty((45, 3))[::-1], "contiguous"),
    (bytes(1080), "type 'B'"),
    ([[0, 0, 0]] * 45, "array"),
    ("text", "array"),
])
def test_a_wrong_out_is_refused(box, out, words):
    world = heml.World(box(), threads=1)
    for name in ("positions", "velocities", "forces", "rest_positions"):
        with pytest.raises(heml.InputError) as error:
            getattr(world, name)(out=out)
        assert words in str(error.value) and "(45, 3)" in str(error.value)


def test_a_wrong_out_of_a_batch_is_refused(box):
    batch = heml.Batch(box(), 2, threads=1)
    for out in (np.empty((45, 3)), np.empty((3, 45, 3)), np.empty((2, 45, 3), np.float32), np.empty((4, 45, 3))[::2]):
        with pytest.raises(heml.InputError, match=r"^out: .*\(2, 45, 3\)"):
            batch.positions(out=out)


def test_a_read_only_out_is_refused_and_keeps_its_values(box):
    out = np.full((45, 3), 7.0)
    out.flags.writeable = False
    with pytest.raises(heml.InputError, match="read-only"):
        heml.World(box(), threads=1).velocities(out=out)
    assert (out == 7).all()


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
    (lambda w: w.move(np.full(3, np.nan)), "move[0]"),
    (lambda w: w.apply({"gravity": np.array([0, np.nan, 0], np.float32)}), "gravity[1]"),
    (lambda w: w.apply({"gravity": [0, 0, float("inf")]}), "gravity[2]"),
    (lambda w: w.apply({"gravity": np.ones((3, 3))}), "gravity"),
    (lambda w: w.grasp(point=[np.nan, 0, 0]), "grasp.point[0]"),
    (lambda w: w.grasp(node=1, radius=np.nan), "grasp.radius"),
    (lambda w: w.cut(np.full((2, 2, 3), np.nan)), "cut.sweep[0][0][0]"),
    (lambda w: w.apply({"material": {"law": "neo_hookean", "young": np.nan, "poisson": 0.4}}), "material.young"),
    (lambda w: w.apply({"remove": {"sphere": [[np.nan, 0, 0], 1]}}), "remove.sphere[0][0]"),
    (lambda w: w.step(np.nan), "step"),
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


def test_every_use_of_a_closed_world_is_refused(box, sweep, tmp_path):
    world = heml.World(box(), threads=1)
    snapshot = world.snapshot()
    world.close()
    arguments = {"apply": [{"gravity": [0, 0, 0]}], "move": [[0, 0, 0]], "cut": [sweep], "cauterize": [[[0, 0, 0]]],
                 "restore": [snapshot], "record": [tmp_path / "r.jsonl"]}
    # to_pyvista asks for its package first; it and the like go through those below.
    for name in set(dir(heml.World)) - {"close", "show", "to_meshio", "to_pyvista"}:
        if name.startswith("_"):
            continue
        with pytest.raises(RuntimeError, match="this world is closed"):
            value = getattr(world, name)
            value(*arguments.get(name, []))
    with pytest.raises(RuntimeError, match="closed"):
        heml.render(world)
    world.close()
    other = heml.World(box(), threads=1)
    other.restore(snapshot)
    assert other.ticks == 0


def test_a_block_may_close_its_world(box):
    with heml.World(box(), threads=1) as world:
        world.close()
    with pytest.raises(ZeroDivisionError), heml.World(box(), threads=1) as world:
        1 / 0
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
