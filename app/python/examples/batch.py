"""Many kidneys at once: each is pulled another way; one is as a lone world, to the bit.

    python batch.py [--worlds 16] [--ticks 300]
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np

import heml

scene_file = Path(__file__).parents[3] / "assets/scenes/kidney_grasp.json"
pole = 641


def pull(world: heml.World, direction: np.ndarray) -> None:
    """Takes the lower pole 2 cm along `direction` (3,)."""
    place = world.positions()[pole]
    world.grasp(node=pole, radius=0.012)
    world.move((place + 0.02 * direction).tolist())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--worlds", type=int, default=16)
    parser.add_argument("--ticks", type=int, default=300)
    arguments = parser.parse_args()
    scene = heml.Scene(str(scene_file))
    batch = heml.Batch(scene, arguments.worlds)
    angles = np.linspace(0, 2 * np.pi, arguments.worlds, endpoint=False)
    directions = np.stack([np.cos(angles), np.zeros_like(angles), np.sin(angles)], axis=1)
    for world, direction in zip(batch.worlds, directions):
        pull(world, direction)
    start = time.perf_counter()
    batch.step(arguments.ticks)
    seconds = time.perf_counter() - start
    places = batch.positions()[:, pole]  # (n, V, 3) -> (n, 3)
    print(f"{arguments.worlds} worlds, {arguments.worlds * arguments.ticks / seconds:.0f} ticks a second in all")
    for angle, place in zip(angles, places):
        print(f"  pulled at {np.degrees(angle):5.1f} degrees: pole at {np.round(place * 1e3, 2)} mm")
    alone = heml.World(scene)
    pull(alone, directions[0])
    alone.step(arguments.ticks)
    assert alone.hash() == batch.worlds[0].hash()
    print(f"a lone world has the same hash: {alone.hash()}")


if __name__ == "__main__":
    main()
