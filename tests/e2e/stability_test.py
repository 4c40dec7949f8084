"""End-to-end tests of `heml study stability --quick`: promises hold, the report is complete, an interrupted run
continues where it stopped, and a broken promise gives exit code 1. HEML_BINARY is the path of the program."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

BINARY = os.environ["HEML_BINARY"]
ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"


def study(out, *arguments, assets=ASSETS):
    return subprocess.run([BINARY, "study", "stability", "--out", str(out), *arguments], capture_output=True, text=True,
                          timeout=550, env={**os.environ, "HEML_ASSETS": str(assets)})


class Stability(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.out = cls.folder / "report"
        begin = time.monotonic()
        cls.done = study(cls.out, "--quick")
        cls.seconds = time.monotonic() - begin

    def cells(self):
        with open(self.out / "cells.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_what_is_promised_holds(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertIn("promised runs hold.", self.done.stdout)
        cells = self.cells()
        self.assertEqual({int(cell["number"]) for cell in cells}, set(range(1, 34)))
        for cell in cells:
            if cell["promise"]:
                self.assertEqual(cell["promise"], "promised")
                self.assertIn(cell["verdict"], ("stable", "recovered"))
                self.assertLessEqual(float(cell["figure"]), float(cell["limit"]))

    def test_the_report_stands_alone(self):
        page = (self.out / "report.html").read_text()
        self.assertIn("</html>", page)
        self.assertIn("<svg", page)
        self.assertNotIn("<link", page)
        self.assertNotIn("<script", page)
        self.assertIn("<svg", (self.out / "matrix.svg").read_text())

    def test_a_second_run_takes_up_the_first(self):
        lines = (self.out / "results.jsonl").read_text().splitlines()
        begin = time.monotonic()
        self.assertEqual(study(self.out, "--quick").returncode, 0)
        self.assertLess(time.monotonic() - begin, max(5, 0.3 * self.seconds))
        self.assertEqual((self.out / "results.jsonl").read_text().splitlines(), lines)

    def test_a_promise_that_is_not_kept_is_exit_1(self):
        assets = self.folder / "assets"
        shutil.copytree(ASSETS, assets)
        promises = json.loads((assets / "studies" / "promised.json").read_text())
        for promise in promises:
            if promise["case"] == 3:
                promise["limit"] = 1e-30
        (assets / "studies" / "promised.json").write_text(json.dumps(promises))
        done = study(self.out, "--quick", assets=assets)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("falls short of its promise: case 3", done.stderr)
        self.assertIn("Falls short: case 3", (self.out / "report.html").read_text())

    def test_what_it_does_not_know_is_exit_2(self):
        done = subprocess.run([BINARY, "study", "patience", "--out", str(self.folder / "x")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("stability", done.stderr)


if __name__ == "__main__":
    unittest.main()
