"""`heml fit`: numbers of a scene from measured places of its nodes."""

import json
import tempfile
import unittest
from pathlib import Path

from program import heml

SCENE = {
    "schema_version": 1,
    "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [6, 2, 2]}},
    "materials": [{"law": "neo_hookean", "young": 9000, "poisson": 0.4, "density": 1000}],
    "boundary": [{"box": [[-1, -1, -1], [0, 1, 1]], "fix": True}],
    "gravity": [0, -9.81, 0],
    "solver": {"integrator": "static", "threads": 1},
}


class Fit(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.write("truth.json", SCENE)
        softer = json.loads(json.dumps(SCENE))
        softer["materials"][0]["young"] = 6000
        self.write("scene.json", softer)
        solved = heml("solve", "truth.json", "--out", "solved", cwd=self.folder)
        self.assertEqual(solved.returncode, 0, solved.stderr)
        rows = (self.folder / "solved/positions.csv").read_text().split()[1:]
        self.places = [",".join(row.split(",")[:4]) for row in rows]
        (self.folder / "places.csv").write_text("node,x,y,z\n" + "\n".join(self.places[::3]) + "\n")

    def write(self, name, scene):
        (self.folder / name).write_text(json.dumps(scene))

    def fit(self, *arguments):
        return heml("fit", "scene.json", "--data", "places.csv", *arguments, cwd=self.folder)

    def test_the_modulus_of_a_solved_scene_is_found_and_written(self):
        done = self.fit("--parameter", "materials[0].young")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("95 % confidence", done.stdout)
        fitted = json.loads((self.folder / "scene_fitted.json").read_text())
        material = fitted["materials"][0]
        young = material.get("young") or material["mu"] * (3 * material["lambda"] + 2 * material["mu"]) / (
            material["lambda"] + material["mu"])
        self.assertAlmostEqual(young / 9000, 1, places=5)
        self.assertEqual(heml("solve", "scene_fitted.json", "--out", "again", cwd=self.folder).returncode, 0)

    def test_a_start_and_several_numbers_are_given(self):
        done = self.fit("--parameter", "materials[0].young=20000", "--parameter", "materials[0].poisson=0.3",
                        "--out", "fitted.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len([line for line in done.stdout.splitlines() if line.startswith("materials[0]")]), 2)

    def test_wrong_use_and_bad_tables_say_what_to_do(self):
        self.assertEqual(self.fit().returncode, 2)
        self.assertEqual(self.fit("--parameter", "materials[0].young=soft").returncode, 2)
        done = self.fit("--parameter", "materials[0].young", "--parameter", "materials[0].young=2e4")
        self.assertEqual(done.returncode, 2)
        self.assertIn("materials[0].young: is given twice", done.stderr)
        done = self.fit("--parameter", "materials[0].colour")
        self.assertEqual(done.returncode, 3)
        self.assertIn("materials[0].colour", done.stderr)
        (self.folder / "places.csv").write_text("node,x,y,z\n9999,0,0,0\n")
        done = self.fit("--parameter", "materials[0].young")
        self.assertEqual(done.returncode, 3)
        self.assertIn("no node 9999", done.stderr)


if __name__ == "__main__":
    unittest.main()
