"""Meshes and fields of a world as objects of meshio and pyvista (extra `notebook`)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

import heml
from heml._optional import require

if TYPE_CHECKING:
    import meshio
    import pyvista

fields = ("velocity", "J", "von_mises")
"""Names of the fields: velocity (V, 3) m/s by node; J (T,) and von_mises (T,) Pa by element."""


def world_of(thing: Union[heml.World, heml.Scene]) -> heml.World:
    """The world itself, or a new one of a scene."""
    return heml.World(thing) if isinstance(thing, heml.Scene) else thing


def to_meshio(thing: Union[heml.World, heml.Scene], fields: Sequence[str] = fields) -> meshio.Mesh:
    """The body as it is now, in file order.

    Args:
        thing: a World, or a Scene (its body at time 0).
        fields: those to add; see `heml.interchange.fields`.

    Returns:
        meshio.Mesh: points (V, 3) m, cells "tetra" (T, 4), point_data and cell_data by name.
    """
    library = require("meshio", "notebook")
    world = world_of(thing)
    by_node, by_element = _values(world, fields)
    return library.Mesh(
        np.asarray(world.positions()),
        [("tetra", np.asarray(world.tets))],
        point_data=by_node,
        cell_data={name: [value] for name, value in by_element.items()},
    )


def to_pyvista(thing: Union[heml.World, heml.Scene], fields: Sequence[str] = fields) -> pyvista.UnstructuredGrid:
    """As `to_meshio`, as a pyvista.UnstructuredGrid: `.plot(scalars="von_mises")` draws it."""
    library = require("pyvista", "notebook")
    world = world_of(thing)
    tets = np.asarray(world.tets)
    cells = np.hstack([np.full((len(tets), 1), 4), tets]).ravel()
    kinds = np.full(len(tets), library.CellType.TETRA, dtype=np.uint8)
    grid = library.UnstructuredGrid(cells, kinds, np.asarray(world.positions()))
    by_node, by_element = _values(world, fields)
    grid.point_data.update(by_node)
    grid.cell_data.update(by_element)
    return grid


def _values(world: heml.World, names: Sequence[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Fields by node and by element."""
    by_node: dict[str, Any] = {}
    by_element: dict[str, Any] = {}
    for name in names:
        if name == "velocity":
            by_node[name] = np.asarray(world.velocities())
        elif name == "J":
            by_element[name] = np.asarray(world.volume_ratios())
        elif name == "von_mises":
            by_element[name] = von_mises(np.asarray(world.stresses()))
        else:
            raise heml.InputError(f"field {name!r}: the fields are {', '.join(fields)}")
    return by_node, by_element


def von_mises(stresses: np.ndarray) -> np.ndarray:
    """Von Mises stress (T,) of Cauchy stresses (T, 3, 3), in their unit."""
    mean = np.trace(stresses, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.sum((stresses - mean) ** 2, axis=(1, 2)))
