import ctypes

import numpy as np
import pytest

import heml


def test_each_world_has_the_bits_of_a_lone_one(box):
    batch = heml.Batch(box(), 5, threads=2)
    batch.worlds[3].apply({"gravity": [0, 0, -20]})
    batch.step(120)
    alone = heml.World(box(), threads=1)
    alone.step(120)
    other = heml.World(box(), threads=1)
    other.apply({"gravity": [0, 0, -20]})
    other.step(120)
    hashes = [world.hash() for world in batch.worlds]
    assert hashes[3] == other.hash()
    assert set(hashes[:3] + hashes[4:]) == {alone.hash()}
    assert (batch.positions()[0] == alone.positions()).all()


def test_missing_nodes_are_nan(box, sweep):
    batch = heml.Batch(box(), 3)
    batch.worlds[1].cut(sweep)
    batch.step(5)
    positions = batch.positions()
    nodes = len(batch.worlds[1].positions())
    assert positions.shape == (3, nodes, 3) and nodes > 45
    assert np.isnan(positions[0, 45:]).all() and not np.isnan(positions[1]).any()
    out = np.empty_like(positions)
    assert batch.positions(out=out) is out
    assert np.array_equal(out, positions, equal_nan=True)


def test_worlds_are_reset_by_themselves(box, sweep):
    batch = heml.Batch(box(events=[{"step": 5, "gravity": [9, 0, 0]}]), 3)
    batch.step(10)
    once = batch.worlds[0].hash()
    later = batch.worlds[0].snapshot()
    batch.worlds[2].cut(sweep)
    batch.step(10)
    twice = batch.worlds[0].hash()
    batch.reset([0, 2])
    assert batch.worlds[0].ticks == batch.worlds[2].ticks == 0 and batch.worlds[1].ticks == 20
    batch.step(10)
    assert batch.worlds[0].hash() == batch.worlds[2].hash() == once
    batch.reset(np.array([1]), snapshot=later)
    assert batch.worlds[1].hash() == once
    batch.step(10)
    assert batch.worlds[1].hash() == twice


def test_wrong_numbers_are_refused(box):
    with pytest.raises(heml.InputError, match="n"):
        heml.Batch(box(), 0)
    batch = heml.Batch(box(), 2)
    for wrong in ([2], [-1], ["a"], [True]):
        with pytest.raises(heml.InputError, match="indices"):
            batch.reset(wrong)


def test_a_halted_world_does_not_stop_the_others(box):
    batch = heml.Batch(box(), 2)
    batch.worlds[0].apply({"material": {"law": "neo_hookean", "young": 1e4, "poisson": 0.45, "density": 1000}})
    batch.worlds[0].apply({"gravity": [1e9, 0, 0]})
    batch.step(50)
    assert batch.worlds[0].halt and batch.worlds[1].halt is None
    assert batch.worlds[1].ticks == 50


class Mallinfo2(ctypes.Structure):
    _fields_ = [(f"field{k}", ctypes.c_size_t) for k in range(10)]

    def in_use(self):
        """Bytes: uordblks and hblkhd."""
        return self.field7 + self.field4


def test_worlds_share_what_no_step_changes():
    libc = ctypes.CDLL(None)
    if not hasattr(libc, "mallinfo2"):
        pytest.skip("the C library tells no memory")
    libc.mallinfo2.restype = Mallinfo2
    scene = heml.Scene(
        {
            "schema_version": 1,
            "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [8, 8, 8]}},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.4, "density": 1000}],
            "solver": {"integrator": "verlet", "rate": 1000},
        }
    )  # fmt: skip
    heml.Batch(scene, 1, threads=1)  # what is made once
    before = libc.mallinfo2().in_use()
    batch = heml.Batch(scene, 33, threads=1)
    batch.step(2)
    each = (libc.mallinfo2().in_use() - before) / 33
    nodes = batch.positions().shape[1]
    assert each < 9 * 3 * 8 * nodes  # x, v, f, and x, v before the step: 5; scratch, and its share of the rest
