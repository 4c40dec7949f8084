"""Learns heml/Reach-v0 by PPO of stable-baselines3 (pip install stable-baselines3), and compares it with random actions.

    python ppo_reach.py [--steps 60000] [--episodes 20]
"""

from __future__ import annotations

import argparse
import time

import gymnasium
from stable_baselines3 import PPO
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.vec_env import DummyVecEnv, VecMonitor, VecNormalize

import heml.gym


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=60000)
    parser.add_argument("--episodes", type=int, default=20)
    arguments = parser.parse_args()
    envs = VecNormalize(VecMonitor(DummyVecEnv([lambda: gymnasium.make("heml/Reach-v0")] * 8)), norm_reward=False)
    model = PPO("MlpPolicy", envs, n_steps=256, batch_size=256, gamma=0.95, seed=0, device="cpu")
    start = time.perf_counter()
    model.learn(arguments.steps)
    seconds = time.perf_counter() - start
    envs.training = False
    envs.seed(1000)
    mean, spread = evaluate_policy(model, envs, n_eval_episodes=arguments.episodes)
    chance = heml.gym.evaluate(
        gymnasium.make("heml/Reach-v0"), heml.gym.random_policy, arguments.episodes, seed=1000
    ).returns
    print(f"PPO after {arguments.steps} steps ({seconds:.0f} s): return {mean:.1f} ± {spread:.1f}")
    print(f"random: return {chance.mean():.1f} ± {chance.std():.1f}")


if __name__ == "__main__":
    main()
