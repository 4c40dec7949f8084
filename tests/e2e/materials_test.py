"""End-to-end tests of `heml materials` and `heml bench-test`. HEML_BINARY is the path of the program."""
import csv
import json
import math
import random
import unittest

from program import ProgramCase, heml


def rows_of(path):
    with open(path) as file:
        table = list(csv.reader(file))
    return table[0], [[float(cell) for cell in row] for row in table[1:]]


class Materials(ProgramCase):
    def bench(self, material, *arguments, code=0):
        out = self.folder / "curve.csv"
        done = heml("bench-test", material, "--out", out, *arguments)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done, rows_of(out) if out.exists() else None

    def test_the_list_for_programs_holds_every_law_and_every_tissue(self):
        done = heml("materials", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = json.loads(done.stdout)
        laws = {law["name"]: law for law in listed["laws"]}
        for name in "stvk neo_hookean neo_hookean_iso mooney_rivlin fung_demiray ogden hgo mass_spring".split():
            self.assertIn(name, laws)
        for law in laws.values():
            for key in ("title", "formula", "source"):
                self.assertTrue(law[key], law)
            for parameter in law["parameters"]:
                self.assertTrue(parameter["name"] and parameter["meaning"], law)
        self.assertEqual([p["name"] for p in laws["ogden"]["parameters"] if p["list"]], ["mu", "alpha"])
        presets = {preset["name"]: preset for preset in listed["presets"]}
        brain = presets["brain_ogden"]
        self.assertEqual(brain["published"]["mu"], 670)
        self.assertEqual(brain["material"]["alpha"], [-19])
        self.assertEqual(brain["material"]["mu"], [2 * 670 / -19])
        self.assertAlmostEqual(brain["shear_modulus"], 670, places=6)
        for preset in presets.values():
            self.assertIn(preset["material"]["law"], laws)
            self.assertTrue(preset["source"]["authors"])
            self.assertFalse(preset["verified"])

    def test_the_list_for_people_fits_a_terminal_and_hides_nothing(self):
        done = heml("materials")
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in done.stdout.splitlines():
            marks = sum(0x300 <= ord(c) < 0x370 for c in line)
            self.assertLessEqual(len(line) - marks, 100, line)
        for law in json.loads(heml("materials", "--json").stdout)["laws"]:
            self.assertIn(f"  {law['name']}: ", done.stdout)
        words = " ".join(done.stdout.split())
        for text in ("doi:10.1098/rsta.2009.0091", "the values were not compared", "mu[0] -70.5263 Pa",
                     "0.7408 to 1.221"):
            self.assertIn(text, words)

    def test_curves_agree_with_the_textbook(self):
        K1 = 500
        material = self.write("m.json", {"law": "neo_hookean_iso", "K1": K1, "kappa": 1e10})
        for test, power in (("uniaxial", -2), ("equibiaxial", -5), ("planar", -3)):
            header, rows = self.bench(material, "--test", test, "--from", "0.6", "--to", "2", "--points", "15")[1]
            self.assertEqual(header, ["stretch", "nominal_stress_Pa", "cauchy_stress_Pa", "stretch_y", "stretch_z"])
            self.assertEqual(len(rows), 15)
            for stretch, nominal, cauchy, *_ in rows:
                expected = 2 * K1 * (stretch - stretch**power)
                self.assertAlmostEqual(nominal, expected, delta=1e-4 * K1)
                self.assertAlmostEqual(cauchy, stretch * expected, delta=1e-4 * K1)
        header, rows = self.bench(material, "--test", "shear")[1]
        self.assertEqual(header[0], "gamma")
        for gamma, nominal, *_ in rows:
            self.assertAlmostEqual(nominal, 2 * K1 * gamma, delta=1e-9 * K1)

    def test_relaxation_is_the_prony_series_of_the_held_stress(self):
        material = self.write("m.json", {"law": "neo_hookean_iso", "K1": 500, "kappa": 1e6,
                                         "relaxation": [{"gamma": 0.5, "tau": 0.1}, {"gamma": 0.25, "tau": 4}]})
        header, rows = self.bench(material, "--test", "relaxation", "--step-stretch", "1.2")[1]
        self.assertEqual(header[0], "time_s")
        self.assertEqual((rows[0][0], rows[-1][0]), (0, 20))
        held = rows[0][1] / 1.75
        for time, nominal, *_ in rows:
            expected = 1 + 0.5 * math.exp(-time / 0.1) + 0.25 * math.exp(-time / 4)
            self.assertAlmostEqual(nominal / held, expected, delta=1e-12)

    def test_a_tissue_is_tested_by_its_name_within_its_range(self):
        _, (_, rows) = self.bench("brain_ogden_swine", "--points", "5")
        self.assertAlmostEqual(rows[0][0], math.exp(-0.3), places=12)
        self.assertAlmostEqual(rows[-1][0], math.exp(0.2), places=12)
        self.assertLess(rows[0][1], 0)
        self.assertGreater(rows[-1][1], 0)

    def test_a_fit_finds_the_parameters_a_curve_was_made_with(self):
        truth = {"law": "fung_demiray", "mu": 1500.0, "gamma": 2.5, "kappa": 1e5}
        _, (_, rows) = self.bench(self.write("truth.json", truth), "--from", "0.8", "--to", "1.4", "--points", "25")
        noise = random.Random(5)
        data = "stretch,stress\n" + "".join(f"{r[0]!r},{r[1] * (1 + noise.gauss(0, 0.01))!r}\n" for r in rows)
        start = self.write("start.json", {**truth, "mu": 400.0, "gamma": 0.5, "density": 1060.0})
        done, _ = self.bench(start, "--data", self.write("data.csv", data), "--plot", self.folder / "curve.png")
        fitted = json.loads((self.folder / "curve.json").read_text())
        self.assertEqual((fitted["law"], fitted["kappa"], fitted["density"]), ("fung_demiray", 1e5, 1060.0))
        self.assertAlmostEqual(fitted["mu"] / 1500, 1, delta=0.05)
        self.assertAlmostEqual(fitted["gamma"] / 2.5, 1, delta=0.05)
        self.assertIn("standard error", done.stdout)
        self.assertIn("R² 0.99", done.stdout)
        picture = (self.folder / "curve.png").read_bytes()
        self.assertEqual((int.from_bytes(picture[16:20], "big"), int.from_bytes(picture[20:24], "big")), (1280, 800))
        # The program can read the fitted entry.
        self.bench(self.folder / "curve.json")
        # Without noise the fit is exact; parameters that simple shear cannot determine are reported.
        exact = "gamma,stress\n" + "".join(f"{g / 10},{2 * 700 * g / 10}\n" for g in range(-4, 5))
        mooney = self.write("mooney.json", {"law": "mooney_rivlin", "K1": 400.0, "K2": 100.0, "kappa": 1e5})
        done, _ = self.bench(mooney, "--test", "shear", "--data", self.write("exact.csv", exact))
        self.assertEqual(done.stdout.count("not determined by these data"), 2)
        fitted = json.loads((self.folder / "curve.json").read_text())
        self.assertAlmostEqual(fitted["K1"] + fitted["K2"], 700, delta=1e-6)

    def test_past_the_range_of_the_law_the_curve_ends_with_a_warning(self):
        material = self.write("m.json", {"law": "gent", "mu": 1e3, "Jm": 1.0, "kappa": 1e6})
        done, (_, rows) = self.bench(material, "--test", "shear", "--from", "0", "--to", "2", "--points", "21")
        self.assertAlmostEqual(rows[-1][0], 0.9, places=12)
        self.assertEqual(done.stderr.count("warning"), 1)

    def test_bad_input_is_one_message(self):
        good = self.write("m.json", {"law": "stvk", "young": 1e4, "poisson": 0.3})
        out = self.folder / "out.csv"

        def bench(*arguments):
            done = heml("bench-test", *arguments, "--out", out)
            self.assertFalse(out.exists(), arguments)
            return done

        self.assert_refused(bench("brain_ogdan"), 3, "brain_ogden")
        self.assert_refused(bench(self.folder / "missing.json"), 3, "missing.json")
        self.assert_refused(bench(self.write("bad.json", {"law": "stvk", "young": -1, "poisson": 0.3})), 3, "young")
        self.assert_refused(bench(good, "--data", self.write("d.csv", "stretch,stress\n1.1,x\n")), 3, "line 2")
        self.assert_refused(bench(good, "--data", self.write("d.csv", "1.1,2\n")), 3, "stretch,stress")
        self.assert_refused(bench(good, "--test", "relaxation"), 3, "relax")
        law = {"law": "stvk", "young": 1e4, "poisson": 0.3}
        muscle = self.write("muscle.json", law | {"active_stress": 100, "fibre": [1, 0, 0]})
        self.assert_refused(bench(muscle), 3, "muscle.json: active_stress: has no part in a material test")
        clay = self.write("clay.json", {"law": "neo_hookean_iso", "K1": 1e3, "kappa": 1e4, "plasticity": {"yield": 10}})
        self.assert_refused(bench(clay), 3, "clay.json: plasticity: has no part in a material test")
        springs = self.write("springs.json", {"law": "mass_spring", "stiffness": 10})
        self.assert_refused(bench(springs), 2, "mass_spring")
        for wrong in (["--test", "bending"], ["--points", "1"], ["--from", "2", "--to", "1"], ["--from", "-1"],
                      ["--test", "relaxation", "--step-stretch", "0"]):
            self.assert_refused(bench(good, *wrong), 2)
        self.assertEqual(heml("bench-test", good).returncode, 2)
        self.assert_refused(heml("bench-test", good, "--out", self.folder / "no" / "out.csv"), 3, "out.csv")
        data = self.write("d.csv", "stretch,stress\n1.1,5\n")
        self.assert_refused(heml("bench-test", good, "--out", self.folder / "c.json", "--data", data), 2, ".json")


if __name__ == "__main__":
    unittest.main()
