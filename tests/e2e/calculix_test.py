"""Compares static equilibria of `heml solve` with CalculiX (ccx) and fem_reference.py. HEML_BINARY is the path of the
program.

A block of irregular tetrahedra is fixed at one end; the other end is pulled and twisted. CalculiX's C3D4 is the same
element: linear, with one integration point.
"""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

os.environ.setdefault("OMP_NUM_THREADS", "1")  # matrices are small, and the machine is shared
try:
    import numpy as np
except ImportError:
    print("skipped: Python's numpy is not here (Debian: python3-numpy)")
    sys.exit(77)
if not shutil.which("ccx"):
    print("skipped: CalculiX is not here (Debian: calculix-ccx)")
    sys.exit(77)

import fem_reference

BINARY = os.environ["HEML_BINARY"]
SIZE, CELLS = (0.2, 0.12, 0.1), (5, 4, 3)
PULL, TWIST = (0.06, 0.01, 0.0), 40.0  # m, degrees about the block's centre

MATERIALS = {
    "neo_hookean_iso": {"law": "neo_hookean_iso", "K1": 500.0, "kappa": 2e4},
    "mooney_rivlin": {"law": "mooney_rivlin", "K1": 400.0, "K2": 150.0, "kappa": 2e4},
    "ogden": {"law": "ogden", "mu": [300.0, -200.0], "alpha": [3.0, -4.0], "kappa": 2e4},
}
OTHER_MATERIALS = {
    "stvk": {"law": "stvk", "lambda": 2e3, "mu": 1e3},
    "neo_hookean": {"law": "neo_hookean", "lambda": 9e3, "mu": 1e3},
    "fung_demiray": {"law": "fung_demiray", "mu": 1e3, "gamma": 0.8, "kappa": 2e4},
    "hgo": {"law": "hgo", "K1": 500.0, "kappa": 2e4, "k1": 800.0, "k2": 1.5, "fibre": [2.0, 1.0, -2.0]},
}
OTHER_MATERIALS |= {f"{law}, {term}": (MATERIALS | OTHER_MATERIALS)[law] | {"volume_term": term}
                    for law in ("mooney_rivlin", "ogden", "hgo") for term in ("logarithmic", "simo_taylor")}


def calculix_card(material):
    """CalculiX's *HYPERELASTIC card; its volume term is (J−1)²/D1, its Ogden term 2 μi/αi² (λ̄1^αi + …)."""
    m, D1 = material, 2 / material["kappa"]
    if m["law"] == "neo_hookean_iso":
        return f"*HYPERELASTIC, NEO HOOKE\n{m['K1']:.15g}, {D1:.15g}\n"
    if m["law"] == "mooney_rivlin":
        return f"*HYPERELASTIC, MOONEY-RIVLIN\n{m['K1']:.15g}, {m['K2']:.15g}, {D1:.15g}\n"
    terms = [f"{mu * alpha / 2:.15g}, {alpha:.15g}" for mu, alpha in zip(m["mu"], m["alpha"])]
    volume = [f"{D1:.15g}"] + ["1e30"] * (len(terms) - 1)  # switches off (J−1)⁴/D2 and higher terms
    return f"*HYPERELASTIC, OGDEN, N={len(terms)}\n{', '.join(terms + volume)}\n"


IN_TENTHS, AT_ONCE = "*STATIC, DIRECT\n0.1, 1.0", "*STATIC\n1.0, 1.0"  # CalculiX may cut the latter


def calculix_deck(nodes, tets, material, held, target, increments=IN_TENTHS, residual=1e-10, correction=1e-10):
    """CalculiX's input file. residual: convergence limit of the largest residual, relative to the average force;
    correction: that of the largest displacement correction, relative to the largest increment."""
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i + 1}, " + ", ".join(f"{x:.12g}" for x in node) for i, node in enumerate(nodes)]
    lines += ["*ELEMENT, TYPE=C3D4, ELSET=BODY"]
    lines += [f"{i + 1}, " + ", ".join(str(n + 1) for n in tet) for i, tet in enumerate(tets)]
    lines += ["*MATERIAL, NAME=TISSUE", calculix_card(material).rstrip(), "*SOLID SECTION, ELSET=BODY, MATERIAL=TISSUE"]
    lines += ["*STEP, NLGEOM, INC=1000", increments]
    lines += ["*CONTROLS, PARAMETERS=FIELD", f"{residual:g}, {correction:g}, , , , , , {residual:g}"]
    lines += ["*CONTROLS, PARAMETERS=TIME INCREMENTATION", "20, 40, 9, 60, 20, 4, , 10"]
    lines += ["*BOUNDARY"]
    for n in held:
        lines += [f"{n + 1}, {axis + 1}, {axis + 1}, {target[n][axis] - nodes[n][axis]:.14g}" for axis in range(3)]
    lines += ["*NODE PRINT, NSET=ALL, FREQUENCY=1000", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def run_calculix(folder, deck):
    """CalculiX's standard output; None if it has not converged."""
    (folder / "block.inp").write_text(deck)
    done = subprocess.run(["ccx", "block"], cwd=folder, capture_output=True, text=True, timeout=280)
    return None if done.returncode or "Job finished" not in done.stdout else done.stdout


def calculix(folder, nodes, tets, material, held, target):
    """Positions by CalculiX (#V×3, m), to the seven digits of displacements that it prints."""
    if not run_calculix(folder, calculix_deck(nodes, tets, material, held, target)):
        raise RuntimeError("CalculiX has not converged")
    text = (folder / "block.dat").read_text()
    last = text[text.rindex("displacements"):]
    number = r"\s+([-+.\dE]+)"
    rows = re.findall(r"^\s+(\d+)" + 3 * number + r"\s*$", last, re.MULTILINE)
    x = nodes.copy()
    for row in rows:
        x[int(row[0]) - 1] += [float(value) for value in row[1:]]
    assert len(rows) == len(nodes)
    return x


def mesh_file(nodes, tets):
    """The mesh in Gmsh format 2.2."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += [f"{i + 1} " + " ".join(f"{x:.12g}" for x in node) for i, node in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(tets))]
    lines += [f"{i + 1} 4 2 1 1 " + " ".join(str(n + 1) for n in tet) for i, tet in enumerate(tets)]
    return "\n".join(lines + ["$EndElements"]) + "\n"


class StaticEquilibrium(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.nodes, cls.tets = fem_reference.irregular_box(SIZE, CELLS, jitter=0.2, seed=7)
        cls.left = np.flatnonzero(cls.nodes[:, 0] == 0)
        cls.right = np.flatnonzero(cls.nodes[:, 0] == SIZE[0])
        cls.held = np.concatenate([cls.left, cls.right])
        middle, angle = np.array(SIZE) / 2, math.radians(TWIST)
        turn = np.array([[1, 0, 0], [0, math.cos(angle), -math.sin(angle)], [0, math.sin(angle), math.cos(angle)]])
        cls.target = cls.nodes.copy()
        cls.target[cls.right] = (cls.nodes[cls.right] - middle) @ turn.T + middle + PULL

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def largest_difference(self, x, y):
        """Largest distance of a node, relative to the largest displacement."""
        moved = np.linalg.norm(y - self.nodes, axis=1).max()
        return np.linalg.norm(x - y, axis=1).max() / moved

    def reference(self, material):
        """Positions and reactions by fem_reference.py."""
        body = fem_reference.Body(self.nodes, self.tets, material)
        x = fem_reference.equilibrium(body, self.held, self.target[self.held])
        gradient = body.gradient(x)
        return x, np.array([gradient[self.left].sum(axis=0), gradient[self.right].sum(axis=0)])

    def calculix(self, material):
        return calculix(self.folder, self.nodes, self.tets, material, self.held, self.target)

    def heml(self, material, tolerance=1e-11):
        """Positions and report of `heml solve`."""
        scene = {
            "schema_version": 1,
            "mesh": {"file": "block.msh"},
            "materials": [material],
            "boundary": [
                {"nodes": self.left.tolist(), "fix": True},
                {"nodes": self.right.tolist(), "translate": PULL,
                 "rotate": {"axis": [1, 0, 0], "origin": [x / 2 for x in SIZE], "degrees": TWIST}},
            ],
            "solver": {"integrator": "static", "tolerance": tolerance},
        }
        (self.folder / "block.msh").write_text(mesh_file(self.nodes, self.tets))
        (self.folder / "scene.json").write_text(json.dumps(scene))
        done = subprocess.run([BINARY, "solve", "scene.json", "--out", "out"], cwd=self.folder, capture_output=True,
                              text=True, timeout=280)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "out" / "positions.csv") as file:
            rows = list(csv.reader(file))
        report = json.loads((self.folder / "out" / "report.json").read_text())
        return np.array([[float(cell) for cell in row[1:]] for row in rows[1:]]), report

    def test_calculix_and_the_reference_agree_to_the_digits_it_prints(self):
        for name, material in MATERIALS.items():
            with self.subTest(name):
                x, _ = self.reference(material)
                self.assertLess(self.largest_difference(self.calculix(material), x), 2e-7)

    def test_heml_and_calculix_agree(self):
        for name, material in MATERIALS.items():
            with self.subTest(name):
                x, _ = self.heml(material)
                self.assertLess(self.largest_difference(x, self.calculix(material)), 2e-7)

    def test_heml_and_the_reference_agree(self):
        for name, material in (MATERIALS | OTHER_MATERIALS).items():
            with self.subTest(name):
                (x, report), (expected_x, expected) = self.heml(material), self.reference(material)
                reactions = np.array(report["reaction"])
                self.assertLess(self.largest_difference(x, expected_x), 1e-10)
                self.assertLess(np.linalg.norm(reactions - expected), 1e-9 * np.linalg.norm(expected))

    def test_heml_needs_no_more_iterations_than_calculix(self):
        """Both stop when no residual is above a millionth of CalculiX's average force. The tangent prediction of an
        increment counts as an iteration of heml; for CalculiX the better of both kinds of increments counts."""
        millionth = 1e-6
        for name, material in MATERIALS.items():
            with self.subTest(name):
                runs = []
                for increments in (IN_TENTHS, AT_ONCE):
                    deck = calculix_deck(self.nodes, self.tets, material, self.held, self.target, increments,
                                         residual=millionth, correction=1)
                    start = time.perf_counter()
                    said = run_calculix(self.folder, deck)
                    if said:
                        runs.append((len(re.findall(r"^ *iteration +\d+", said, re.MULTILINE)),
                                     time.perf_counter() - start,
                                     float(re.findall(r"average force= *(\S+)", said)[-1])))
                self.assertTrue(runs, "CalculiX has not converged")
                iterations, seconds, average_force = min(runs)
                x, _ = self.heml(material)
                gradient = fem_reference.Body(self.nodes, self.tets, material).gradient(x)
                carried = np.linalg.norm(gradient[self.held])
                start = time.perf_counter()
                _, report = self.heml(material, millionth * average_force / carried)
                ours = report["iterations"] + report["steps"]
                print(f"{name}: heml {ours} iterations, {time.perf_counter() - start:.3f} s; "
                      f"CalculiX {iterations}, {seconds:.3f} s")
                self.assertLessEqual(ours, iterations)


if __name__ == "__main__":
    unittest.main()
