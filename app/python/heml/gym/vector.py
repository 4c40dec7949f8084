"""Many worlds of one task as a Gymnasium VectorEnv on heml.Batch."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space, concatenate, create_empty_array
from numpy.typing import NDArray

import heml
from heml.gym.environment import observe, spaces_of
from heml.gym.task import Episode
from heml.gym.tasks import tasks


class TissueVectorEnv(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """As `gymnasium.vector.SyncVectorEnv` of TissueEnv, to the bit, with worlds that a pool of threads steps together.

    An episode that has ended is reset by the next step, whose action it ignores (AutoresetMode.NEXT_STEP).
    `info["success"]` and `info["halt"]`: (n,), with `_success` and `_halt` where they hold.
    """

    metadata: ClassVar[dict[str, Any]] = {
        "render_modes": ["rgb_array"], "render_fps": 20, "autoreset_mode": AutoresetMode.NEXT_STEP,
    }  # fmt: skip

    def __init__(
        self,
        task: str,
        num_envs: int = 1,
        observation: str = "state",
        size: tuple[int, int] = (84, 84),
        render_mode: str | None = None,
        threads: int = 0,
        max_episode_steps: int | None = None,
    ) -> None:
        self.num_envs, self.observation, self.size, self.render_mode = num_envs, observation, size, render_mode
        self.single_observation_space, self.single_action_space = spaces_of(tasks[task], observation, size)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.batch = heml.Batch(heml.Scene(tasks[task].scene), num_envs, threads=threads)
        self.worlds = self.batch.worlds
        self.task = tasks[task](self.worlds[0])
        self.worlds[0].step(self.task.settling)
        self.settled = self.worlds[0].snapshot()
        self.max_steps = max_episode_steps or self.task.max_steps
        self.random = [np.random.default_rng() for _ in range(num_envs)]
        self.episodes: list[Episode | None] = [None] * num_envs
        self.steps = np.zeros(num_envs, dtype=int)
        self.ended = np.zeros(num_envs, dtype=bool)

    def reset(self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """seed: of world i: seed + i, or one of a list. options["reset_mask"]: (n,) bool, those to reset; else all."""
        seeds = [seed + i for i in range(self.num_envs)] if isinstance(seed, int) else seed or [None] * self.num_envs
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, dtype=bool))
        for i in np.flatnonzero(mask):
            if seeds[i] is not None:
                self.random[i], _ = gymnasium.utils.seeding.np_random(seeds[i])
        self._begin(np.flatnonzero(mask))
        return self._observe(), {}

    def step(self, actions: NDArray[Any]) -> tuple[Any, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        anew = self.ended.copy()
        clipped = np.clip(np.asarray(actions, dtype=float), -1, 1)
        for i in np.flatnonzero(~anew):
            self.task.act(self.worlds[i], self._episode(i), clipped[i])
        self.batch.step(self.task.ticks)
        self.steps += 1
        rewards = np.zeros(self.num_envs)
        terminated = np.zeros(self.num_envs, dtype=bool)
        infos: dict[str, Any] = {}
        for i in np.flatnonzero(~anew):
            rewards[i], success = self.task.judge(self.worlds[i], self._episode(i))
            halt = self.worlds[i].halt
            terminated[i] = success or bool(halt)
            infos = self._add_info(infos, {"success": success} | ({"halt": halt} if halt else {}), i)
        self._begin(np.flatnonzero(anew))
        truncated = (self.steps >= self.max_steps) & ~anew
        self.ended = terminated | truncated
        return self._observe(), rewards, terminated, truncated, infos

    def render(self) -> tuple[Any, ...] | None:
        if self.render_mode is None:
            return None
        return tuple(np.asarray(heml.render(world, (640, 480), **self.task.view)) for world in self.worlds)

    def _episode(self, i: int) -> Episode:
        episode = self.episodes[i]
        if episode is None:
            raise gymnasium.error.ResetNeeded("step before reset")
        return episode

    def _begin(self, indices: NDArray[np.intp]) -> None:
        if len(indices):
            self.batch.reset([int(i) for i in indices], self.settled)
        for i in indices:
            self.episodes[i] = self.task.begin(self.worlds[i], self.random[i])
            self.steps[i], self.ended[i] = 0, False

    def _observe(self) -> Any:
        each = [
            observe(self.task, self.worlds[i], self._episode(i), self.observation, self.size)
            for i in range(self.num_envs)
        ]
        empty = create_empty_array(self.single_observation_space, self.num_envs)
        return concatenate(self.single_observation_space, each, empty)
