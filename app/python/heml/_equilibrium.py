"""The static equilibrium of a scene on linear tetrahedra, with derivatives.

Residual on a node a, N:  R_a = sum over its elements V P(F) grad N_a - f_a,  F = sum_a x_a (x) grad N_a.
P and its derivative are those of the engine (`heml.probe`), so the tangent is exact. At an equilibrium R(p, x) = 0 the
free nodes move with a parameter p by

    K dx/dp = -dR/dp,   K = dR/dx at the free nodes (symmetric, factored once).
"""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

import heml
from heml._optional import require
from heml._scene_paths import set_number

Array = NDArray[np.float64]

_beside_law = ("region", "active_stress", "viscosity", "bulk_viscosity", "relaxation", "plasticity")
_without_loads = ("boundary", "loads", "events", "initial", "tables", "self_contact", "tearing", "outputs", "checkpoints")


def bare_scene(scene: dict[str, Any]) -> dict[str, Any]:
    """The scene's mesh and materials alone."""
    bare = {key: value for key, value in scene.items() if key not in _without_loads}
    return bare | {"gravity": [0, 0, 0], "solver": {"integrator": "verlet"}}


def rest_world(scene: dict[str, Any]) -> heml.World:
    """A world of the scene's mesh and materials alone, at rest."""
    return heml.World(heml.Scene(bare_scene(scene)), threads=1)


def select(entry: dict[str, Any], rest: Array) -> NDArray[np.intp]:
    """The nodes of a `nodes`, `box` or `sphere` selection at rest."""
    if "nodes" in entry:
        return np.asarray(entry["nodes"], dtype=np.intp)
    if "box" in entry:
        lower, upper = np.asarray(entry["box"], dtype=float)
        return np.flatnonzero(np.all((rest >= lower) & (rest <= upper), axis=1))
    centre, radius = entry["sphere"]
    return np.flatnonzero(np.sum((rest - np.asarray(centre, dtype=float)) ** 2, axis=1) <= radius**2)


def with_selected_nodes(scene: dict[str, Any], rest: Array) -> dict[str, Any]:
    """A copy whose supports and loads name their nodes, so that a change of shape does not change the selection."""
    frozen = copy.deepcopy(scene)
    for entry in [*frozen.get("boundary", []), *frozen.get("loads", [])]:
        nodes = select(entry, rest)
        for key in ("box", "sphere"):
            entry.pop(key, None)
        entry["nodes"] = [int(node) for node in nodes]
    return frozen


def unsupported(scene: dict[str, Any]) -> str | None:
    """Why the residual of this scene is not the one below; None if it is."""
    if scene.get("solver", {}).get("element", "p1") != "p1":
        return "solver.element is not p1"
    for key in ("tables", "self_contact"):
        if scene.get(key):
            return f"the scene has {key}"
    if any("pressure" in load for load in scene.get("loads", [])):
        return "a load is a pressure"
    for material in scene["materials"]:
        if material.get("law") == "mass_spring":
            return "the law mass_spring has no stress"
        if material.get("active_stress"):
            return "a material has active stress"
        if any(isinstance(value, dict) and "field" in value for value in material.values()):
            return "a material has parameters by element"
    return None


class Equilibrium:
    """Residual and tangent of `scene`, a dict whose selections are node lists (see `with_selected_nodes`).

    `paths` are the parameters; those of the mesh are followed by building the mesh again.
    """

    def __init__(self, scene: dict[str, Any], paths: list[str]) -> None:
        self.scene = scene
        self.paths = paths
        world = rest_world(scene)
        self.tets = np.asarray(world.tets, dtype=np.intp)
        self.surface = np.asarray(world.surface, dtype=np.intp)
        self.rest = np.asarray(world.positions())
        self.entry_of_tet = _entries(scene, world.regions())
        constrained = np.zeros(len(self.rest), dtype=bool)
        for support in scene.get("boundary", []):
            constrained[support["nodes"]] = True
        self.free = ~constrained
        self.free_dofs = np.flatnonzero(np.repeat(self.free, 3))
        self.mesh_moves = any(path.startswith("mesh.") for path in paths)

    def scene_at(self, values: Array) -> dict[str, Any]:
        """The scene with these values (p,) of the parameters."""
        scene = copy.deepcopy(self.scene)
        for path, value in zip(self.paths, values):
            set_number(scene, path, value)
        return scene

    def rest_at(self, scene: dict[str, Any]) -> Array:
        """Rest positions (V, 3) of the scene with its present mesh parameters."""
        return np.asarray(rest_world(scene).positions()) if self.mesh_moves else self.rest

    def residual(self, scene: dict[str, Any], positions: Array) -> Array:
        """Internal minus external forces (V, 3), N."""
        rest = self.rest_at(scene)
        return self._internal(scene, rest, positions) - self._external(scene, rest)

    def _gradients(self, rest: Array) -> tuple[Array, Array]:
        """Shape gradients (T, 4, 3), 1/m, and volumes (T,), m^3."""
        corners = rest[self.tets]
        edges = corners[:, 1:] - corners[:, :1]
        inverse = np.linalg.inv(edges)
        gradients = np.empty((len(edges), 4, 3))
        gradients[:, 1:] = np.swapaxes(inverse, 1, 2)
        gradients[:, 0] = -gradients[:, 1:].sum(axis=1)
        return gradients, np.abs(np.linalg.det(edges)) / 6

    def _probe(self, scene: dict[str, Any], F: Array, dF: Array | None) -> Array:
        """P (T, 3, 3), or its change dP under dF, Pa."""
        out = np.empty_like(F)
        for number, material in enumerate(scene["materials"]):
            chosen = self.entry_of_tet == number
            if not chosen.any():
                continue
            law = {key: value for key, value in material.items() if key not in _beside_law}
            if dF is None:
                out[chosen] = heml.probe(law, F[chosen])["P"]
            else:
                out[chosen] = heml.probe(law, F[chosen], dF[chosen])["dP"]
        return out

    def _internal(self, scene: dict[str, Any], rest: Array, positions: Array) -> Array:
        gradients, volumes = self._gradients(rest)
        F = np.einsum("tai,taj->tij", positions[self.tets], gradients)
        P = self._probe(scene, F, None)
        forces = np.zeros_like(positions)
        np.add.at(forces, self.tets, np.einsum("t,tij,taj->tai", volumes, P, gradients))
        return forces

    def _external(self, scene: dict[str, Any], rest: Array) -> Array:
        _, volumes = self._gradients(rest)
        density = np.array([float(material.get("density", 1000)) for material in scene["materials"]])
        mass = np.zeros(len(rest))
        np.add.at(mass, self.tets, np.repeat((density[self.entry_of_tet] * volumes / 4)[:, None], 4, axis=1))
        forces = mass[:, None] * np.asarray(scene.get("gravity", [0, 0, 0]), dtype=float)
        for load in scene.get("loads", []):
            if "force" in load:
                np.add.at(forces, load["nodes"], np.asarray(load["force"], dtype=float) / len(load["nodes"]))
            else:
                faces = self.surface[np.isin(self.surface, load["nodes"]).all(axis=1)]
                a, b, c = rest[faces[:, 0]], rest[faces[:, 1]], rest[faces[:, 2]]
                area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
                share = area[:, None, None] / 3 * np.asarray(load["traction"], dtype=float)
                np.add.at(forces, faces, np.repeat(share, 3, axis=1))
        return forces

    def tangent(self, scene: dict[str, Any], positions: Array) -> Any:
        """dR/dx of the free degrees of freedom, N/m: scipy.sparse matrix in CSC form."""
        sparse = require("scipy.sparse", "fit")
        gradients, volumes = self._gradients(self.rest_at(scene))
        F = np.einsum("tai,taj->tij", positions[self.tets], gradients)
        blocks = np.empty((len(F), 4, 3, 4, 3))
        for k in range(3):
            columns = np.empty((len(F), 3, 3, 3))  # dP_ij / dF_kl
            for l in range(3):
                dF = np.zeros_like(F)
                dF[:, k, l] = 1
                columns[..., l] = self._probe(scene, F, dF)
            blocks[..., k] = np.einsum("t,tijl,taj,tbl->taib", volumes, columns, gradients, gradients)
        dofs = (3 * self.tets[:, :, None] + np.arange(3)).reshape(len(F), 12)
        rows, columns_of = np.repeat(dofs, 12, axis=1), np.tile(dofs, (1, 12))
        size = 3 * len(positions)
        whole = sparse.coo_matrix((blocks.ravel(), (rows.ravel(), columns_of.ravel())), shape=(size, size)).tocsc()
        return whole[self.free_dofs][:, self.free_dofs]

    def constrained_positions(self, scene: dict[str, Any]) -> Array:
        """Positions (V, 3) of constrained nodes under the whole load; free nodes: at rest."""
        rest = self.rest_at(scene)
        placed = rest.copy()
        for support in scene.get("boundary", []):
            nodes = support["nodes"]
            turn = support.get("rotate")
            origin = np.asarray(turn["origin"] if turn else [0, 0, 0], dtype=float)
            rotation = _rotation(turn["axis"], turn["degrees"]) if turn else np.eye(3)
            shift = np.asarray(support.get("translate", [0, 0, 0]), dtype=float)
            placed[nodes] = (rest[nodes] - origin) @ rotation.T + origin + shift
        return placed

    def sensitivities(self, values: Array, steps: Array, positions: Array) -> Array:
        """dx/dp (p, V, 3) at the equilibrium `positions`.

        dR/dp at fixed free nodes comes from a five-point difference with these steps, of order steps^4.
        """
        linalg = require("scipy.sparse.linalg", "fit")
        solve = linalg.splu(self.tangent(self.scene_at(values), positions)).solve
        out = np.zeros((len(values), *positions.shape))
        for j, step in enumerate(steps):
            change = np.zeros_like(positions)  # of the residual
            for offset, weight in ((-2, 1), (-1, -8), (1, 8), (2, -1)):
                shifted = values.copy()
                shifted[j] += offset * step
                scene = self.scene_at(shifted)
                placed = np.where(self.free[:, None], positions, self.constrained_positions(scene))
                change += weight / (12 * step) * self.residual(scene, placed)
                out[j] += weight / (12 * step) * np.where(self.free[:, None], 0.0, placed)
            out[j][self.free] = -solve(change.ravel()[self.free_dofs]).reshape(-1, 3)
        return out


def _entries(scene: dict[str, Any], regions: NDArray[np.int32]) -> NDArray[np.intp]:
    """Number of the material of each element (T,): the entry of its region, else the entry without a region."""
    materials = scene["materials"]
    default = [number for number, material in enumerate(materials) if "region" not in material]
    chosen = np.full(len(regions), default[0] if default else -1, dtype=np.intp)
    for number, material in enumerate(materials):
        if "region" in material:
            chosen[regions == material["region"]] = number
    return chosen


def _rotation(axis: list[float], degrees: float) -> Array:
    """Right-handed rotation matrix (3, 3)."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
