#!/usr/bin/env python3
"""Writes assets/scenes/extreme: the scenes of `heml study stability`, and the meshes and starts they need.

    python3 assets/make/extreme.py

The same files on every run. A scene is a dictionary below; what it is for stands in its description.
"""
import json
import math
import pathlib
import random

ASSETS = pathlib.Path(__file__).resolve().parent.parent
OUT = ASSETS / "scenes" / "extreme"
FAR = [[0.0999, -1, -1], [0.1001, 1, 1]]
CLAMP = {"box": [[-0.001, -1, -1], [0.001, 1, 1]], "fix": True}


def box_nodes(size, cells):
    (a, b, c), (nx, ny, nz) = size, cells
    return [(a * i / nx, b * j / ny, c * k / nz) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]


def box(size, cells):
    return {"box": {"size": size, "cells": cells, "origin": [0, 0, 0]}}


def six_a_cell(size, cells):
    """Nodes and tetrahedra of a block, each cell split along one diagonal."""
    nx, ny, nz = cells
    number = lambda i, j, k: i + (nx + 1) * (j + (ny + 1) * k)
    tets = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                for o, order in enumerate([(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]):
                    at, tet = [i, j, k], [number(i, j, k)]
                    for axis in order:
                        at[axis] += 1
                        tet.append(number(*at))
                    if o >= 3:
                        tet[2], tet[3] = tet[3], tet[2]
                    tets.append(tet)
    return box_nodes(size, cells), tets


def five_a_cell(size, cells):
    """Nodes and tetrahedra of a block as the program makes it: a tetrahedron inside each cell and one at four corners."""
    nx, ny, nz = cells
    tets = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                node = lambda c: i + (c & 1) + (nx + 1) * (j + (c >> 1 & 1) + (ny + 1) * (k + (c >> 2 & 1)))
                even = (i + j + k) % 2 == 0
                tets.append([node(c) for c in ((0, 3, 6, 5) if even else (1, 2, 4, 7))])
                for c in (1, 2, 4, 7) if even else (0, 3, 5, 6):
                    tets.append([node(d) for d in ((c, c ^ 2, c ^ 1, c ^ 4) if even else (c, c ^ 1, c ^ 2, c ^ 4))])
    return box_nodes(size, cells), tets


def noise(seed, place):
    """From -1 to 1, as the study's noise(): the finaliser of SplitMix64."""
    word = lambda value: value & (2 ** 64 - 1)
    z = word(seed + 0x9e3779b97f4a7c15 + place)
    z = word((z ^ (z >> 30)) * 0xbf58476d1ce4e5b9)
    z = word((z ^ (z >> 27)) * 0x94d049bb133111eb)
    return ((z ^ (z >> 31)) >> 11) * 2 ** -52 - 1


def write_mesh(name, nodes, tets, regions=None):
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(nodes))]
    lines += [" ".join(f"{c:.17g}" for c in node) + " 0" for node in nodes]
    lines += ["Tetrahedra", str(len(tets))]
    lines += [" ".join(str(n + 1) for n in tet) + f" {regions[t] if regions else 0}" for t, tet in enumerate(tets)]
    (OUT / f"{name}.mesh").write_text("\n".join(lines + ["End", ""]))


def write_positions(name, positions):
    lines = ["node,x,y,z"] + [f"{n}," + ",".join(f"{c:.17g}" for c in at) for n, at in enumerate(positions)]
    (OUT / f"{name}.csv").write_text("\n".join(lines) + "\n")


def material(young=1e4, poisson=0.3, **more):
    return {"law": "neo_hookean", "young": young, "poisson": poisson, "density": 1000, **more}


def scene(name, title, description, mesh, boundary, solver, materials=None, view=None, **more):
    whole = {"schema_version": 1, "name": name, "title": title, "description": description, "mesh": mesh,
             "materials": materials or [material()], "boundary": boundary, **more, "solver": solver,
             "view": view or {"azimuth": 25, "elevation": 15, "zoom": 0.6, "wireframe": True}}
    text = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in whole.items() if key not in ("boundary", "events")]
    for key in ("boundary", "events"):
        if key in whole:
            rows = ",\n".join("    " + json.dumps(entry) for entry in whole[key])
            text.append(f"  {json.dumps(key)}: [\n{rows}\n  ]")
    (OUT / f"{name}.json").write_text("{\n" + ",\n".join(text) + "\n}\n")


BAR, SHORT_BAR = box([0.1, 0.02, 0.02], [10, 2, 2]), box([0.1, 0.02, 0.02], [6, 2, 2])
CUBE = box([0.1, 0.1, 0.1], [2, 2, 2])
DOWN = [0, -9.81, 0]
CUBE_VIEW = {"azimuth": 30, "elevation": 20, "zoom": 0.6, "wireframe": True, "field": "J"}


def held_affine():
    """Every node of a cube's surface on its way to an affine shape."""
    lines = (ASSETS / "meshes" / "irregular_cube.mesh").read_text().split()
    at = lines.index("Vertices")
    count = int(lines[at + 1])
    nodes = [[float(c) for c in lines[at + 2 + 4 * n:at + 5 + 4 * n]] for n in range(count)]
    low, high = ([f(node[i] for node in nodes) for i in range(3)] for f in (min, max))
    F = [[1.2, 0.1, 0], [0, 0.9, 0.05], [0, 0, 1.1]]
    entries = []
    for n, X in enumerate(nodes):
        if any(abs(X[i] - edge[i]) < 1e-9 for i in range(3) for edge in (low, high)):
            to = [sum(F[i][j] * X[j] for j in range(3)) - X[i] for i in range(3)]
            entries.append({"nodes": [n], "translate": to, "over": 0.5})
    return entries


def forces():
    """Cases that look at the forces of one state: its scene lets a body go from there."""
    nodes, tets = five_a_cell([0.1, 0.08, 0.06], [3, 2, 2])
    nodes = [tuple(c + 0.004 * noise(1, 3 * n + i) for i, c in enumerate(X)) for n, X in enumerate(nodes)]
    write_mesh("irregular_block", nodes, tets)
    upright = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    sheared = [[1.2, 0.15, 0], [-0.1, 0.9, 0.1], [0.05, 0, 1.05]]
    stretched = [[1.4, 0, 0], [0, 0.8, 0], [0, 0, 0.8]]
    s, c, axis = math.sin(1.1), math.cos(1.1), [1 / 3, -2 / 3, 2 / 3]
    cross = [[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]]
    turned = [[c * upright[i][j] + s * cross[i][j] + (1 - c) * axis[i] * axis[j] for j in range(3)] for i in range(3)]
    explicit = lambda method: {"integrator": method, "rate": 1000, "duration": 0.2}
    implicit = lambda method: {"integrator": method, "step": 0.01, "duration": 0.5, "continuation": True}
    ogden = {"law": "ogden", "mu": [2564], "alpha": [3], "kappa": 8333, "density": 1000}
    for name, title, description, F, carried, (reach, seed), solver, matter in [
            ("01_force", "Let go inside out", "Elements are inside out: forces have to be the slope of the energy there too.",
             upright, 0, (0.024, 2), explicit("symplectic_euler") | {"continuation": True}, material()),
            ("02_stiffness", "Let go inside out, implicit", "Elements are inside out: the stiffness has to be the slope of the "
             "forces there too.", upright, 0, (0.018, 2), implicit("backward_euler"), material()),
            ("03_tension_form", "Let go sheared", "Sheared, and shaken a little: forces from edges have to be those from "
             "deformation gradients.", sheared, 0, (0.002, 3), explicit("verlet"), material()),
            ("04_ten_km_away", "Ten kilometres away", "Turned, 10 km from the origin: it has to feel nothing.",
             turned, 1e4, (0, 0), explicit("verlet"), material()),
            ("05_sums_of_forces", "Let go shaken", "Nothing holds this block: its forces must have no sum and no moment.",
             upright, 0, (0.009, 4), implicit("tr_bdf2"), material()),
            ("25_equal_stretches", "Let go with equal stretches", "Two principal stretches are equal, so their directions are any: "
             "the stiffness has to be one.", stretched, 0, (1e-6, 6), implicit("bdf2"), ogden)]:
        write_positions(name, [
            tuple(sum(F[i][j] * X[j] for j in range(3)) + carried * (1, -1, 1)[i] + reach * noise(seed, 3 * n + i) for i in range(3))
            for n, X in enumerate(nodes)])
        scene(name, title, description, {"file": "irregular_block.mesh"} | ({"translate": [carried, -carried, carried]} if carried else {}),
              [], solver, materials=[matter], initial={"positions": f"{name}.csv"})


def statics_and_accuracy():
    scene("06_patch", "Patch test", "The surface of an irregular cube is brought to an affine shape: every node inside "
          "has to find the same one.", {"asset": "irregular_cube"}, held_affine(),
          {"integrator": "verlet", "duration": 2.0, "damping": 60}, view=CUBE_VIEW)
    scene("07_order_of_verlet", "A beam falls", "A soft beam falls from rest; halving the step has to quarter the error.",
          BAR, [CLAMP], {"integrator": "verlet", "step": 1e-4, "duration": 0.1, "damping": 2}, gravity=DOWN)
    scene("08_order_of_tr_bdf2", "A beam under a load that grows", "Slow enough for large steps to resolve: halving them "
          "has to quarter the error.", BAR, [CLAMP],
          {"integrator": "tr_bdf2", "step": 0.005, "duration": 0.25, "damping": 60},
          loads=[{"box": [[-1, -1, -1], [1, 1, 1]], "force": [0, -0.4, 0], "over": 0.4}])
    scene("09_beam_drop", "A beam drops", "At 10 kPa it bends so far that its stable step shrinks on the way: the step that "
          "suits it at rest makes it run away.", box([0.1, 0.02, 0.02], [20, 4, 4]), [CLAMP],
          {"integrator": "verlet", "rate": 1000, "duration": 1.0}, gravity=DOWN)
    scene("10_energy_drift", "A beam swings without damping", "For a second and more; its energy has to stay.", BAR, [CLAMP],
          {"integrator": "verlet", "step": 1e-4, "duration": 1.1}, gravity=DOWN)


def starts():
    nodes = box_nodes([0.1, 0.02, 0.02], [6, 2, 2])

    def twisted(x, y, z):
        a = math.pi * x / 0.1
        return (x, 0.01 + (y - 0.01) * math.cos(a) - (z - 0.01) * math.sin(a),
                0.01 + (y - 0.01) * math.sin(a) + (z - 0.01) * math.cos(a))

    dice = random.Random(5)
    shaken = lambda x, y, z: (x, y, z) if x < 1e-9 else tuple(c + dice.uniform(-0.003, 0.003) for c in (x, y, z))
    still = lambda place: lambda x, y, z: (x, y, z) if x < 1e-9 else place(x, y, z)
    for name, title, place in [
            ("11_stretched", "Let go at twice its length", lambda x, y, z: (2 * x, y, z)),
            ("11_compressed", "Let go at seven tenths of its length", lambda x, y, z: (0.7 * x, y, z)),
            ("11_thinned", "Let go at half its thickness", still(lambda x, y, z: (x, 0.5 * y, 0.5 * z))),
            ("11_twisted", "Let go half a turn twisted", still(twisted)),
            ("12_shaken", "Let go from disorder", shaken)]:
        write_positions(name, [place(*X) for X in nodes])
        scene(name, title, "Nothing pulls at this bar and nothing holds it back but its end: it must not gain energy, "
              "whatever the step and however few iterations it is given.", SHORT_BAR, [CLAMP],
              {"integrator": "backward_euler", "step": 0.01, "duration": 0.5, "continuation": name.startswith("12")},
              initial={"positions": f"{name}.csv"})


def collapses():
    nodes, half = box_nodes([0.1, 0.1, 0.1], [2, 2, 2]), 0.05
    dice = random.Random(1)
    for name, title, place in [
            ("13_point", "Collapsed to a point", lambda x, y, z: (half, half, half)),
            ("13_line", "Collapsed to a line", lambda x, y, z: (x, half, half)),
            ("13_plane", "Collapsed to a plane", lambda x, y, z: (x, y, half)),
            ("13_scatter", "Scattered at random", lambda x, y, z: tuple(dice.uniform(0, 0.1) for _ in range(3))),
            ("15_mirrored", "One half mirrored into the other", lambda x, y, z: (0.1 - x if x > half else x, y, z))]:
        write_positions(name, [place(*X) for X in nodes])
        scene(name, title, "A cube that starts as no cube: it has to be one again within a second, nothing inside out.",
              CUBE, [CLAMP], {"integrator": "backward_euler", "step": 1 / 60, "duration": 1.0, "recovery": True},
              view=CUBE_VIEW, initial={"positions": f"{name}.csv"})
    scene("14_flattened", "Pressed through its own floor", "A cube of Saint Venant-Kirchhoff is pressed flat and beyond: "
          "with the law continued it pushes back harder all the way.", CUBE,
          [{"box": [[-1, -1, -1], [1, 0.001, 1]], "fix": True},
           {"box": [[-1, 0.099, -1], [1, 1, 1]], "translate": [0, -0.12, 0], "over": 1.0}],
          {"integrator": "backward_euler", "step": 0.02, "duration": 1.5, "continuation": True},
          materials=[material(law="stvk")], view=CUBE_VIEW)


def far_deformations():
    for name, title, move in [("16_stretched_five_times", "Stretched to five times its length", 0.4),
                              ("16_pressed_to_a_fifth", "Pressed to a fifth of its length", -0.08)]:
        scene(name, title, "Held at both ends; its equilibrium has to be found in 60 iterations.", BAR,
              [CLAMP, {"box": FAR, "translate": [move, 0, 0]}], {"integrator": "static", "tolerance": 1e-8})
    turn = lambda degrees, over, move=0.0: {"box": FAR, "translate": [move, 0, 0], "over": over, "rotate": {
        "axis": [1, 0, 0], "origin": [0, 0.01, 0.01], "degrees": degrees}}
    scene("17_half_a_turn", "Wrung by half a turn", "In a fifth of a second, steps of 10 ms: at most 8 iterations each.",
          BAR, [CLAMP, turn(180, 0.2)], {"integrator": "backward_euler", "step": 0.01, "duration": 0.3})
    scene("18_two_turns", "Wrung by two turns", "Stretched by half, slowly wrung: it never has more energy than the turning end has put in.",
          BAR, [CLAMP, turn(720, 1.0, 0.05)],
          {"integrator": "backward_euler", "step": 0.02, "duration": 1.0, "damping": 100})
    scene("24_exponential_far_out", "Fung's exponential, far out", "Pulled to three and a half times its length, where the law says "
          "e to the 200: continued, it is as stiff as it may be and no stiffer.", BAR,
          [CLAMP, {"box": FAR, "translate": [0.25, 0, 0]}],
          {"integrator": "static", "continuation": True, "tolerance": 1e-8},
          materials=[{"law": "fung_demiray", "mu": 3846, "gamma": 20, "kappa": 8333, "density": 1000}])


def bad_bodies():
    nodes, tets = six_a_cell([0.1, 0.02, 0.02], [10, 2, 2])
    write_mesh("halves", nodes, tets, [int(sum(nodes[n][0] for n in tet) / 4 > 0.05) for tet in tets])
    scene("19_stiff_half", "One half a million times stiffer", "10 kPa and 10 GPa in one body, moved and turned at its "
          "stiff end: the soft half has to feel a rigid one.", {"file": "halves.mesh"},
          [CLAMP, {"box": FAR, "translate": [0.02, 0, 0],
                   "rotate": {"axis": [1, 0, 0], "origin": [0, 0.01, 0.01], "degrees": 40}}],
          {"integrator": "static"}, materials=[material(), material(1e10, region=1)])
    scene("23_heavy_half", "One half ten thousand times heavier", "A heavy half on the clamp and a light one beyond it: "
          "explicit and implicit steps have to agree.", {"file": "halves.mesh"}, [CLAMP],
          {"integrator": "verlet", "rate": 1000, "duration": 0.05}, gravity=DOWN,
          materials=[material(1e5), material(1e5, region=1, density=0.1)])
    scene("20_stiff_settles", "A gigapascal at 20 ms steps", "As stiff as plastic, in steps a thousand times too long for "
          "explicit methods: it has to settle where it belongs.", BAR, [CLAMP],
          {"integrator": "backward_euler", "step": 0.02, "duration": 2.0}, gravity=DOWN, materials=[material(1e9)])
    write_mesh("beam_2304", *six_a_cell([0.1, 0.02, 0.02], [24, 4, 4]))
    scene("21_nearly_incompressible", "Nearly incompressible", "Poisson's ratio 0.499 with averaged nodal pressure: it has to sag "
          "like 0.3 does and keep its volume.", {"file": "beam_2304.mesh"}, [CLAMP],
          {"integrator": "static", "element": "nodal_pressure", "tolerance": 1e-8}, gravity=[0, -9.8, 0],
          materials=[{"law": "neo_hookean_iso", "K1": 83388.9259, "kappa": 83333333.3, "density": 1000}])
    # One tetrahedron split in four by a node a thousandth of its height above a face: the body stays the same.
    whole = tets[len(tets) // 2]
    X = [nodes[n] for n in whole]
    inside = [sum((1 - 1e-3) / 3 * X[c][i] for c in range(3)) + 1e-3 * X[3][i] for i in range(3)]
    split = [whole[:c] + [len(nodes)] + whole[c + 1:] for c in range(4)]
    write_mesh("with_sliver", nodes + [inside], tets[:len(tets) // 2] + tets[len(tets) // 2 + 1:] + split)
    scene("22_sliver", "A sliver", "One element a thousandth as high as the others: explicit steps have to be shorter and "
          "`explain` says why; implicit ones must not notice.", {"file": "with_sliver.mesh"}, [CLAMP],
          {"integrator": "backward_euler", "step": 0.01, "duration": 0.3}, gravity=DOWN)


def what_people_do():
    steps = [{"at": round(0.1 + 0.004 * k, 3), "move": [round(0.1 + 0.04 * k, 3), 0.02, 0.02]} for k in (1, 2, 3)]
    scene("26_yanked", "Yanked at ten metres a second", "A corner is grasped, pulled more than a body's length away in 12 ms, held, and "
          "let go.", BAR, [CLAMP],
          {"integrator": "verlet", "rate": 250, "duration": 2.0, "damping": 20, "continuation": True, "recovery": True},
          events=[{"at": 0.1, "grasp": {"point": [0.1, 0.02, 0.02], "radius": 0.011}}, *steps, {"at": 0.2, "release": True}])
    scene("27_jittered_steps", "Steps of 1 to 40 ms", "Ticks of 40 ms that the study cuts where chance falls: the beam has to "
          "settle where it belongs.", BAR, [CLAMP],
          {"integrator": "backward_euler", "step": 0.04, "duration": 2.0, "damping": 10}, gravity=DOWN,
          materials=[material(1e5)])
    dice, left, cuts = random.Random(28), list(range(20 * 6 * 6 * 5)), []
    for k in range(20):
        gone = sorted(dice.sample(left, 50))
        left = [t for t in left if t not in set(gone)]
        cuts.append({"at": round(0.02 * (k + 1), 3), "remove": {"tets": gone}})
    scene("28_cut_away", "A thousand tetrahedra cut away", "Fifty at a time, at random, from a beam that swings: it loses their "
          "energy and no more.", box([0.1, 0.03, 0.03], [20, 6, 6]), [CLAMP],
          {"integrator": "verlet", "rate": 100, "duration": 0.5, "continuation": True}, gravity=DOWN,
          materials=[material(3e4)], events=cuts)
    switch = lambda at, law, **parameters: {"at": at, "material": {"law": law, "density": 1000, **parameters}}
    scene("29_law_switched", "Laws switched under load", "A beam that hangs becomes another tissue twice: it goes on from where it is, "
          "with the energy the new law gives that shape.", BAR, [CLAMP],
          {"integrator": "verlet", "rate": 500, "duration": 0.6, "continuation": True}, gravity=DOWN,
          events=[switch(0.2, "mooney_rivlin", K1=1500, K2=400, kappa=9000), switch(0.4, "neo_hookean", young=2e4, poisson=0.3)])


def sameness():
    for name, title, what in [
            ("30_permuted", "A beam in any order", "Nodes renumbered, elements rewound, all turned in space: the same motion."),
            ("31_other_units", "A beam in millimetres", "All lengths a thousand times as many: the same motion.")]:
        scene(name, title, what, BAR, [CLAMP], {"integrator": "verlet", "step": 2e-4, "duration": 0.05}, gravity=DOWN)
    scene("32_any_number_of_threads", "A beam for sixteen threads", "Pulled by a tool: the same bits for 1 to 16 threads.",
          box([0.1, 0.05, 0.05], [20, 10, 10]), [CLAMP], {"integrator": "verlet", "rate": 1000, "duration": 0.02}, gravity=DOWN,
          events=[{"at": 0, "grasp": {"point": [0.1, 0.05, 0.05], "radius": 0.02}}, {"at": 0.002, "move": [0.12, 0.06, 0.05]}])
    scene("33_soak", "A million steps", "A small bar swings without damping for a minute and a half.", SHORT_BAR, [CLAMP],
          {"integrator": "verlet", "step": 1e-4, "duration": 100.0}, gravity=DOWN, materials=[material(5e4)])


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    for make in (forces, statics_and_accuracy, starts, collapses, far_deformations, bad_bodies, what_people_do, sameness):
        make()
