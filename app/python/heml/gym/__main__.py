"""`python -m heml.gym`: returns of the random and the scripted policy in every environment."""

from __future__ import annotations

import argparse

import gymnasium

from heml.gym import evaluate, random_policy, scripted_policy, tasks


def main() -> None:
    """Prints a Markdown table."""
    parser = argparse.ArgumentParser(prog="python -m heml.gym", description=__doc__)
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0, help="of the first episode")
    arguments = parser.parse_args()
    print("| environment | policy | return: mean ± standard deviation | successes | steps, mean |")
    print("|---|---|---|---|---|")
    for name in tasks:
        for title, policy in (("random", random_policy), ("scripted", scripted_policy)):
            env = gymnasium.make(f"heml/{name}-v0")
            score = evaluate(env, policy, arguments.episodes, arguments.seed)
            spread = f"{score.returns.mean():.1f} ± {score.returns.std():.1f}"
            successes = f"{score.successes} of {arguments.episodes}"
            print(f"| `heml/{name}-v0` | {title} | {spread} | {successes} | {score.steps.mean():.1f} |", flush=True)


if __name__ == "__main__":
    main()
