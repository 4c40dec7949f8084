"""Boxes that are cut at random, with slivers, and dropped on tables, in explicit steps: how many do not come to their end.

    HEML_BINARY=build/release/app/heml python3 tests/bench/dropped_slivers.py [BOXES]

With 160 boxes, what engine/docs/elastic-kernels.md tells of the strain of a step.
"""
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

BINARY = os.environ["HEML_BINARY"]
FUNG = {"law": "fung_demiray", "mu": 2000, "gamma": 2, "kappa": 1e5, "density": 1000}
LAWS = [
    FUNG,
    {"law": "neo_hookean", "young": 6000, "poisson": 0.45, "density": 1000},
    {"law": "mooney_rivlin", "K1": 610, "K2": 200, "kappa": 3e4, "density": 1000},
    {"law": "stvk", "young": 6000, "poisson": 0.4, "density": 1000},
    {"law": "ogden", "mu": [2000], "alpha": [4], "kappa": 5e4, "density": 1000},
    {"law": "neo_hookean", "young": 1e4, "poisson": 0.3, "density": 1000},
]


def table(height):
    return [{"point": [0, height, 0], "normal": [0, 1, 0]}]


def scene(seed):
    at = random.Random(seed)
    law = LAWS[at.randrange(len(LAWS))] if seed % 2 else FUNG
    enters, leaves, slants = (at.uniform(0.03, 0.07) for _ in range(3))
    low, high = at.uniform(-0.05, -0.025), at.uniform(-0.022, -0.015)
    first, second = at.randrange(8, 16), at.randrange(25, 40)
    blades = [[[enters, -1, -1], [enters, -1, 1]], [[leaves, 1, -1], [slants, 1, 1]]]
    return {
        "schema_version": 1,
        "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [10, 2, 2]}},
        "materials": [law],
        "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"integrator": "verlet", "rate": 60, "duration": 1.0, "continuation": seed % 3 == 0},
        "events": [
            {"step": 5, "cut": {"sweep": blades}},
            {"step": first, "tables": table(low)},
            {"step": second, "tables": table(high)},
        ],
    }


def main(boxes):
    failed, steps = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path, out = pathlib.Path(folder) / "box.json", pathlib.Path(folder) / "out"
        for seed in range(boxes):
            path.write_text(json.dumps(scene(seed)))
            done = subprocess.run([BINARY, "solve", path, "--out", out], capture_output=True, text=True)
            steps += json.loads((out / "report.json").read_text())["steps"]
            if done.returncode:
                failed += 1
                print(f"{seed}: {done.stderr.strip().splitlines()[-1]}")
    print(f"{failed} of {boxes} did not come to their end, {steps} steps in all")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 160)
