"""One task in one world as a Gymnasium environment."""

from __future__ import annotations

from typing import Any, ClassVar, Union

import gymnasium
import numpy as np
from numpy.typing import NDArray

import heml
from heml.gym.task import Episode, Task
from heml.gym.tasks import tasks

Observation = Union[NDArray[np.float32], dict[str, NDArray[Any]]]


def spaces_of(task: type[Task], observation: str, size: tuple[int, int]) -> tuple[gymnasium.Space[Any], gymnasium.Space[Any]]:
    """Of observations and of actions. Raises InputError for another `observation`."""
    state = gymnasium.spaces.Box(-1, 1, (task.state_size,), np.float32)
    action = gymnasium.spaces.Box(-1, 1, (3,), np.float32)
    if observation == "state":
        return state, action
    if observation != "picture":
        raise heml.InputError(f"observation={observation!r}: it is state or picture")
    picture = gymnasium.spaces.Box(0, 255, (size[1], size[0], 3), np.uint8)
    goal = gymnasium.spaces.Box(-1, 1, (6,), np.float32)
    return gymnasium.spaces.Dict({"picture": picture, "goal": goal}), action


def observe(task: Task, world: heml.World, episode: Episode, observation: str, size: tuple[int, int]) -> Observation:
    """As `spaces_of` says."""
    if observation == "state":
        return np.clip(task.state(world, episode), -1, 1).astype(np.float32)
    goal = np.concatenate([episode.tool, episode.goal[min(episode.progress, len(episode.goal) - 1)]])
    picture = np.asarray(heml.render(world, size, **task.view))
    return {"picture": picture, "goal": np.clip(goal, -1, 1).astype(np.float32)}


class TissueEnv(gymnasium.Env[Any, Any]):
    """Actions: (3,) in -1 ... 1, displacement of the tool in 4 mm. Observations:

    `state`: (n,) float32, as the task says (heml.gym.tasks). `picture`: a dict of `picture` (h, w, 3) uint8 and `goal`
    (6,) float32, tool and goal, which pictures do not show. A control step is 0.05 s. `info["success"]`: at the end, whether
    the goal was reached; `info["halt"]`: why the world stopped, if it did; the episode is then terminated.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        task: str,
        observation: str = "state",
        size: tuple[int, int] = (84, 84),
        render_mode: str | None = None,
        threads: int = 1,
    ) -> None:
        self.observation_space, self.action_space = spaces_of(tasks[task], observation, size)
        self.render_mode = render_mode
        self.observation, self.size = observation, size
        self.world = heml.World(heml.Scene(tasks[task].scene), threads=threads)
        self.task = tasks[task](self.world)
        self.world.step(self.task.settling)
        self.settled = self.world.snapshot()
        self.episode: Episode | None = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        super().reset(seed=seed)
        self.world.restore(self.settled)
        self.episode = self.task.begin(self.world, self.np_random)
        return self._observe(), {}

    def step(self, action: NDArray[Any]) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        if self.episode is None:
            raise gymnasium.error.ResetNeeded("step before reset")
        self.task.act(self.world, self.episode, np.clip(np.asarray(action, dtype=float), -1, 1))
        self.world.step(self.task.ticks)
        reward, success = self.task.judge(self.world, self.episode)
        info = {"success": success} | ({"halt": self.world.halt} if self.world.halt else {})
        return self._observe(), reward, success or bool(self.world.halt), False, info

    def render(self) -> Any:
        if self.render_mode is None:
            return None
        return np.asarray(heml.render(self.world, (640, 480), **self.task.view))

    def _observe(self) -> Observation:
        assert self.episode is not None
        return observe(self.task, self.world, self.episode, self.observation, self.size)
