"""Policies without learning, and what they gain."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import gymnasium
import numpy as np
from numpy.typing import NDArray

from heml.gym.environment import TissueEnv

Policy = Callable[[gymnasium.Env, NDArray[np.float32]], NDArray[np.float32]]


def random_policy(env: gymnasium.Env, state: NDArray[np.float32]) -> NDArray[np.float32]:
    """Each action as likely as another."""
    return env.action_space.sample()


def scripted_policy(env: gymnasium.Env, state: NDArray[np.float32]) -> NDArray[np.float32]:
    """What the task's own script does at this state."""
    tissue = env.unwrapped
    assert isinstance(tissue, TissueEnv)
    return tissue.task.scripted(np.asarray(state, dtype=float)).astype(np.float32)


@dataclass(frozen=True)
class Score:
    """Of several episodes."""

    returns: NDArray[np.float64]
    successes: int
    steps: NDArray[np.int64]


def evaluate(env: gymnasium.Env, policy: Policy, episodes: int, seed: int = 0) -> Score:
    """Runs episodes with seeds `seed`, `seed + 1` ... of an environment with state observations."""
    returns, steps, successes = np.zeros(episodes), np.zeros(episodes, dtype=np.int64), 0
    env.action_space.seed(seed)
    for k in range(episodes):
        state, _ = env.reset(seed=seed + k)
        ended = False
        while not ended:
            state, reward, terminated, truncated, info = env.step(policy(env, state))
            returns[k] += reward
            steps[k] += 1
            ended = terminated or truncated
        successes += info["success"]
    return Score(returns, successes, steps)
