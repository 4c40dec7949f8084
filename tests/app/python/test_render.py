import concurrent.futures
import os
import subprocess
import sys

import numpy as np
import pytest

import heml


def test_a_picture_shows_the_body(box):
    world = heml.World(box(), threads=1)
    picture = heml.render(world, size=(200, 120))
    assert picture.shape == (120, 200, 3) and picture.dtype == np.uint8
    assert picture.std() > 5
    assert (picture == heml.render(world, size=(200, 120))).all()
    assert (picture != heml.render(world, size=(200, 120), azimuth=70)).any()
    assert (picture != heml.render(world, size=(200, 120), field="stretch")).any()


def test_a_picture_does_not_depend_on_those_before(box):
    asked = [(box(), {}), (box(mesh={"box": {"size": [0.1, 0.1, 0.1], "cells": [2, 2, 2], "origin": [0, 0, 0]}}), {}),
             (box(), {"field": "stretch"}), (box(), {"size": (100, 120)})]
    worlds = [heml.World(scene, threads=1) for scene, _ in asked]
    for world in worlds:
        world.step(3)

    def draw(k):
        return heml.render(worlds[k], **{"size": (200, 120)} | asked[k][1])

    alone = [draw(k) for k in range(4)]
    worlds.append(heml.World(box(), threads=1))  # a closed world's memory may be another's
    worlds[0].close()
    worlds[0] = worlds.pop()
    worlds[0].step(3)
    for k in (3, 1, 0, 0, 2, 1, 2, 0, 3, 3):
        assert (draw(k) == alone[k]).all()
    with concurrent.futures.ThreadPoolExecutor(1) as another_thread:
        assert (another_thread.submit(draw, 1).result() == alone[1]).all()
    assert (draw(1) == alone[1]).all()


def test_a_process_forked_from_one_that_draws_is_told_to_be_spawned(box):
    heml.render(heml.World(box(), threads=1), size=(64, 64))
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            heml.render(heml.World(box(), threads=1), size=(64, 64))
            os.write(write, b"drawn")
        except RuntimeError as error:
            os.write(write, str(error).encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert b"spawn" in os.read(read, 1000)


def test_a_side_stands_for_two_angles(box):
    world = heml.World(box(view={"azimuth": 10, "elevation": 5}), threads=1)
    side = heml.render(world, size=(200, 120), side="top")
    assert (side == heml.render(world, size=(200, 120), azimuth=0, elevation=90)).all()
    assert (side != heml.render(world, size=(200, 120), side="top", orthographic=True)).any()
    with pytest.raises(heml.InputError, match="azimuth"):
        heml.render(world, side="top", azimuth=3)


def test_wrong_views_are_refused(box):
    world = heml.World(box(), threads=1)
    for arguments in ({"size": (1, 1)}, {"size": 5}, {"azimut": 3}, {"side": "above"}, {"field": "no such"}):
        with pytest.raises(heml.InputError):
            heml.render(world, **arguments)


def test_drawing_is_loaded_when_a_picture_is_asked_for():
    program = "import heml; print('OSMesa' in open('/proc/self/maps').read())"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout.strip() == "False"
