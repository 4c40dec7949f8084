#!/usr/bin/env python3
"""Writes assets/meshes/ventricle.vtu and the scene of it: a left ventricle that beats.

    python3 assets/make/ventricle.py

The same files on every run. The wall is that of Land et al. 2015 (equations 2.7 to 2.12), a truncated ellipsoid, three and
a half times as large: a heart's size. Its fibres turn from the direction of the long axis inside by 180° through the wall.
"""
import math

from extreme import ASSETS, scene
import extreme

SIZE = 3.5e-3  # m, in place of the benchmark's 1 mm
BASE = 5.0  # height at which the ellipsoid is cut off, and below in the same units: axes inside, and thickness of the wall
ACROSS, ALONG, WALL = 7.0, 17.0, 3.0
CAP = 0.3  # part of the way from apex to base that the bottom of the cup becomes
SIDE, STOREYS, LAYERS = 6, 9, 2  # cells


def wall(t, s, azimuth):
    """A point at rest: t from 0 inside to 1 outside, s from 0 at the apex to 1 at the base; y is up."""
    across, along = ACROSS + WALL * t, ALONG + WALL * t
    u = math.pi + s * (math.acos(BASE / along) - math.pi)
    return (SIZE * across * math.sin(u) * math.cos(azimuth), SIZE * along * math.cos(u),
            -SIZE * across * math.sin(u) * math.sin(azimuth))


def fibre(x):
    """Direction at a point: its angle to the circumference goes from 90° inside to −90° outside."""
    inside, outside = -0.5, 1.5  # of t
    for _ in range(60):
        t = (inside + outside) / 2
        across, along = ACROSS + WALL * t, ALONG + WALL * t
        if math.hypot(x[0], x[2]) ** 2 / across ** 2 + x[1] ** 2 / along ** 2 > SIZE ** 2:
            inside = t
        else:
            outside = t
    u, v = math.acos(max(-1, min(1, x[1] / (SIZE * along)))), math.atan2(-x[2], x[0])
    up = (-across * math.cos(u) * math.cos(v), along * math.sin(u), across * math.cos(u) * math.sin(v))
    around = (-math.sin(v), 0, -math.cos(v))
    angle, length = math.pi * (0.5 - t), math.hypot(*up)
    return [math.sin(angle) * a / length + math.cos(angle) * b for a, b in zip(up, around)]


def from_side(i, j, up):
    """Of a cup of cubes: s and azimuth of place i, j in −1 to 1 on its bottom, or at a height on its rim."""
    # A side of the cube to a sphere (Nowell), of which it takes the cap below 45°.
    x, y = i * math.sqrt(0.5 - j * j / 6), j * math.sqrt(0.5 - i * i / 6)
    z = math.sqrt(max(0.0, 1 - i * i / 2 - j * j / 2 + i * i * j * j / 3))
    polar = math.atan2(math.hypot(x, y), z)
    s = CAP * polar / (math.pi / 4)
    return s + (1 - s) * up, math.atan2(y, x)


def cells():
    """Corners of the cells as (storey, i, j, layer): the bottom is storey 0, its rim goes up."""
    rim = [(i, 0) for i in range(SIDE)] + [(SIDE, j) for j in range(SIDE)]
    rim += [(i, SIDE) for i in range(SIDE, 0, -1)] + [(0, j) for j in range(SIDE, 0, -1)]
    for layer in range(LAYERS):
        for i in range(SIDE):
            for j in range(SIDE):
                quad = [(0, i, j), (0, i + 1, j), (0, i + 1, j + 1), (0, i, j + 1)]
                yield [(*c, layer) for c in quad] + [(*c, layer + 1) for c in quad]
        for storey in range(STOREYS):
            for a, b in zip(rim, rim[1:] + rim[:1]):
                quad = [(storey, *a), (storey, *b), (storey + 1, *b), (storey + 1, *a)]
                yield [(*c, layer) for c in quad] + [(*c, layer + 1) for c in quad]


FACES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def six_tets(cell):
    """Each face is split through its first node, so that neighbours agree: tetrahedra of the cell's first node with the
    triangles of the three faces that do not have it."""
    first = min(cell)
    for face in FACES:
        nodes = [cell[k] for k in face]
        if first in nodes:
            continue
        start = nodes.index(min(nodes))
        a, b, c, d = nodes[start:] + nodes[:start]
        yield [first, a, b, c]
        yield [first, a, c, d]


def make():
    numbers, nodes, tets = {}, [], []

    def number(corner):
        if corner not in numbers:
            storey, i, j, layer = corner
            numbers[corner] = len(nodes)
            nodes.append(wall(layer / LAYERS, *from_side(2 * i / SIDE - 1, 2 * j / SIDE - 1, storey / STOREYS)))
        return numbers[corner]

    for cell in cells():
        for tet in six_tets([number(corner) for corner in cell]):
            p = [nodes[n] for n in tet]
            e = [[p[k][c] - p[0][c] for c in range(3)] for k in (1, 2, 3)]
            volume = sum(e[0][k] * (e[1][k - 2] * e[2][k - 1] - e[1][k - 1] * e[2][k - 2]) for k in range(3))
            tets.append(tet if volume > 0 else [tet[0], tet[2], tet[1], tet[3]])
    return nodes, tets, [fibre([sum(nodes[n][c] for n in tet) / 4 for c in range(3)]) for tet in tets]


def write_vtu(file, nodes, tets, fibres):
    rows = lambda values, form: "\n".join(" ".join(form.format(c) for c in row) for row in values)
    array = lambda kind, name, more, text: f'<DataArray type="{kind}" Name="{name}"{more} format="ascii">\n{text}\n</DataArray>'
    three = ' NumberOfComponents="3"'
    count = len(tets)
    file.write_text("\n".join([
        '<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        f'<UnstructuredGrid><Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{count}">',
        "<Points>", array("Float64", "Points", three, rows(nodes, "{:.9g}")), "</Points>", "<Cells>",
        array("Int32", "connectivity", "", rows(tets, "{}")),
        array("Int32", "offsets", "", rows([range(4, 4 * count + 1, 4)], "{}")),
        array("UInt8", "types", "", rows([[10] * count], "{}")), "</Cells>",
        "<CellData>", array("Float64", "fibre", three, rows(fibres, "{:.6g}")), "</CellData>",
        "</Piece></UnstructuredGrid>", "</VTKFile>", ""]))


def beats(number, length=0.8, contraction=0.45, stress=5e4, parts=15):
    """Active stress over time: half a wave squared in each beat."""
    events = []
    for beat in range(number):
        for k in range(1, parts + 1):
            value = stress * math.sin(math.pi * k / parts) ** 2
            events.append({"at": round(beat * length + 0.1 + contraction * k / parts, 3), "active_stress": {"stress": round(value, 1)}})
    return events


def main():
    nodes, tets, fibres = make()
    write_vtu(ASSETS / "meshes" / "ventricle.vtu", nodes, tets, fibres)
    extreme.OUT = ASSETS / "scenes"
    height = round(SIZE * BASE, 9)
    scene("ventricle", "Left ventricle, beating", "Heart muscle whose fibres turn through the wall: as it contracts, the ventricle "
          "shortens and wrings itself. Active stress is a slider under Material.", {"file": "../meshes/ventricle.vtu"},
          [{"box": [[-1, height - 1e-6, -1], [1, 1, 1]], "fix": True}],
          {"integrator": "backward_euler", "rate": 60, "duration": 4.0, "damping": 2.0, "budget": {"iterations": 1}, "continuation": True, "recovery": True},
          materials=[{"law": "guccione", "C": 2000, "bf": 8, "bt": 2, "bfs": 4, "kappa": 1e5, "density": 1060,
                      "fibre": {"field": "fibre"}, "active_stress": 0}],
          view={"azimuth": 20, "elevation": 34, "zoom": 1.05}, events=beats(5))


if __name__ == "__main__":
    main()
