"""Learns heml/Reach-v0 by PPO of stable-baselines3 (pip install 'heml[gym]' stable-baselines3), and compares it with
random actions and with the script of the task, on the same episodes.

    python ppo_reach.py [--steps 30000] [--episodes 20]
"""

from __future__ import annotations

import argparse
import time

import gymnasium
import numpy as np
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import DummyVecEnv, VecMonitor, VecNormalize

import heml.gym

task = "heml/Reach-v0"


def learned(model: PPO, normalise: VecNormalize) -> heml.gym.Policy:
    """The mean action of what was learned."""

    def policy(env: gymnasium.Env, state: NDArray[np.float32]) -> NDArray[np.float32]:
        return model.predict(normalise.normalize_obs(state), deterministic=True)[0]

    return policy


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=30000)
    parser.add_argument("--episodes", type=int, default=20)
    arguments = parser.parse_args()
    envs = VecNormalize(VecMonitor(DummyVecEnv([lambda: gymnasium.make(task)] * 8)), norm_reward=False)
    model = PPO("MlpPolicy", envs, n_steps=256, batch_size=256, gamma=0.95, seed=0, device="cpu")
    start, processor = time.perf_counter(), time.process_time()
    model.learn(arguments.steps)
    seconds, processor = time.perf_counter() - start, time.process_time() - processor
    print(f"{model.num_timesteps} steps in {seconds:.0f} s ({processor:.0f} s of processor time)")
    policies = {
        "random": heml.gym.random_policy, "PPO": learned(model, envs), "scripted": heml.gym.scripted_policy,
    }  # fmt: skip
    for name, policy in policies.items():
        score = heml.gym.evaluate(gymnasium.make(task), policy, arguments.episodes, seed=1000)
        spread = f"{score.returns.mean():.1f} ± {score.returns.std():.1f}"
        print(f"{name}: return {spread}, {score.successes} of {arguments.episodes} reach the target")


if __name__ == "__main__":
    main()
