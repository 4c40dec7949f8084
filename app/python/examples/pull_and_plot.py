"""Pulls the kidney of `assets/scenes/kidney_pull.json` and plots the height of its lower pole, and its energies.

    python pull_and_plot.py [--seconds 2] [--out pull.png]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import heml

scene_file = Path(__file__).parents[3] / "assets/scenes/kidney_pull.json"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--out", default="pull.png")
    arguments = parser.parse_args()
    world = heml.World(heml.Scene(str(scene_file)))
    positions = world.positions()  # (V, 3) m
    pole = int(np.argmin(positions[:, 1]))
    times, heights, energies = [], [], []
    while world.time < arguments.seconds:
        world.step(10)
        world.positions(out=positions)
        times.append(world.time)
        heights.append(positions[pole, 1])
        energies.append(world.energies())
    print(f"{world.ticks} ticks; the pole (node {pole}) moved between {min(heights):.4f} and {max(heights):.4f} m")
    plot(times, heights, energies, arguments.out)


def plot(times: list, heights: list, energies: list, out: str) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(2, sharex=True, layout="constrained")
    above.plot(times, np.array(heights) * 1e3)
    above.set_ylabel("height of the pole (mm)")
    for name in energies[0]:
        below.plot(times, [1e3 * energy[name] for energy in energies], label=name)
    below.set(xlabel="time (s)", ylabel="energy (mJ)")
    below.legend()
    figure.savefig(out, dpi=150)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
