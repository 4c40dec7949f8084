"""Pictures, meshio and pyvista."""

import struct
import sys
import zlib

import numpy as np
import pytest

import heml
from heml.interchange import von_mises
from heml.show import Picture, png

scene = {
    "schema_version": 1,
    "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [5, 1, 1]}},
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.4, "density": 1000}],
    "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
    "gravity": [0, -9.81, 0],
}


@pytest.fixture
def world():
    made = heml.World(heml.Scene(scene))
    made.step(50)
    return made


def pixels_of(data):
    """Decodes a PNG of 8-bit RGB without filters."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, chunks = 8, {}
    while place < len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        kind, body = data[place + 4 : place + 8], data[place + 8 : place + 8 + length]
        assert struct.unpack(">I", data[place + 8 + length : place + 12 + length])[0] == zlib.crc32(kind + body)
        chunks[kind], place = body, place + 12 + length
    width, height, depth, colour = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    assert (depth, colour) == (8, 2)
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, 1 + 3 * width)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 3)


def test_png_keeps_pixels(tmp_path):
    given = np.random.default_rng(0).integers(0, 256, (7, 5, 3), dtype=np.uint8)
    assert np.array_equal(pixels_of(png(given)), given)
    Picture(given).save(str(tmp_path / "a.png"))
    assert (tmp_path / "a.png").read_bytes() == Picture(given)._repr_png_()


def test_show_draws_the_world(world):
    picture = world.show(size=(160, 120))
    assert pixels_of(picture._repr_png_()).shape == (120, 160, 3)
    assert len(np.unique(picture.pixels.reshape(-1, 3), axis=0)) > 10
    assert heml.Scene(scene).show(size=(64, 48)).pixels.shape == (48, 64, 3)


def test_meshio_round_trip(world, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = world.to_meshio()
    assert np.array_equal(mesh.points, world.positions())
    assert np.array_equal(mesh.cells_dict["tetra"], world.tets)
    assert np.array_equal(mesh.cell_data["J"][0], world.volume_ratios())
    mesh.write(tmp_path / "beam.vtu")
    again = meshio.read(tmp_path / "beam.vtu")
    assert np.array_equal(again.points, mesh.points)
    assert np.array_equal(again.point_data["velocity"], world.velocities())
    assert np.abs(heml.Scene(scene).to_meshio().point_data["velocity"]).max() == 0


def test_a_written_mesh_is_read_by_scenes(world, tmp_path):
    pytest.importorskip("meshio")
    mesh = heml.Scene(scene).to_meshio(fields=[])
    regions = (mesh.points[mesh.cells_dict["tetra"]].mean(axis=1)[:, 0] > 0.05) + 1
    mesh.cell_data["medit:ref"] = [regions]
    mesh.write(tmp_path / "halves.mesh")
    other = scene | {"mesh": {"file": str(tmp_path / "halves.mesh")}}
    assert np.array_equal(heml.World(other).regions(), regions)


def test_pyvista(world):
    pytest.importorskip("pyvista")
    grid = world.to_pyvista()
    assert grid.n_cells == len(world.tets)
    assert np.array_equal(grid.points, world.positions())
    assert grid.volume == pytest.approx(4e-5, rel=0.01)
    assert np.array_equal(grid.cell_data["von_mises"], von_mises(world.stresses()))


def test_von_mises():
    uniaxial = np.diag([3.0, 0, 0])[None]
    assert von_mises(uniaxial + 7 * np.eye(3)) == pytest.approx([3.0])
    shear = np.array([[[0, 2.0, 0], [2.0, 0, 0], [0, 0, 0]]])
    assert von_mises(shear) == pytest.approx([2 * np.sqrt(3)])


def test_unknown_field(world):
    pytest.importorskip("meshio")
    with pytest.raises(heml.InputError, match="velocity, J"):
        world.to_meshio(fields=["heat"])


@pytest.mark.parametrize("name", ["meshio", "pyvista"])
def test_missing_packages_name_the_extra(world, name, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=r"pip install 'heml\[notebook\]'"):
        getattr(world, f"to_{name}")()
