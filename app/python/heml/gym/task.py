"""What an environment is about, apart from Gymnasium: a scene, a tool, a goal."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

import heml

Array = NDArray[np.float64]


@dataclass
class Episode:
    """One try, from reset to its end."""

    tool: Array
    """(3,) m: where the tool is."""
    goal: Array
    """(k, 3) m: target, or marks."""
    progress: int = 0
    """Of tasks with several goals: how many are reached."""
    started: bool = False
    """Of tasks with a blade: whether its stroke has begun."""
    weights: Array = field(default_factory=lambda: np.zeros(0))
    """Of goals that move with the tissue: of the nodes that each hangs on."""
    nodes: NDArray[np.intp] = field(default_factory=lambda: np.zeros((0, 3), dtype=np.intp))


class Task(ABC):
    """A task holds nothing that changes, so that many worlds share one."""

    scene: ClassVar[dict[str, Any]]
    view: ClassVar[dict[str, Any]] = {"azimuth": 30, "elevation": 35}
    ticks: ClassVar[int] = 50
    """Of the engine, a control step: 0.05 s."""
    settling: ClassVar[int] = 500
    """Ticks before the first episode, in which the tissue comes to rest."""
    max_steps: ClassVar[int] = 80
    state_size: ClassVar[int]
    reach: ClassVar[float] = 0.004
    """Of the tool, a control step and axis, m."""

    def __init__(self, world: heml.World) -> None:
        """world: of `scene`, at rest."""
        self.rest: Array = np.asarray(world.positions())
        self.surface = np.asarray(world.surface)

    @abstractmethod
    def begin(self, world: heml.World, random: np.random.Generator) -> Episode:
        """Chooses a goal and takes the tool. The world is settled."""

    @abstractmethod
    def act(self, world: heml.World, episode: Episode, action: Array) -> None:
        """Moves the tool by `action` (3,) in -1 ... 1, before the ticks of a control step."""

    @abstractmethod
    def state(self, world: heml.World, episode: Episode) -> Array:
        """(state_size,) m."""

    @abstractmethod
    def judge(self, world: heml.World, episode: Episode) -> tuple[float, bool]:
        """Reward of this control step, and whether the goal is reached."""

    @abstractmethod
    def scripted(self, state: Array) -> Array:
        """An action (3,) that a person would choose by the state."""

    def nearest(self, point: Array) -> int:
        """The node nearest to `point` at rest."""
        return int(np.argmin(np.sum((self.rest - point) ** 2, axis=1)))


def sheet(size: list[float], cells: list[int], young: float, **rest: Any) -> dict[str, Any]:
    """A scene of a box of soft tissue with its lowest corner at the origin; y is up."""
    return {
        "schema_version": 1,
        "mesh": {"box": {"size": size, "cells": cells}},
        "materials": [{"law": "neo_hookean", "young": young, "poisson": 0.4, "density": 1000}],
        "gravity": [0, -9.81, 0],
        "solver": {"integrator": "verlet", "rate": 1000, "damping": 10, "continuation": True, "recovery": True},
        **rest,
    }
