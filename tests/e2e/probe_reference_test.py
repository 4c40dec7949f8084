"""Compares `heml probe` with law_formulas.py, the laws in 70 digits. HEML_BINARY is the path of the program."""
import csv
import json
import math
import os
import random
import sys
import unittest

try:
    from mpmath import mpf
except ImportError:
    print("skipped: Python's mpmath is not here (Debian: python3-mpmath)")
    sys.exit(77)

from law_formulas import LAWS, VOLUME_TERMS, fibre_stretch, materials, norm, numbers, product, reference
from program import ProgramCase, heml

HEADER = [prefix + i + j for prefix in ("F", "dF") for i in "123" for j in "123"]
IDENTITY = [1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0]


def stiffness(material):
    """Approximate stiffness, Pa: the rounding error of stress is this times that of F."""
    return sum(abs(x) for key, value in material.items() if key not in ("law", "fibre", "volume_term", "alpha", "Jm")
               for x in (value if isinstance(value, list) else [value]))


# ---- States. ----

def rotation(r):
    """A random rotation (9 floats), from a unit quaternion."""
    q = [r.gauss(0, 1) for _ in range(4)]
    n = math.sqrt(sum(x * x for x in q))
    w, x, y, z = (a / n for a in q)
    return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]


def turned(stretches, r):
    diagonal = [stretches[0], 0, 0, 0, stretches[1], 0, 0, 0, stretches[2]]
    return product(product(rotation(r), diagonal), rotation(r))


def of_volume(J, stretches):
    size = (J / (stretches[0] * stretches[1] * stretches[2])) ** (1 / 3)
    return [s * size for s in stretches]


def states(r):
    """Yields names for messages and F (9 floats)."""
    yield "rest", IDENTITY
    yield "pure stretches", [1.5, 0, 0, 0, 0.8, 0, 0, 0, 1.1]
    for _ in range(4):
        yield "a rotation", rotation(r)
    for size in (1e-1, 1e-3, 1e-5, 1e-7):
        for _ in range(3):
            yield f"within {size} of rest", [f + r.uniform(-size, size) for f in IDENTITY]
    for _ in range(20):
        yield "stretches to 5", turned(of_volume(r.uniform(0.5, 3), [r.uniform(0.4, 5) for _ in range(3)]), r)
    for stretches in ([5, 0.5, 0.6], [5, 4.9, 0.1], [0.2, 2, 2.5]):
        yield f"stretches {stretches}", turned(stretches, r)
    for apart in (0, 1e-12, 1e-9, 1e-6, 1e-3):
        for _ in range(2):
            s, t = r.uniform(0.5, 2.5), r.uniform(0.5, 2.5)
            yield f"two stretches {apart} apart", turned([s, s * (1 + apart), t], r)
            yield f"three stretches {apart} apart", turned([t, t * (1 + apart), t * (1 - apart / 2)], r)
    for s, t in ((2, 2), (0.6, 0.6), (1.7, 0.5)):
        yield "equal stretches exactly", [s, 0, 0, 0, s, 0, 0, 0, t]
    for J in (0.05, 0.1, 0.2, 0.5, 1, 2, 3):
        for _ in range(3):
            yield f"J = {J}", turned(of_volume(J, [r.uniform(0.7, 1.4) for _ in range(3)]), r)


class Probe(ProgramCase):
    def probe(self, material, rows):
        """Runs `heml probe` on rows of 18 numbers; returns the completed process and its table without the header."""
        (self.folder / "material.json").write_text(json.dumps(material | {"density": 1000}))
        with open(self.folder / "in.csv", "w", newline="") as file:
            csv.writer(file).writerows([HEADER] + [[repr(float(x)) for x in row] for row in rows])
        out = self.folder / "out.csv"
        done = heml("probe", self.folder / "material.json", "--F", self.folder / "in.csv", "--out", out)
        table = list(csv.reader(out.read_text().splitlines())) if out.exists() else [[]]
        if done.returncode == 0:
            self.assertEqual(",".join(table[0]), "W," + ",".join(HEADER).replace("F", "P"))
        return done, [[float(cell) for cell in row] for row in table[1:]]

    def compare(self, material, named_rows, r):
        rows = [(name, list(map(float, F)), [r.uniform(-1, 1) for _ in range(9)]) for name, F in named_rows]
        done, table = self.probe(material, [F + dF for _, F, dF in rows])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(table), len(rows))
        modulus = stiffness(material)
        for (name, F, dF), row in zip(rows, table):
            W, P, dP = reference(material, F, dF)
            with self.subTest(name, material=material, F=F):
                self.assertTrue(all(map(math.isfinite, row)), row)
                for what, values, expected in (("W", row[:1], [W]), ("P", row[1:10], P), ("dP", row[10:], dP)):
                    error = norm([v - e for v, e in zip(values, expected)])
                    worst = WORST.setdefault(material["law"], {"W": 0.0, "P": 0.0, "dP": 0.0})
                    worst[what] = max(worst[what], float(error / (norm(expected) + modulus / 100)))
                    self.assertLessEqual(error, 1e-11 * norm(expected) + 1e-14 * modulus, what)

    def test_every_law_the_program_lists_has_a_formula_here(self):
        listed = {entry["name"] for entry in json.loads(heml("materials", "--json").stdout)["laws"]}
        self.assertEqual(listed - {"mass_spring"}, set(LAWS))

    def test_young_and_poisson_are_lames_parameters(self):
        young, poisson = 1e4, 0.45
        F = [1.2, 0.1, 0, 0, 0.9, -0.2, 0.05, 0, 1.1]
        for law in ("stvk", "neo_hookean"):
            _, given = self.probe({"law": law, "young": young, "poisson": poisson}, [F + F])
            lame = {"law": law, "lambda": young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
                    "mu": young / (2 * (1 + poisson))}
            W, P, _ = reference(lame, F, F)
            self.assertLess(abs(given[0][0] / W - 1), 1e-13)
            self.assertLess(norm([a - b for a, b in zip(given[0][1:10], P)]), 1e-13 * norm(P))

    def test_other_volume_terms_agree_with_their_formulas(self):
        r = random.Random("volume terms")
        for term in VOLUME_TERMS:
            for law in ("mooney_rivlin", "ogden", "hgo"):
                material = materials(law, r)[1] | {"volume_term": term}
                self.compare(material, list(states(r))[::4], r)

    def test_inverted_states_of_laws_without_a_logarithm_take_the_cube_root_of_one_over_J_squared(self):
        r = random.Random("inverted")
        for law in ("stvk", "neo_hookean_iso", "mooney_rivlin", "ogden", "paper_neo_hookean", "paper_mooney_rivlin"):
            rows = [("inverted", turned([0.7, 1.1, -r.uniform(0.3, 1.5)], r)) for _ in range(5)]
            self.compare(materials(law, r)[0], rows, r)

    def test_at_rest_fibres_bear_nothing_whichever_way_they_lie(self):
        r = random.Random("fibres at rest")
        for _ in range(20):
            material = materials("hgo", r)[0]
            self.compare(material, [("rest", IDENTITY)], r)

    def assert_outside(self, material, *outside):
        """Expects rows of nan for these states, values for the rest state before and after them, a warning, exit 0."""
        done, table = self.probe(material, [F + IDENTITY for F in (IDENTITY, *outside, IDENTITY)])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("warning"), 1, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for k, row in enumerate(table):
            self.assertEqual(len(row), 19)
            inside = k in (0, len(table) - 1)
            self.assertTrue(all((math.isfinite if inside else math.isnan)(value) for value in row), (k, row))

    def test_states_outside_the_range_of_a_law_are_rows_of_nan_and_one_warning(self):
        flat, inverted = [1, 0, 0, 0, 1, 0, 0, 0, 0], [1, 0, 0, 0, 1, 0, 0, 0, -1]
        far, farther = [100, 0, 0, 0, 0.1, 0, 0, 0, 0.1], [1e160, 0, 0, 0, 1, 0, 0, 0, 1]
        r = random.Random("outside")
        self.assert_outside({"law": "neo_hookean", "young": 1e4, "poisson": 0.45}, flat, inverted, farther)
        self.assert_outside({"law": "fung_demiray", "mu": 1e3, "gamma": 1.5, "kappa": 1e5}, flat, far, farther)
        self.assert_outside({"law": "hgo", "K1": 1e3, "kappa": 1e5, "k1": 1e3, "k2": 2, "fibre": [1, 0, 0]}, flat, far)
        self.assert_outside({"law": "gent", "mu": 1e3, "Jm": 20, "kappa": 1e5}, flat, far)
        self.assert_outside({"law": "stvk", "young": 1e4, "poisson": 0.45}, farther)
        for law in ("neo_hookean_iso", "mooney_rivlin", "ogden", "yeoh", "veronda_westmann"):
            self.assert_outside(materials(law, r)[0], flat, farther)

    def test_up_to_where_an_exponential_overflows_rows_are_numbers_or_nan_throughout(self):
        material = {"law": "hgo", "K1": 1e3, "kappa": 1e5, "k1": 1e3, "k2": 2, "fibre": [1, 0, 0]}
        rows = [[s, 0, 0, 0, s**-0.5, 0, 0, 0, s**-0.5] + IDENTITY for s in (1 + k / 200 for k in range(1000))]
        done, table = self.probe(material, rows)
        self.assertEqual(done.returncode, 0, done.stderr)
        for row in table:
            self.assertTrue(all(map(math.isfinite, row)) or all(map(math.isnan, row)), row)

    def test_mass_springs_have_no_energy_of_F_to_probe(self):
        done, _ = self.probe({"law": "mass_spring", "stiffness": 10}, [IDENTITY + IDENTITY])
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("error"), 1, done.stderr)


WORST = {}  # largest errors by law, relative to the value plus one per cent of the modulus


def law_test(law):
    def test(self):
        r = random.Random("probe of " + law)
        for k, material in enumerate(materials(law, r)):
            m = numbers(material)
            rows = [(name, F) for name, F in states(r) if LAWS[law].in_range(m, [mpf(f) for f in F])]
            self.assertGreater(len(rows), 70)
            every = 1 if k == 0 or "HEML_LONG" in os.environ else 3  # all states take seconds a material
            self.compare(material, rows[::every], r)
    return test


for _law in LAWS:
    setattr(Probe, f"test_{_law}_agrees_with_its_formula", law_test(_law))


def tearDownModule():
    print("largest differences, relative to the number and 1 % of the modulus:", file=sys.stderr)
    for law, worst in WORST.items():
        print(f"  {law:20}", *(f"{what} {value:.1e}" for what, value in worst.items()), file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
