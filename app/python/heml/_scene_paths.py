"""Places in a scene by path: `materials[0].young`, `loads[1].force[2]`, `gravity[1]`, `mesh.scale`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import heml

_token = re.compile(r"([A-Za-z_]\w*)|\[(\d+)\]")
# Numbers that an equilibrium may depend on: not selections, times and what says how to solve.
_fitted = re.compile(
    r"materials\[\d+\]\.(?!region$)[A-Za-z_].*|loads\[\d+\]\.((force|traction)\[\d+\]|pressure)|gravity\[\d+\]|"
    r"boundary\[\d+\]\.(translate\[\d+\]|rotate\.((axis|origin)\[\d+\]|degrees))|mesh\.scale"
)
_defaults: dict[str, float] = {"mesh.scale": 1.0}


def _tokens(path: str) -> list[str | int]:
    tokens: list[str | int] = []
    place = 0
    while place < len(path):
        if tokens and path[place] == ".":
            place += 1
        found = _token.match(path, place)
        if not found:
            raise heml.InputError(f"{path!r}: no path at column {place + 1}; write for example materials[0].young")
        tokens.append(found[1] if found[1] else int(found[2]))
        place = found.end()
    if not tokens:
        raise heml.InputError("an empty path; write for example materials[0].young")
    return tokens


def _walk(scene: Any, tokens: list[str | int], path: str) -> Any:
    for token in tokens:
        try:
            scene = scene[token]
        except (KeyError, IndexError, TypeError):
            raise heml.InputError(f"{path}: the scene has no {token!r} there") from None
    return scene


def get_number(scene: dict[str, Any], path: str) -> float:
    """The number at `path`. Raises InputError where there is none, or none that an equilibrium depends on."""
    tokens = _tokens(path)
    if path in _defaults:
        scene = dict(scene.get("mesh", {}))
        return float(scene.get(tokens[-1], _defaults[path]))
    value = _walk(scene, tokens, path)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise heml.InputError(f"{path}: {value!r} is no number; a parameter is one number of the scene")
    if not _fitted.fullmatch(path):
        raise heml.InputError(
            f"{path}: cannot be fitted; give a path to one number of materials, loads, gravity or boundary, or mesh.scale, "
            "as materials[0].young or gravity[1]"
        )
    return float(value)


def set_number(scene: dict[str, Any], path: str, value: float) -> None:
    """Sets the number at `path` in place."""
    tokens = _tokens(path)
    _walk(scene, tokens[:-1], path)[tokens[-1]] = float(value)


def name_moduli(scene: dict[str, Any], paths: Iterable[str]) -> None:
    """Names the moduli of materials as the paths do, in place: `lambda` and `mu`, or `young` and `poisson`."""
    for path in paths:
        tokens = _tokens(path)
        if tokens[0] != "materials" or len(tokens) != 3:
            continue
        material = _walk(scene, tokens[:2], path)
        if tokens[2] in ("young", "poisson") and {"lambda", "mu"} <= set(material):
            first, shear = material.pop("lambda"), material.pop("mu")
            material["young"] = shear * (3 * first + 2 * shear) / (first + shear)
            material["poisson"] = first / (2 * (first + shear))
