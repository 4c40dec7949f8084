#!/usr/bin/env python3
"""Times implicit steps of three blocks, cut from one, at rest on one another on a table.

    PYTHONPATH=build/release/python python3 tests/bench/blocks_at_rest.py
"""
import time

import heml

SIZES = (("p1", [6, 6, 2]), ("p2", [4, 3, 1]), ("p1", [12, 10, 3]), ("p1", [20, 18, 6]))
TICKS = 30


def sweep(low, high):
    """Of a blade across the block, at two heights, m."""
    return {"sweep": [[[-1, low, -1], [-1, low, 1]], [[1, high, -1], [1, high, 1]]]}


def scene(element, cells):
    return {"schema_version": 1, "mesh": {"box": {"size": [0.1, 0.09, 0.03], "cells": cells}},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}], "gravity": [0, -9.81, 0], "boundary": [],
            "tables": [{"point": [0, -0.001, 0], "normal": [0, 1, 0], "friction": 0.3}],
            "self_contact": {"friction": 0.3},
            "solver": {"integrator": "backward_euler", "element": element, "rate": 60, "duration": 1},
            "events": [{"step": 2, "cut": sweep(0.035, 0.04)}, {"step": 3, "cut": sweep(0.063, 0.06)}]}


def main():
    print("element  tetrahedra  nodes  pairs  s a simulated second  Newton iterations a tick")
    for element, cells in SIZES:
        world = heml.World(scene(element, cells), threads=1)
        world.step(4)
        iterations, began = world.report()["iterations"], time.perf_counter()
        world.step(TICKS)
        seconds, report = (time.perf_counter() - began) / (TICKS * world.tick), world.report()
        print(f"{element:7}  {len(world.tets):10}  {len(world.positions()):5}  {report['self_contact']['touching']:5}  "
              f"{seconds:20.2g}  {(report['iterations'] - iterations) / TICKS:24.2g}")


if __name__ == "__main__":
    main()
