#!/usr/bin/env python3
"""Writes scenes of assets/scenes that show something off, and the mesh of the duel of beams.

    python3 assets/make/showcase.py

The same files on every run.
"""
import math

import extreme
from extreme import ASSETS, CLAMP, DOWN, box, material, scene, six_a_cell, write_mesh

INTERACTIVE = {"integrator": "verlet", "rate": 1000, "duration": 2.0, "damping": 2.0, "continuation": True, "recovery": True}


def liver_cut():
    """A vertical blade goes in from the front, then the left lobe is taken and drawn aside."""
    blade = lambda z: [[0.030, 0.000, z], [0.044, 0.09, z]]
    events = []
    for k in range(12):
        events.append({"at": round(0.20 + 0.02 * k, 3), "cut": {
            "sweep": [blade(round(0.080 - 0.008 * k, 4)), blade(round(0.072 - 0.008 * k, 4))], "goes_on": k > 0}})
    start, way = (0.110, 0.025, 0.020), (0.045, -0.055, 0.015)
    events.append({"at": 0.6, "grasp": {"point": list(start), "radius": 0.02}})
    for k in range(1, 13):
        share = (1 - math.cos(math.pi * k / 12)) / 2
        events.append({"at": round(0.6 + 0.05 * k, 3), "move": [round(a + share * b, 4) for a, b in zip(start, way)]})
    scene("liver_cut", "Liver, cut and drawn open", "A scalpel goes into the left lobe from the front; then the lobe is taken "
          "and drawn aside, and the cut opens.", {"asset": "liver"},
          [{"sphere": [[-0.002, 0.078, -0.034], 0.016], "fix": True}, {"sphere": [[-0.030, 0.055, -0.010], 0.030], "fix": True}],
          INTERACTIVE | {"damping": 15.0},
          materials=[material(2e4, 0.43, density=1060), material(4e4, 0.43, density=1060, region=2)], gravity=DOWN,
          view={"azimuth": 12, "elevation": 18, "zoom": 1.0}, events=events)


def test_bench():
    scene("test_bench", "Tissue on the test bench", "A strip of brain tissue is drawn to one and a half times its length in two "
          "seconds: switch laws and watch the stretch and the force at the clamp.", box([0.1, 0.02, 0.02], [20, 4, 4]),
          [CLAMP, {"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [0.05, 0, 0], "over": 2.0}],
          {"integrator": "verlet", "rate": 1000, "duration": 2.5, "damping": 20},
          materials=[{"preset": "brain_ogden", "density": 1040}],
          view={"azimuth": 20, "elevation": 15, "zoom": 0.8, "field": "stretch"},
          outputs={"markers": [{"name": "middle", "box": [[0.0499, -1, -1], [0.0501, 1, 1]]}], "history": True, "every": 0.02})


def beam_duel():
    """Four beams of the same stiffness at rest, one mesh, a law each."""
    nodes, tets, regions = [], [], []
    for k in range(4):
        more, cells = six_a_cell([0.1, 0.012, 0.012], [20, 3, 3])
        tets += [[n + len(nodes) for n in tet] for tet in cells]
        regions += [k + 1] * len(cells)
        nodes += [(x, y, z + 0.03 * k) for x, y, z in more]
    extreme.OUT = ASSETS / "meshes"
    write_mesh("duel", nodes, tets, regions)
    extreme.OUT = ASSETS / "scenes"
    young, poisson = 2e4, 0.4
    mu, kappa = young / (2 + 2 * poisson), young / (3 - 6 * poisson)
    laws = [{"law": "stvk", "young": young, "poisson": poisson}, {"law": "neo_hookean", "young": young, "poisson": poisson},
            {"law": "mooney_rivlin", "K1": round(0.4 * mu, 3), "K2": round(0.1 * mu, 3), "kappa": round(kappa, 3)},
            {"law": "fung_demiray", "mu": round(mu, 3), "gamma": 5, "kappa": round(kappa, 3)}]
    scene("beam_duel", "Beam duel of laws", "Saint Venant-Kirchhoff, Neo-Hookean, Mooney-Rivlin and Fung (front to back: last "
          "to first) are as stiff at rest; drawn and bent by their weight they part.", {"asset": "duel"}, [CLAMP],
          INTERACTIVE | {"duration": 3.0}, materials=[law | {"region": k + 1, "density": 1000} for k, law in enumerate(laws)],
          gravity=DOWN, view={"azimuth": 35, "elevation": 15, "zoom": 0.8, "field": "stretch"})


def far_out():
    scene("thin_stretch", "Stretched as thin as a needle", "A bar is drawn to seven times its length in two seconds.",
          box([0.1, 0.03, 0.03], [12, 4, 4]),
          [{"box": CLAMP["box"], "translate": [-0.3, 0, 0], "over": 2.0}, {"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [0.3, 0, 0], "over": 2.0}],
          {"integrator": "backward_euler", "rate": 60, "duration": 2.5, "damping": 5}, materials=[material(1e4, 0.45)],
          view={"azimuth": 20, "elevation": 15, "zoom": 0.3, "field": "stretch"})
    scene("twist", "Wrung by two turns", "One end of a bar turns twice in two seconds; its laws and integrators can be switched "
          "on the way.", box([0.15, 0.03, 0.03], [25, 5, 5]),
          [CLAMP, {"box": [[0.1499, -1, -1], [0.1501, 1, 1]], "over": 2.0,
                   "rotate": {"axis": [1, 0, 0], "origin": [0, 0.015, 0.015], "degrees": 720}}],
          {"integrator": "backward_euler", "rate": 60, "duration": 2.5, "damping": 5}, materials=[material(1e4, 0.45)],
          view={"azimuth": 20, "elevation": 15, "zoom": 0.8, "field": "stretch"})


if __name__ == "__main__":
    extreme.OUT = ASSETS / "scenes"
    liver_cut()
    test_bench()
    beam_duel()
    far_out()
