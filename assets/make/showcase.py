#!/usr/bin/env python3
"""Writes scenes of assets/scenes that show something off, and the meshes of the duel of beams and of the kidney on a pad.

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
          {"integrator": "backward_euler", "rate": 100, "duration": 2.5, "damping": 20, "budget": {"iterations": 2}},
          materials=[{"preset": "brain_ogden", "density": 1040}],
          view={"azimuth": 20, "elevation": 15, "zoom": 0.6, "field": "stretch"},
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


def read_mesh(name):
    words = [line.split("#")[0] for line in (ASSETS / "meshes" / f"{name}.mesh").read_text().splitlines()]
    words = " ".join(words).split()
    first = lambda keyword: words.index(keyword) + 2
    count = lambda keyword: int(words[words.index(keyword) + 1])
    rows = lambda keyword, width: [words[first(keyword) + width * k:][:width] for k in range(count(keyword))]
    nodes = [tuple(map(float, row[:3])) for row in rows("Vertices", 4)]
    tets = [([int(n) - 1 for n in row[:4]], int(row[4])) for row in rows("Tetrahedra", 5)]
    return nodes, [tet for tet, _ in tets], [region for _, region in tets]


def kidney_on_pad():
    """The kidney, laid down, 4 mm above a soft pad: two bodies of one mesh."""
    nodes, tets, regions = read_mesh("kidney")
    nodes = [(x, z, -y) for x, y, z in nodes]
    size, cells = [0.13, 0.03, 0.14], [10, 3, 11]
    low, middle = min(y for _, y, _ in nodes), [sum(c) / len(nodes) for c in zip(*nodes)]
    corner = (middle[0] - size[0] / 2, low - 0.004 - size[1], middle[2] - size[2] / 2)
    pad, more = six_a_cell(size, cells)
    tets += [[n + len(nodes) for n in tet] for tet in more]
    regions += [3] * len(more)
    nodes += [tuple(c + o for c, o in zip(node, corner)) for node in pad]
    extreme.OUT = ASSETS / "meshes"
    write_mesh("kidney_on_pad", nodes, tets, regions)
    extreme.OUT = ASSETS / "scenes"
    start = [round(middle[0] + 0.02, 3), round(-low, 3), round(middle[2], 3)]
    events = [{"at": 0.8, "grasp": {"point": start, "radius": 0.012}}]
    for k in range(1, 13):
        share = (1 - math.cos(math.pi * k / 12)) / 2
        events.append({"at": round(0.8 + 0.05 * k, 3), "move": [round(start[0] - 0.03 * share, 4), round(start[1] + 0.045 * share, 4), start[2]]})
    scene("kidney_on_pad", "Kidney on a soft pad", "Two bodies touch: a kidney falls on a pad that is softer than itself and sinks in; "
          "it is lifted at one side, let go, and falls back.", {"asset": "kidney_on_pad"},
          [{"box": [[-1, -1, -1], [1, round(corner[1] + 1e-4, 6), 1]], "fix": True}],
          INTERACTIVE | {"integrator": "backward_euler", "rate": 60, "duration": 3.0, "damping": 4.0, "budget": {"iterations": 2}},
          materials=[material(1e4, 0.43, density=1050), material(1.5e4, 0.43, density=1050, region=2), material(6e3, 0.4, region=3)],
          gravity=DOWN, self_contact={"friction": 0.4, "within_bodies": False}, view={"azimuth": 20, "elevation": 20, "zoom": 1.2},
          events=events + [{"at": 1.7, "release": True}])


def strip_tears():
    scene("strip_tears", "A strip that tears", "A notched strip is drawn out; where it is stretched to more than 1.8 times its length "
          "it comes apart, and the tear runs from the notch across.", box([0.1, 0.04, 0.006], [25, 10, 2]),
          [CLAMP, {"box": [[0.0999, -1, -1], [0.1001, 1, 1]], "translate": [0.06, 0, 0], "over": 2.0}],
          INTERACTIVE | {"integrator": "backward_euler", "rate": 80, "projection": "none", "duration": 3.0, "damping": 10.0, "budget": {"iterations": 1}},
          materials=[material(2e4, 0.4)], gravity=DOWN, tearing={"stretch": 1.8},
          view={"azimuth": 15, "elevation": 20, "zoom": 0.7, "field": "stretch"},
          events=[{"at": 0.01, "cut": {"sweep": [[[0.049, 0.03, -1], [0.049, 0.03, 1]], [[0.049, 0.05, -1], [0.049, 0.05, 1]]], "goes_on": False}}])


if __name__ == "__main__":
    extreme.OUT = ASSETS / "scenes"
    liver_cut()
    test_bench()
    beam_duel()
    far_out()
    kidney_on_pad()
    strip_tears()
