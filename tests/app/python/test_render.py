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
