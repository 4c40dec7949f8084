"""One episode of an environment by its scripted policy, and eight at once with random actions.

    python gym_rollout.py [--environment heml/TissueRetraction-v0] [--out episode.png]
"""

from __future__ import annotations

import argparse

import gymnasium

import heml.gym
from heml.show import Picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--environment", default="heml/TissueRetraction-v0")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", help="PNG of the last state")
    arguments = parser.parse_args()
    env = gymnasium.make(arguments.environment, render_mode="rgb_array")
    score = heml.gym.evaluate(env, heml.gym.scripted_policy, episodes=1, seed=arguments.seed)
    print(f"scripted: return {score.returns[0]:.2f}, {score.steps[0]} steps, success: {bool(score.successes)}")
    if arguments.out:
        Picture(env.render()).save(arguments.out)
        print(f"wrote {arguments.out}")
    many = gymnasium.make_vec(arguments.environment, 8)
    many.reset(seed=arguments.seed)
    many.action_space.seed(arguments.seed)
    total = sum(many.step(many.action_space.sample())[1] for _ in range(20))
    print("random, eight worlds, 20 steps:", " ".join(f"{value:.2f}" for value in total))


if __name__ == "__main__":
    main()
