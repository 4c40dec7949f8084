import json
import signal
import threading
import time

import numpy as np
import pytest

import heml


def test_arrays_have_their_shapes_and_are_copies(box):
    world = heml.World(box(), threads=1)
    nodes = world.positions()
    assert nodes.shape == (45, 3) and nodes.dtype == np.float64
    assert world.tets.shape == (80, 4) and world.tets.dtype == np.int32
    assert world.surface.shape[1] == 3 and world.surface.dtype == np.int32
    corners = nodes[world.tets]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert volume == pytest.approx(0.1 * 0.04 * 0.04)
    triangles = nodes[world.surface]
    outward = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    assert (triangles.mean(1) * outward).sum() / 6 == pytest.approx(volume)
    world.step(10)
    assert nodes[:, 1].min() == 0 and world.positions()[:, 1].min() < 0
    out = np.empty((45, 3))
    assert world.positions(out=out) is out
    assert (out == world.positions()).all()
    assert world.velocities().shape == world.forces().shape == (45, 3)
    assert world.volume_ratios().shape == (80,) and world.stresses().shape == (80, 3, 3)


def test_forces_are_those_the_motion_asks_for(box):
    """Of free nodes with verlet: m a, by the change of velocity over two short steps."""
    world = heml.World(box(solver={"step": 1e-5}), threads=1)
    world.step(100)
    before, force = world.velocities(), world.forces()
    world.step(1)
    after = world.velocities()
    mass = np.zeros(45)
    corners = heml.World(box(), threads=1).positions()[world.tets]
    for tet, volume in zip(world.tets, np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6):
        mass[tet] += 1000 * volume / 4
    free = heml.World(box(), threads=1).positions()[:, 0] > 1e-6
    momentum = mass[:, None] * (after - before) / 1e-5
    assert momentum[free] == pytest.approx((force + world.forces())[free] / 2, rel=1e-9, abs=1e-9)


def test_energies_and_stresses_agree_with_the_report(box):
    world = heml.World(box(), threads=1)
    world.step(50)
    report, energies = world.report(), world.energies()
    assert report["kinetic_energy"] == energies["kinetic"]
    assert report["elastic_energy"] == energies["elastic"]
    assert report["potential_energy"] == energies["potential"]
    assert report["state_hash"] == world.hash()
    assert report["min_J"] == world.volume_ratios().min()
    assert np.allclose(world.stresses(), world.stresses().transpose(0, 2, 1), atol=1e-9)


def test_the_scene_and_apply_give_the_same_bits(box):
    events = [{"step": 2, "grasp": {"point": [0.1, 0.04, 0.04], "radius": 0.03}}, {"step": 5, "move": [0.15, 0.05, 0]},
              {"step": 20, "release": True}, {"step": 25, "gravity": [0, 0, 0]}]
    played = heml.World(box(events=events), threads=1)
    played.step(40)
    driven = heml.World(box(), threads=1)
    driven.step(2)
    driven.grasp(point=[0.1, 0.04, 0.04], radius=0.03)
    driven.step(3)
    driven.move(np.array([0.15, 0.05, 0]))
    driven.step(15)
    driven.release()
    driven.step(5)
    driven.apply({"gravity": [0, 0, 0], "at": 99})
    driven.step(15)
    assert driven.hash() == played.hash()
    assert driven.ticks == 40 and driven.time == pytest.approx(0.04)


def test_two_hands_hold_at_once_with_the_bits_of_a_scene(box):
    events = [{"step": 2, "grasp": {"node": 4, "radius": 0.02}},
              {"step": 2, "grasp": {"node": 9, "radius": 0.02, "hand": 1}},
              {"step": 5, "move": {"to": [0.1, 0.1, 0.05], "hand": 1}}, {"step": 20, "release": {"hand": 1}}]
    played = heml.World(box(events=events), threads=1)
    played.step(40)
    driven = heml.World(box(), threads=1)
    driven.step(2)
    driven.grasp(node=4, radius=0.02)
    driven.grasp(node=9, radius=0.02, hand=1)
    driven.step(3)
    driven.move([0.1, 0.1, 0.05], hand=1)
    driven.step(15)
    driven.release(hand=1)
    driven.step(20)
    assert driven.hash() == played.hash()
    driven.move([0.1, 0, 0])  # hand 0 still holds
    with pytest.raises(heml.InputError, match="hand 1 holds nothing"):
        driven.move([0.1, 0, 0], hand=1)
    with pytest.raises(heml.InputError, match="hand"):
        driven.grasp(node=4, hand=16)


def test_a_cut_raises_the_topology_version_and_undo_takes_it_back(box, sweep):
    world = heml.World(box(), threads=1)
    before = world.topology_version
    world.cut(sweep)
    assert world.topology_version > before
    assert len(world.tets) > 80 and len(world.positions()) > 45
    world.step(5)
    world.undo()
    assert len(world.tets) == 80


def test_a_burn_shrinks_the_tissue_as_its_event_does_and_undo_takes_it_back(box):
    world, played, never = (heml.World(box(), threads=1) for _ in range(3))
    line = [[0.04, 0.02, 0.01], [0.06, 0.02, 0.01]]
    world.cauterize(line, radius=0.02, shrink=0.3)
    played.apply({"cauterize": {"line": line, "radius": 0.02, "shrink": 0.3}})
    world.step(20)
    played.step(20)
    never.step(20)
    assert world.hash() == played.hash() != never.hash()
    assert len(world.tets) == 80
    world.undo()
    world.cauterize({"sweep": [[p, p] for p in line], "radius": 0.02})
    with pytest.raises(heml.InputError, match="radius"):
        world.cauterize(line, radius=-1)
    with pytest.raises(heml.InputError, match="shrink"):
        world.cauterize(line, shrink=1)


def test_snapshot_cut_thousand_steps_restore_and_again_is_the_same(box, sweep):
    world = heml.World(box(), threads=1)
    world.step(10)
    snapshot = world.snapshot()
    hashes = []
    for _ in range(2):
        version = world.topology_version
        world.restore(snapshot)
        assert world.topology_version > version
        world.cut(sweep)
        world.step(1000)
        hashes.append(world.hash())
    assert hashes[0] == hashes[1]


def test_a_restored_world_plays_the_events_of_its_scene_again(box):
    world = heml.World(box(events=[{"step": 15, "gravity": [0, 9.81, 0]}]), threads=1)
    world.step(10)
    snapshot = world.snapshot()
    world.step(30)
    once = world.hash()
    world.restore(snapshot)
    world.step(30)
    assert world.hash() == once


def test_what_is_recorded_verifies(box, sweep, program, tmp_path):
    world = heml.World(box(), threads=1)
    world.step(7)
    world.grasp(node=4, radius=0.02)
    world.step(3)
    world.cut(sweep)
    world.record(tmp_path / "late.jsonl")
    world.move([0.1, 0.1, 0.05])
    for _ in range(5):
        world.step(4)
    # The world is still open: the file must be complete all the same.
    replay = program("replay", tmp_path / "late.jsonl", "--verify")
    assert replay.returncode == 0, replay.stderr
    assert world.hash() in replay.stdout
    world.step(600)
    world.close()
    replay = program("replay", tmp_path / "late.jsonl", "--verify")
    assert replay.returncode == 0, replay.stderr
    again = heml.World(tmp_path / "late.jsonl", threads=1)
    again.step(630)
    assert again.hash() in replay.stdout


def test_recording_from_the_start_verifies(box, program, tmp_path):
    with heml.World(box(), threads=1) as world:
        world.record(tmp_path / "all.jsonl")
        world.step(20)
        world.apply({"material": {"law": "stvk", "young": 2e4, "poisson": 0.3}})
        world.step(20)
    replay = program("replay", tmp_path / "all.jsonl", "--verify")
    assert replay.returncode == 0, replay.stderr


def test_a_recording_ends_with_an_error_where_the_world_is_restored(box, program, tmp_path):
    world = heml.World(box(), threads=1)
    snapshot = world.snapshot()
    world.record(tmp_path / "r.jsonl")
    world.step(10)
    with pytest.raises(heml.InputError, match="recording"):
        world.restore(snapshot)
    assert program("replay", tmp_path / "r.jsonl", "--verify").returncode == 0
    with pytest.raises(heml.InputError, match="restored"):
        world.record(tmp_path / "r2.jsonl")


def test_the_command_line_gives_the_same_hash(box, program, tmp_path):
    scene = box(solver={"duration": 0.05})
    (tmp_path / "s.json").write_text(json.dumps(scene))
    assert program("solve", tmp_path / "s.json", "--out", tmp_path / "out").returncode == 0
    report = json.loads((tmp_path / "out/report.json").read_text())
    world = heml.World(tmp_path / "s.json")
    world.step(50)
    assert world.hash() == report["state_hash"]


def test_a_halted_world_says_so_and_then_raises(box):
    world = heml.World(box(solver={"step": 0.02}), threads=1)
    world.step(1000)
    assert world.halt and world.ticks < 1000
    with pytest.raises(heml.Unstable) as error:
        world.step()
    assert str(error.value) == world.halt
    world.positions()
    world.apply({"reset": True})
    assert world.halt is None


def test_a_second_thread_is_refused(box):
    world = heml.World(box(mesh={"box": {"size": [0.1, 0.04, 0.04], "cells": [12, 8, 8]}}), threads=1)
    refused = []

    def ask():
        while thread.is_alive():
            try:
                world.hash()
            except RuntimeError as error:
                refused.append(str(error))
                return

    thread = threading.Thread(target=lambda: world.step(200))
    thread.start()
    ask()
    thread.join()
    assert refused and "another thread" in refused[0]
    assert world.ticks == 200


def refusals(asked):
    """What functions raise in a thread of their own."""
    messages = []

    def ask():
        for function in asked:
            try:
                function()
                messages.append("nothing")
            except RuntimeError as error:
                messages.append(str(error))

    thread = threading.Thread(target=ask)
    thread.start()
    thread.join()
    return messages


def test_every_use_is_refused_while_another_thread_is_within_a_call(box, tmp_path):
    """The world is held while it asks for the path, and the batch while it asks for the numbers."""
    world, batch = heml.World(box(), threads=1), heml.Batch(box(), 2, threads=1)
    messages = []

    class Path:
        def __fspath__(self):
            messages.extend(refusals([world.step, world.hash, world.snapshot, world.close, lambda: heml.render(world)]))
            return str(tmp_path / "r.jsonl")

    class Numbers:
        def tolist(self):
            messages.extend(refusals([batch.step, batch.positions, batch.worlds[0].step, batch.worlds[1].close]))
            return [0]

    world.record(Path())
    batch.reset(Numbers())
    assert len(messages) == 9 and all("in use by another thread" in message for message in messages), messages
    world.step(3)
    batch.step(3)
    assert world.hash() == batch.worlds[0].hash()


@pytest.fixture
def interruptible():
    """SIGINT raises KeyboardInterrupt, also where the tests run in the background of a shell, which ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_stops_between_ticks(box, interruptible):
    import _thread

    world = heml.World(box(), threads=1)
    threading.Timer(0.3, _thread.interrupt_main).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        world.step(10**9)
    assert time.monotonic() - begin < 30
    ticks = world.ticks
    assert ticks > 0
    world.step(3)
    assert world.ticks == ticks + 3
    alone = heml.World(box(), threads=1)
    if ticks < 200_000:
        alone.step(ticks + 3)
        assert alone.hash() == world.hash()


def test_ten_thousand_worlds_leave_no_memory_behind(box):
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    scene = heml.Scene(box(mesh={"box": {"size": [0.1, 0.04, 0.04], "cells": [1, 1, 1]}}))
    for _ in range(1000):
        heml.World(scene, threads=1).step()
    before = resident()
    for _ in range(9000):
        heml.World(scene, threads=1).step()
    assert resident() - before < 1 << 20  # 116 bytes a world
