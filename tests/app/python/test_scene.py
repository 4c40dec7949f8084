import os
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


def test_save_spares_the_mesh_that_the_scene_is_made_of(box, tmp_path):
    heml.Scene(box()).save(tmp_path / "box.json")
    mesh = tmp_path / "one.mesh"
    mesh.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n.1 0 0 0\n0 .1 0 0\n0 0 .1 0\n"
                    "Tetrahedra\n1\n1 2 3 4 0\nEnd\n")
    before = mesh.read_bytes()
    with pytest.raises(heml.InputError, match="would be overwritten"):
        heml.Scene(mesh).save(mesh)
    assert mesh.read_bytes() == before
    heml.Scene(tmp_path / "box.json").save(tmp_path / "box.json")  # a scene over itself


def test_paths_are_any_bytes_but_null(box, tmp_path):
    name = os.fsencode(tmp_path) + b"/lat\xe9.json"
    heml.Scene(box(name="odd")).save(name)
    for path in (name, os.fsdecode(name)):
        scene = heml.Scene(path)
        assert scene.file == os.fsdecode(name)
        assert pickle.loads(pickle.dumps(scene)).file == scene.file
        assert heml.World(path, threads=1).tick > 0
    with pytest.raises(heml.InputError, match="missing"):
        heml.Scene(os.fsencode(tmp_path) + b"/missing\xe9.json")
    with pytest.raises(heml.InputError, match="null character"):
        heml.Scene("a\0b.json")


def test_a_state_of_something_else_is_refused():
    for kind in (heml.Scene, heml.Snapshot):
        with pytest.raises(ValueError, match="no state of a heml"):
            kind.__new__(kind).__setstate__(("x", 3, 4))
