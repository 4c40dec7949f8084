"""Reference values of Cook's membrane for `heml study validation` (engine/studies/validation/cook.cpp), by CalculiX (ccx):
20-node hexahedra with reduced integration, finite strain, neo-Hookean, dead traction. Prints the rise of the upper corner at half
the thickness for three meshes and their extrapolation, with the order p that they show: u = u* + b n^-p."""
import pathlib
import re
import subprocess
import tempfile

SHEAR, FORCE, MESHES = 4e3, 0.02, ((8, 2), (12, 3), (16, 4))  # Pa, N, elements a side and through the thickness
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
MIDDLES = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1),
           (0, 2, 1)]
ON_FACE = {(0, 0): -1 / 12, (2, 0): -1 / 12, (2, 2): -1 / 12, (0, 2): -1 / 12, (1, 0): 1 / 3, (2, 1): 1 / 3, (1, 2): 1 / 3,
           (0, 1): 1 / 3}  # consistent nodal forces of an even traction


def rise(n, layers, poisson):
    """m, of the upper corner."""
    bulk = 2 * SHEAR * (1 + poisson) / (3 * (1 - 2 * poisson))
    numbers, places, force = {}, [], {}

    def node(i, j, k):
        if (i, j, k) not in numbers:
            s, t = i / (2 * n), j / (2 * n)
            numbers[i, j, k] = len(places) + 1
            places.append((48e-3 * s, 44e-3 * s + t * (44e-3 - 28e-3 * s), k / (2 * layers) * 10e-3))
        return numbers[i, j, k]

    elements = [[node(2 * a + p, 2 * b + q, 2 * c + r) for p, q, r in CORNERS + MIDDLES]
                for a in range(n) for b in range(n) for c in range(layers)]
    for b in range(n):
        for c in range(layers):
            for (q, r), part in ON_FACE.items():
                at = numbers[2 * n, 2 * b + q, 2 * c + r]
                force[at] = force.get(at, 0) + part * FORCE / (n * layers)
    deck = ["*NODE"] + [f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for k, (x, y, z) in enumerate(places)]
    deck.append("*ELEMENT, TYPE=C3D20R, ELSET=BODY")
    for k, nodes in enumerate(elements):
        deck += [f"{k + 1}, " + ", ".join(map(str, nodes[:10])) + ",", ", ".join(map(str, nodes[10:]))]
    deck += ["*MATERIAL, NAME=RUBBER", "*HYPERELASTIC, NEO HOOKE", f"{SHEAR / 2:.15g}, {2 / bulk:.15g}",
             "*SOLID SECTION, ELSET=BODY, MATERIAL=RUBBER", "*BOUNDARY"]
    deck += [f"{at}, 1, 3" for (i, _, _), at in numbers.items() if i == 0]
    deck += ["*NSET, NSET=CORNER", str(numbers[2 * n, 2 * n, layers]), "*STEP, NLGEOM, INC=1000", "*STATIC", "0.25, 1.0", "*CLOAD"]
    deck += [f"{at}, 2, {part:.14g}" for at, part in force.items()]
    deck += ["*NODE PRINT, NSET=CORNER, FREQUENCY=1000", "U", "*END STEP"]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "cook.inp").write_text("\n".join(deck) + "\n")
        subprocess.run(["ccx", "cook"], cwd=folder, capture_output=True, check=True)
        last = (pathlib.Path(folder) / "cook.dat").read_text().strip().splitlines()[-1]
    return float(re.split(r"\s+", last.strip())[2])


def extrapolated(values):
    """The limit of three values, and the order."""
    sizes = [1 / n for n, _ in MESHES]
    ratio = (values[1] - values[0]) / (values[2] - values[1])
    low, high = 0.1, 6
    for _ in range(100):
        p = (low + high) / 2
        a, b, c = (size ** p for size in sizes)
        low, high = (low, p) if (a - b) / (b - c) > ratio else (p, high)
    return values[2] + (values[2] - values[1]) * c / (b - c), p


if __name__ == "__main__":
    for poisson in (0.3, 0.499):
        values = [rise(n, layers, poisson) for n, layers in MESHES]
        print(poisson, values, *extrapolated(values))
