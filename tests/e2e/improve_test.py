"""heml mesh --improve: lines of JSON, files, refusals."""
import json
import random
import unittest

from program import ProgramCase, heml

KEYS = {"tets", "min_dihedral_deg", "slivers", "explicit_step_s", "surface_distance_m"}
CORNERS = ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7))


def shaken_box(cells, amount):
    """A cube of 0.1 m in two regions, six tetrahedra a cell, as Gmsh 2.2; inner nodes displaced."""
    draw = random.Random(1)
    width = cells + 1
    nodes = []
    for k in range(width):
        for j in range(width):
            for i in range(width):
                inner = all(0 < n < cells for n in (i, j, k)) and 2 * i != cells
                nodes.append([(n + (draw.uniform(-amount, amount) if inner else 0)) * 0.1 / cells for n in (i, j, k)])
    tets = []
    for k in range(cells):
        for j in range(cells):
            for i in range(cells):
                corner = [i + di + width * (j + dj + width * (k + dk)) for dk in (0, 1) for dj in (0, 1) for di in (0, 1)]
                tets += [(1 + (2 * i >= cells), [corner[c] for c in tet]) for tet in CORNERS]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += ["%d %.17g %.17g %.17g" % (n + 1, *x) for n, x in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(tets))]
    lines += ["%d 4 2 %d %d %d %d %d %d" % (t + 1, region, region, *(n + 1 for n in tet))
              for t, (region, tet) in enumerate(tets)]
    return "\n".join(lines + ["$EndElements", ""])


class Improve(ProgramCase):
    def improved(self, *options, name="out.msh"):
        self.write("in.msh", shaken_box(6, 0.43))
        done = heml("mesh", self.folder / "in.msh", "--out", self.folder / name, "--improve", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        before, after = map(json.loads, done.stdout.splitlines())
        for line in (before, after):
            self.assertLessEqual(KEYS, line.keys())
        return before, after

    def test_slivers_go_and_the_explicit_step_grows(self):
        before, after = self.improved()
        self.assertGreater(before["slivers"], 0)
        self.assertEqual(before["surface_distance_m"], 0)
        self.assertEqual(after["slivers"], 0)
        self.assertGreaterEqual(after["min_dihedral_deg"], 10)
        self.assertGreater(after["explicit_step_s"], 2 * before["explicit_step_s"])
        self.assertLess(after["surface_distance_m"], 1e-9)

    def test_the_file_is_ascii_gmsh_2_2_with_both_regions(self):
        _, after = self.improved()
        lines = (self.folder / "out.msh").read_text().splitlines()
        self.assertEqual(lines[1], "2.2 0 8")
        elements = [line.split() for line in lines[lines.index("$Elements") + 2:-1]]
        self.assertEqual(len(elements), after["tets"])
        self.assertEqual({element[3] for element in elements}, {"1", "2"})

    def test_a_number_of_elements_is_met(self):
        for tets in (500, 4000):
            _, after = self.improved("--tets", tets, name="out.vtu")
            self.assertLess(abs(after["tets"] - tets), 0.25 * tets)
            self.assertGreaterEqual(after["min_dihedral_deg"], 10)

    def test_the_same_input_gives_the_same_file(self):
        self.improved(name="a.msh")
        self.improved(name="b.msh")
        self.assertEqual((self.folder / "a.msh").read_bytes(), (self.folder / "b.msh").read_bytes())

    def test_wrong_usage_and_bad_input_are_refused(self):
        self.write("in.msh", shaken_box(2, 0))
        out = self.folder / "out.msh"
        for options in (["--tets", 100], ["--min-angle", 12], ["--improve", "--min-angle", "nan"]):
            done = heml("mesh", self.folder / "in.msh", "--out", out, *options)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("improve" if len(options) == 2 else "--min-angle", done.stderr)
        twice = shaken_box(2, 0).replace("$Elements\n48", "$Elements\n49").replace(
            "$EndElements", "49 4 2 1 1 1 2 5 14\n$EndElements")
        self.write("twice.msh", twice)
        self.assert_refused(heml("mesh", self.folder / "twice.msh", "--out", out, "--improve"), 3, "element")
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
