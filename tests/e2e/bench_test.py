"""End-to-end tests of `heml bench`: rows, tables, pictures, errors. No times are compared. HEML_BINARY is the path of
the program."""
import json
import os
import unittest

from program import ProgramCase, heml

FIELDS = "suite name mesh nodes tets law precision isa threads median min unit".split()
UNITS = {"paper": {"ms", "operations"}, "kernel": {"ns/tet"}, "step": {"ms"}, "terms": {"ms"}, "threads": {"ms"},
         "roofline": {"GB/s", "GFLOP/s"}}


def bench(*arguments):
    return heml("bench", *arguments)


def tables_in(text):
    """The Markdown tables of a text, each a list of its lines."""
    tables = [[]]
    for line in text.splitlines():
        if line.startswith("|"):
            tables[-1].append(line)
        elif tables[-1]:
            tables.append([])
    return [table for table in tables if table]


class Bench(ProgramCase):
    def rows_of(self, suite, *more):
        done = bench(suite, "--quick", "--json", self.folder / "rows.json", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads((self.folder / "rows.json").read_text())
        self.assertTrue(rows)
        for row in rows:
            for field in FIELDS:
                self.assertIn(field, row)
            self.assertEqual(row["suite"], suite)
            self.assertIn(row["unit"], UNITS[suite])
            self.assertGreater(row["min"], 0)
            self.assertLessEqual(row["min"], row["median"])
        self.tables = tables_in(done.stdout)
        for table in self.tables:
            self.assertEqual(len({len(line) for line in table}), 1, "columns are aligned")
        lines = {"kernel": [len({(row["mesh"], row["law"]) for row in rows})], "step": [len(rows)]}
        if suite in lines:
            self.assertEqual([len(table) - 2 for table in self.tables], lines[suite], "under a heading")
        return rows

    def test_kernel_has_every_law_in_every_way_and_the_naive_loop(self):
        rows = self.rows_of("kernel", "--out", self.folder / "pictures")
        laws = json.loads(heml("materials", "--json").stdout)["laws"]
        self.assertEqual({row["law"] for row in rows}, {law["name"] for law in laws})
        for row in rows:
            self.assertEqual("ratio_to_naive" in row, row["name"] == "force")
        naive = {(row["mesh"], row["law"]): row["min"] for row in rows if row["name"] == "naive force"}
        for row in rows:
            if row["name"] == "force":
                self.assertAlmostEqual(row["ratio_to_naive"] * row["min"] / naive[row["mesh"], row["law"]], 1, delta=1e-9)
        self.assertEqual({row["precision"] for row in rows}, {"double", "float"})
        self.assertTrue((self.folder / "pictures" / "ratios.png").read_bytes().startswith(b"\x89PNG"))

    def test_paper_stands_beside_what_was_printed(self):
        rows = self.rows_of("paper", "--out", self.folder / "pictures")
        printed = {(row["mesh"], row["name"]): row["printed"] for row in rows if row["unit"] == "operations" and "printed" in row}
        self.assertEqual(printed["Uterus", "Mass-Tensor"], 318707e3)
        self.assertEqual(printed["Reg. Cube1", "HEML"], 70e3)
        sizes = {row["mesh"]: (row["nodes"], row["tets"]) for row in rows}
        self.assertEqual(sizes["Reg. Cube1"], (125, 320))
        self.assertEqual(sizes["Reg. Cube2"], (1000, 3645))
        self.assertEqual([len(table) - 2 for table in self.tables[:2]], [5, 5], "Tables 3 and 2")
        of_stvk = [row for row in rows if row["unit"] == "operations" and row["law"] == "stvk"]
        counts = {(row["mesh"], row["name"]): row["median"] for row in of_stvk}
        laws = {row["law"]: row["a_tetrahedron"] for row in rows if "a_tetrahedron" in row}
        known = json.loads(heml("materials", "--json").stdout)["laws"]
        self.assertEqual(set(laws), {law["name"] for law in known if law["is_continuum"]})
        self.assertAlmostEqual(sum(laws["stvk"][:2]), counts["Reg. Cube1", "HEML"] / 320, delta=1e-9)
        for mesh in sizes:
            self.assertGreater(counts[mesh, "Mass-Tensor"], counts[mesh, "Mass-Tensor, no zeros"])
            self.assertGreater(counts[mesh, "Mass-Tensor, no zeros"], counts[mesh, "HEML"])
        carried = [row for row in rows if "error_when_carried" in row]
        self.assertEqual({(row["name"], row["precision"]) for row in carried},
                         {(name, precision) for name in ("HEML", "Mass-Tensor") for precision in ("double", "float")})
        self.assertTrue((self.folder / "pictures" / "carried.png").read_bytes().startswith(b"\x89PNG"))

    def test_step_and_roofline_say_what_they_reach(self):
        rows = self.rows_of("step")
        for row in rows:
            self.assertNotIn("halted", row)
        steps = [row for row in rows if "naive_evaluations" in row]
        self.assertEqual({row["name"].split(",")[0] for row in steps}, {"symplectic_euler", "verlet", "backward_euler"})
        for row in steps:
            self.assertEqual("ratio_to_naive" in row, row["name"].split(",")[0] != "backward_euler")
        names = {row["name"] for row in rows}
        self.assertTrue({"cut, layout updated", "cut, layout rebuilt", "removal, whole command"} <= names)
        self.assertTrue({"factor of the stiffness", "solution with the factor"} <= names)
        for what in ("forces", "verlet", "backward_euler, 1 iteration"):
            linear, *quadratic = (row for row in rows if row["name"].startswith(what + ", p"))
            self.assertEqual([row["name"] for row in quadratic], [what + ", p2", what + ", p2_pressure"])
            for row in quadratic:
                self.assertEqual((row["nodes"], 8 * row["tets"]), (linear["nodes"], linear["tets"]), "on the same nodes")
                self.assertAlmostEqual(row["to_linear"] * linear["min"], row["min"], delta=1e-9)
        rows = self.rows_of("roofline")
        self.assertTrue({"peak arithmetic", "triad DRAM", "force"} <= {row["name"] for row in rows})
        for row in rows:
            if row["name"] == "force":
                self.assertGreater(row["bytes_per_tet"], 0)
                self.assertGreater(row["operations_per_tet"], 0)

    def test_terms_stand_beside_the_law_alone(self):
        rows = self.rows_of("terms")
        names = [row["name"] for row in rows if row["precision"] == "float"]
        self.assertEqual(names, [row["name"] for row in rows if row["precision"] == "double"])
        self.assertEqual(names[0], "verlet, law alone")
        linear, quadratic = names[:len(names) // 2], names[len(names) // 2:]
        self.assertEqual(quadratic, [name.replace("verlet, ", "verlet, p2, ") for name in linear])
        self.assertTrue({"verlet, viscosity", "verlet, relaxation", "verlet, nodal pressure"} <= set(linear))
        for row in rows:
            self.assertEqual(row["times_the_law_alone"] == 1, row["name"].endswith("law alone"))

    def test_threads_is_timed_with_each_number_of_them_idle_and_loaded(self):
        kinds = {}
        for row in self.rows_of("threads"):
            kinds.setdefault((row["mesh"], row["precision"], row["name"]), []).append(row)
        self.assertEqual({name.split(", ")[1] for _, _, name in kinds}, {"idle", "one core loaded"})
        self.assertEqual(len(kinds), 18)  # three bodies, three methods
        cores = len(os.sched_getaffinity(0))
        for rows in kinds.values():
            threads = [row["threads"] for row in rows]
            self.assertEqual(threads, sorted(set(threads)))
            self.assertEqual(threads[:4], list(range(1, min(cores, 4) + 1)))
            self.assertEqual(threads[-1], cores)
            for row in rows:
                self.assertGreater(row["speedup"], 0)

    def test_wrong_usage_and_what_cannot_be_written(self):
        done = bench("kernels")
        self.assertEqual(done.returncode, 2)
        self.assertIn("roofline", done.stderr)
        self.assertEqual(bench("kernel", "step").returncode, 2)
        for option, place in (("--json", "nowhere/rows.json"), ("--out", "file/pictures")):
            (self.folder / "file").write_text("")
            done = bench("step", "--quick", option, self.folder / place)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(str(self.folder / place), done.stderr)
            self.assertEqual(done.stdout, "", "nothing was measured first")


if __name__ == "__main__":
    unittest.main()
