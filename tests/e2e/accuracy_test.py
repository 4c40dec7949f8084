"""End-to-end tests of `heml study accuracy` and `heml tune`. HEML_BINARY is the path of the program."""
import csv
import json
import shutil
import unittest

import program
from program import SOURCE, ProgramCase, beam

SCENE = beam(name="block", mesh={"box": {"size": [0.1, 0.02, 0.02], "cells": [4, 2, 2]}}, solver={"duration": 0.05},
             materials=[{"law": "mooney_rivlin", "K1": 15000, "K2": 2000, "kappa": 1e5}])


def heml(*arguments, **env):
    return program.heml(*arguments, env=env, timeout=550)


class Accuracy(ProgramCase):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.json", SCENE)

    def test_no_figure_of_the_quick_study_has_grown_and_the_check_can_fail(self):
        out = self.folder / "quick"
        done = heml("study", "accuracy", "--quick", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("within 16 ms a frame, the smallest error is", done.stdout)
        page = (out / "report.html").read_text()
        for text in ("Locking", "Laws", "gauges are worth", "What nothing tried beats", "data:image/png;base64,"):
            self.assertIn(text, page)
        for outside in ('src="http', "<link", "<script"):
            self.assertNotIn(outside, page, "nothing else is needed")
        rows = list(csv.DictReader((out / "runs.csv").open()))
        self.assertGreater(len(rows), 10)
        for field in ("cpu", "compiler", "commit", "threads", "time_error_m", "seconds_per_second"):
            self.assertTrue(all(row[field] for row in rows if not row["failed"]), field)
        # Halves the committed values, so that the same errors count as grown.
        assets = self.folder / "assets"
        shutil.copytree(SOURCE / "assets", assets)
        figures = assets / "studies" / "accuracy_quick.json"
        figures.write_text(json.dumps({name: value / 2 for name, value in json.loads(figures.read_text()).items()}))
        again = heml("study", "accuracy", "--quick", "--out", out, HEML_ASSETS=str(assets))
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn("was ", again.stderr)
        self.assertIn("Worse than before", (out / "report.html").read_text())

    def test_a_users_scene_is_studied_and_the_results_are_taken_up_again(self):
        out = self.folder / "own"
        done = heml("study", "accuracy", "--quick", "--scene", self.scene, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("block: within 16 ms a frame", done.stdout)
        lines = (out / "results.jsonl").read_text().splitlines()
        (out / "results.jsonl").write_text("\n".join(lines[:-2]) + "\n" + lines[-2][:40])  # interrupted
        table = (out / "runs.csv").read_text()
        self.assertEqual(heml("study", "accuracy", "--quick", "--scene", self.scene, "--out", out).returncode, 0)
        self.assertEqual(len((out / "results.jsonl").read_text().splitlines()), len(lines))
        self.assertEqual((out / "runs.csv").read_text(), table, "what was measured is not measured again")

    def test_tune_writes_a_scene_that_runs_and_says_what_it_gave_up(self):
        out = self.folder / "tuned.json"
        done = heml("tune", self.scene, "--within", "10s", "--quick", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("within 1e+04 ms a frame", done.stdout)
        self.assertIn("Given up", done.stdout)
        self.assertEqual(heml("solve", out, "--out", self.folder / "solved").returncode, 0)
        done = heml("tune", self.scene, "--error", "1nm", "--quick", "--out", self.folder / "no.json")
        self.assertEqual(done.returncode, 2, "nanometres are none of the units")
        done = heml("tune", self.scene, "--error", "0.001um", "--quick", "--out", self.folder / "no.json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("most exact", done.stderr)
        self.assertFalse((self.folder / "no.json").exists())

    def test_wrong_usage_and_scenes_without_steps(self):
        for arguments in (["--within", "16"], ["--within", "16mm"], [], ["--within", "16ms", "--error", "1mm"]):
            self.assertEqual(heml("tune", self.scene, *arguments).returncode, 2, arguments)
        self.scene.write_text(json.dumps({**SCENE, "solver": {"integrator": "static"}}))
        done = heml("tune", self.scene, "--within", "16ms", "--out", self.folder / "t.json")
        self.assertEqual(done.returncode, 3)
        self.assertIn("solver.integrator", done.stderr)
        self.assertEqual(heml("study", "accuracy", "--scene", "none.json", "--out", self.folder / "x").returncode, 3)


if __name__ == "__main__":
    unittest.main()
