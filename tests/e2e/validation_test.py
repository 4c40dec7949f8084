"""End-to-end tests of `heml study validation --quick`: rows, page, exit code, and a second run that takes up the first.
HEML_BINARY is the path of the program."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = os.environ["HEML_BINARY"]


def study(out):
    return subprocess.run([BINARY, "study", "validation", "--quick", "--out", str(out)], capture_output=True, text=True,
                          timeout=550)


class Validation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.out = pathlib.Path(folder.name) / "report"
        cls.done = study(cls.out)
        with open(cls.out / "rows.csv", newline="") as file:
            cls.rows = list(csv.DictReader(file))

    def test_the_exit_code_is_that_of_the_rows(self):
        missed = [row for row in self.rows if row["verdict"] in ("misses", "fails")]
        self.assertEqual(self.done.returncode, 1 if missed else 0, self.done.stderr)
        self.assertEqual(len(missed), self.done.stderr.count(", error "), self.done.stderr)

    def test_rows_say_what_they_compare(self):
        self.assertEqual({row["problem"] for row in self.rows}, {"sphere", "cylinder", "elastica", "cook", "relaxation", "creep",
                                                             "viscous_loop", "plastic_cycle", "hertz", "land_beam", "land_ventricle", "land_contraction"})
        for row in self.rows:
            error = abs(float(row["ours"]) / float(row["reference"]) - 1)
            self.assertAlmostEqual(float(row["error"]), error, places=12)
            self.assertTrue(row["source"])
            if row["limit"]:
                self.assertEqual(row["verdict"] == "holds", error <= float(row["limit"]))
            else:
                self.assertEqual(row["verdict"], "for comparison")

    def test_elements_without_locking_hold(self):
        for row in self.rows:
            if row["problem"] != "relaxation":
                self.assertIn(row["verdict"], ("holds", "for comparison"), row)

    def test_the_page_stands_alone(self):
        page = (self.out / "report.html").read_text()
        self.assertIn("</html>", page)
        self.assertEqual(page.count("data:image/png;base64"), 12)
        self.assertNotIn("<link", page)

    def test_a_second_run_takes_up_the_first(self):
        lines = (self.out / "results.jsonl").read_text()
        self.assertEqual(study(self.out).returncode, self.done.returncode)
        self.assertEqual((self.out / "results.jsonl").read_text(), lines)


if __name__ == "__main__":
    unittest.main()
