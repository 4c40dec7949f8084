"""python -m heml: the version, and a check of this installation."""
import sys

import heml
from heml import _core

BOX = {
    "schema_version": 1,
    "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [5, 1, 1], "origin": [0, 0, 0]}},
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.45, "density": 1000}],
    "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
    "gravity": [0, -9.81, 0],
}


def main():
    print(f"heml {heml.__version__} ({_core.build}, kernel revision {_core.kernel_revision})")
    world = heml.World(BOX)
    start = world.snapshot()
    world.step(20)
    once = world.hash()
    world.restore(start)
    world.step(20)
    right = world.hash() == once and world.positions()[:, 1].min() < 0
    print("self-check passed" if right else "self-check failed: the same steps led to another state")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
