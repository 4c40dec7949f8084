"""The same stiffness at rest under different laws: stress over stretch, and how far a beam bends.

    python compare_laws.py [--out laws.png]
"""

from __future__ import annotations

import argparse

import numpy as np

import heml

mu, poisson = 1e5, 0.4  # Pa
lame = 2 * mu * poisson / (1 - 2 * poisson)
bulk = lame + 2 * mu / 3
laws = {
    "neo_hookean": {"mu": mu, "lambda": lame},
    "stvk": {"mu": mu, "lambda": lame},
    "mooney_rivlin": {"K1": 0.7 * mu / 2, "K2": 0.3 * mu / 2, "kappa": bulk},
    "yeoh": {"C10": mu / 2, "C20": mu / 8, "C30": 0.0, "kappa": bulk},
    "gent": {"mu": mu, "Jm": 3.0, "kappa": bulk},
}


def uniaxial(material: dict, stretches: np.ndarray) -> np.ndarray:
    """Nominal stress (n,), Pa: the sides are free, their stretch is found by Newton's method on P22 = 0."""
    side = stretches**-0.5
    for _ in range(30):
        F = np.zeros((len(stretches), 3, 3))
        F[:, 0, 0], F[:, 1, 1], F[:, 2, 2] = stretches, side, side
        dF = np.broadcast_to(np.diag([0.0, 1.0, 1.0]), F.shape).copy()
        state = heml.probe(material, F, dF)
        side = side - state["P"][:, 1, 1] / state["dP"][:, 1, 1]
    return state["P"][:, 0, 0]


def bent_beam(material: dict) -> float:
    """Descent of the end of a clamped beam 10 cm long under its weight, m."""
    scene = {
        "schema_version": 1,
        "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [15, 3, 3]}},
        "materials": [material | {"density": 1000}],
        "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"integrator": "static"},
    }
    positions, _ = heml.solve(heml.Scene(scene))
    return 0.02 - float(positions[-1, 1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="laws.png")
    arguments = parser.parse_args()
    stretches = np.linspace(0.8, 1.6, 81)
    curves = {}
    for law, parameters in laws.items():
        material = {"law": law, **parameters}
        curves[law] = uniaxial(material, stretches)
        print(f"{law:14} stress at stretch 1.5: {np.interp(1.5, stretches, curves[law]):7.0f} Pa,", end=" ")
        print(f"beam bends by {bent_beam(material) * 1e3:.2f} mm")
    plot(stretches, curves, arguments.out)


def plot(stretches: np.ndarray, curves: dict, out: str) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(layout="constrained")
    for law, stress in curves.items():
        axes.plot(stretches, stress / 1e3, label=law)
    axes.set(xlabel="stretch", ylabel="nominal stress (kPa)")
    axes.legend()
    figure.savefig(out, dpi=150)
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
