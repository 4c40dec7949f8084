import pickle

import numpy as np
import pytest

import heml


def test_an_installed_scene_is_found_by_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert heml.Scene("cantilever").name == "cantilever"
    with pytest.raises(heml.InputError, match="no_such_scene"):
        heml.Scene("no_such_scene")


def test_a_dict_goes_through_a_scene_and_back(box):
    scene = heml.Scene(box(name="box", gravity=np.array([0, 0, -1.5])))
    assert scene.name == "box"
    again = scene.to_dict()
    assert again["gravity"] == [0, 0, -1.5]
    assert heml.Scene(again).to_dict() == again


def test_save_writes_a_scene_file(box, tmp_path):
    scene = heml.Scene(box(events=[{"step": 3, "grasp": {"point": [0.1, 0.04, 0.04], "radius": 0.02}}]))
    scene.save(tmp_path / "soft.json")
    read = heml.Scene(tmp_path / "soft.json")
    assert read.to_dict() == scene.to_dict()
    assert read.to_dict()["events"][0]["grasp"]["point"] == [0.1, 0.04, 0.04]
    assert heml.World(read, threads=1).hash() == heml.World(scene, threads=1).hash()


def test_a_pickled_scene_makes_the_same_world(box):
    scene = heml.Scene(box(events=[{"step": 3, "grasp": {"point": [0.1, 0.04, 0.04]}}, {"step": 4, "move": [0.2, 0, 0]}]))
    worlds = [heml.World(each, threads=1) for each in (scene, pickle.loads(pickle.dumps(scene)))]
    for world in worlds:
        world.step(20)
    assert worlds[0].hash() == worlds[1].hash()


@pytest.mark.parametrize("changes, words", [
    ({"gravty": [0, 0, 0]}, "gravity"),
    ({"gravity": [0, float("nan"), 0]}, "gravity[1]"),
    ({"materials": [{"law": "neo_hookean", "young": -1, "poisson": 0.3}]}, "materials[0]"),
    ({"mesh": {"file": "no such.msh"}}, "no such.msh"),
    ({"loads": [{"box": [[0, 0, 0], [1, 1, 1]], "force": object()}]}, "loads[0].force"),
])
def test_what_is_wrong_is_named(box, changes, words):
    with pytest.raises(heml.InputError) as error:
        heml.World(box(**changes))
    assert words in str(error.value)
    assert isinstance(error.value, ValueError)
