"""How far a beam bends, by stiffness and by mesh, on all cores or on a cluster.

    python sweep.py [--quick] [--scheduler tcp://host:8786] [--out bending.csv]
"""

from __future__ import annotations

import argparse

import heml


def bending(case: dict) -> dict:
    """Descent of the end of a clamped beam, m. Runs on a worker: it imports what it needs."""
    import heml

    cells = case["cells"]
    scene = {
        "schema_version": 1,
        "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [5 * cells, cells, cells]}},
        "materials": [{"law": "neo_hookean", "young": case["young"], "poisson": 0.4, "density": 1000}],
        "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"integrator": "static"},
    }
    positions, report = heml.solve(heml.Scene(scene), threads=1)
    return {"descent": 0.02 - positions[-1, 1], "tets": report["tets"], "iterations": report["iterations"]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="four cases")
    parser.add_argument("--scheduler", help="address; without: this machine")
    parser.add_argument("--out", help=".csv or .parquet; an interrupted sweep goes on there")
    arguments = parser.parse_args()
    youngs, cells = ((1e5, 2e5), (1, 2)) if arguments.quick else ((1e5, 1.5e5, 2e5, 3e5, 5e5), (1, 2, 3, 4, 6))
    cases = [{"young": young, "cells": count} for young in youngs for count in cells]
    table = heml.sweep(bending, cases, client=arguments.scheduler, out=arguments.out)
    print(table.drop(columns="key").to_string(index=False))


if __name__ == "__main__":  # workers import this file
    main()
