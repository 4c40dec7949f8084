"""Laws by expression from outside: what is refused and where, warnings, and runs against the same laws of their own
types. Python's standard library."""
import csv
import json
import math
import random
import unittest

from program import ProgramCase, beam, heml

LAW = {"law": "energy", "expression": "C1*(I1b-3) + kappa/2*(J-1)^2", "parameters": {"C1": 1500, "kappa": 1e5}}
SAME = {"law": "neo_hookean_iso", "K1": 1500, "kappa": 1e5}
HEADER = ["F" + i + j for i in "123" for j in "123"]


class Expressions(ProgramCase):
    def probe(self, material, states):
        path = self.write("material.json", material)
        with open(self.folder / "in.csv", "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([HEADER] + states)
        done = heml("probe", path, "--F", self.folder / "in.csv", "--out", self.folder / "out.csv")
        rows = []
        if done.returncode == 0:
            with open(self.folder / "out.csv", encoding="utf-8") as file:
                rows = [[float(x) for x in row] for row in list(csv.reader(file))[1:]]
        return done, rows

    def test_errors_name_the_column(self):
        for expression, column in (("C1*(I1b-3", 10), ("C1*(I1b-3) + kapa", 14), ("C1*kappa*I1 +* 2", 14),
                                   ("C1*kappa*1e999", 10), ("C1 ^^ kappa", 5), ("", 1), ("(" * 5000, 100)):
            done, _ = self.probe(LAW | {"expression": expression}, [[1, 0, 0, 0, 1, 0, 0, 0, 1]])
            self.assert_refused(done, 3, "expression", "column")
            if column < 100:
                self.assertIn(f"column {column}:", done.stderr, expression)

    def test_names(self):
        for parameters, word in (({"C1": 1, "kappa": 1, "I1": 2}, "reserved"), ({"C1": 1, "kappa": 1, "x": 2}, "not used"),
                                 ({"C1": 1}, "kappa"), ({"C1": 1, "kappa": "a"}, "kappa"), ({"C1": 1, "kappa": 1, "exp": 1}, "exp"),
                                 ([1], "parameters")):
            done, _ = self.probe(LAW | {"parameters": parameters}, [])
            self.assert_refused(done, 3, word)
        done, _ = self.probe({"law": "energy", "parameters": {}}, [])
        self.assert_refused(done, 3, "expression")
        done, _ = self.probe(LAW | {"kappa": 3}, [])
        self.assert_refused(done, 3, "kappa")
        done, _ = self.probe(SAME | {"expression": "I1"}, [])
        self.assert_refused(done, 3, "expression")

    def test_fibre(self):
        material = {"law": "energy", "expression": "I1 + (I4-1)^2"}
        self.assert_refused(self.probe(material, [])[0], 3, "fibre")
        self.assert_refused(self.probe(material | {"fibre": [0, 0, 0]}, [])[0], 3, "fibre")
        done, rows = self.probe(material | {"fibre": [2, 0, 0]}, [[2, 0, 0, 0, 1, 0, 0, 0, 1]])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(rows[0][0], 6 + 9)
        self.assertEqual(self.probe(LAW | {"fibre": [1, 0, 0]}, [[1, 0, 0, 0, 1, 0, 0, 0, 1]])[0].returncode, 0)  # unused, as in the example

    def test_out_of_range_is_nan_and_one_warning(self):
        done, rows = self.probe(LAW, [[1, 0, 0, 0, 1, 0, 0, 0, 1], [-1, 0, 0, 0, 1, 0, 0, 0, 1]])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertTrue(all(abs(x) < 1e-9 for x in rows[0]))
        self.assertTrue(all(math.isnan(x) for x in rows[1]))
        done, rows = self.probe({"law": "energy", "expression": "I1 + 1/(I2-3)"}, [[1, 0, 0, 0, 1, 0, 0, 0, 1]])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(all(math.isnan(x) for x in rows[0]))

    def test_stress_at_rest_warns(self):
        done, _ = self.probe({"law": "energy", "expression": "100*I1 + 1000*(J-1)^2"}, [[1, 0, 0, 0, 1, 0, 0, 0, 1]])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stress at rest", done.stderr)

    def test_values_are_those_of_its_own_type(self):
        r = random.Random(4)
        states = [[(i % 4 == 0) + r.uniform(-0.3, 0.3) for i in range(9)] for _ in range(50)]
        one, two = self.probe(LAW, states)[1], self.probe(SAME, states)[1]
        for a, b in zip(one, two):
            for x, y in zip(a, b):
                self.assertTrue(x == y or abs(x - y) < 1e-10 * (abs(y) + 1e5) or math.isnan(x), (x, y))

    def solve(self, **changes):
        scene = self.write("scene.json", beam(**changes))
        done = heml("solve", scene, "--out", self.folder / "out")
        if done.returncode:
            return done, None, None
        with open(self.folder / "out/positions.csv", encoding="utf-8") as file:
            nodes = [[float(x) for x in row] for row in list(csv.reader(file))[1:]]
        return done, nodes, json.loads((self.folder / "out/report.json").read_text())

    def test_runs_as_its_own_type(self):
        stretches = {"law": "energy", "expression": "C1*(l1b^2+l2b^2+l3b^2-3) + kappa/2*(J-1)^2",
                     "parameters": LAW["parameters"]}
        for solver in ({"integrator": "static"}, {"duration": 0.02, "step": 1e-4},
                       {"integrator": "backward_euler", "duration": 0.02, "step": 1e-3},
                       {"duration": 0.02, "step": 1e-4, "precision": "float"}):
            _, expected, _ = self.solve(materials=[SAME], solver=solver)
            for law in (LAW, stretches):
                done, nodes, report = self.solve(materials=[law], solver=solver)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(report["converged"])
                worst = max(abs(x - y) for a, b in zip(nodes, expected) for x, y in zip(a[1:], b[1:]))
                self.assertLess(worst, 2e-5 if "precision" in solver else 2e-8, (solver, law))

    def test_scenes_that_cannot_be(self):
        for solver, word in (({"continuation": True}, "continuation"), ({"element": "nodal_pressure"}, "volume term")):
            done, _, _ = self.solve(materials=[LAW], solver=solver)
            self.assert_refused(done, 3, word)
        for more in ({"volume_term": "logarithmic"}, {"relaxation": [{"gamma": 1, "tau": 1}]}, {"plasticity": {"yield": 1}}):
            self.assert_refused(self.solve(materials=[LAW | more])[0], 3)
        done, _, _ = self.solve(materials=[LAW | {"expression": "C1*kappa*log(J-1)"}])
        self.assert_refused(done, 3, "rest")

    def test_other_commands_know_it(self):
        scene = self.write("scene.json", beam(materials=[LAW], events=[{"step": 5, "material": LAW | {"parameters": {
            "C1": 2000, "kappa": 1e5}}}]))
        explained = heml("explain", scene, "--json")
        self.assertEqual(explained.returncode, 0, explained.stderr)
        self.assertEqual(json.loads(explained.stdout)["materials"][0]["law"], "energy")
        self.assertEqual(heml("solve", scene, "--out", self.folder / "out").returncode, 0)
        listed = heml("materials")
        self.assertIn("I1b", listed.stdout)


if __name__ == "__main__":
    unittest.main()
