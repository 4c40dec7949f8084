"""Bare meshes from the command line: each is held, soft and in real time by the cost model, and all choices are told."""
import json
import math
import unittest

from program import ProgramCase, heml


def box(cells, size, place=lambda x: x):
    """Nodes and tetrahedra of a box, five a cell."""
    nx, ny, nz = cells
    number = lambda i, j, k: i + (nx + 1) * (j + (ny + 1) * k)
    nodes = [place([size[0] * i / nx, size[1] * j / ny, size[2] * k / nz])
             for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    tets = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                corners = [number(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2)) for b in range(8)]
                cell = [(0, 1, 2, 4), (3, 2, 1, 7), (5, 4, 7, 1), (6, 7, 4, 2), (1, 2, 4, 7)]
                if (i + j + k) % 2:  # mirrored, so that faces match
                    cell = [(b ^ 1, a ^ 1, c ^ 1, d ^ 1) for a, b, c, d in cell]
                tets += [tuple(corners[v] for v in tet) for tet in cell]
    return nodes, tets


def medit(nodes, tets):
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(nodes))]
    lines += ["%.17g %.17g %.17g 0" % tuple(x) for x in nodes]
    lines += ["Tetrahedra", str(len(tets))] + ["%d %d %d %d 0" % tuple(n + 1 for n in tet) for tet in tets]
    return "\n".join(lines + ["End", ""])


def torus(x):
    """Bends a unit bar into three quarters of a ring that lies on its side."""
    angle, r, y = 1.5 * math.pi * x[0], 0.06 + 0.03 * x[1], 0.03 * x[2]
    return [r * math.cos(angle), y, r * math.sin(angle)]


SHAPES = {
    "block": box((5, 5, 5), (0.1, 0.1, 0.1)),
    "millimetres": box((6, 4, 4), (150, 100, 100)),
    "column": box((3, 20, 3), (0.03, 0.3, 0.03)),
    "plate": box((16, 1, 16), (0.3, 0.01, 0.3)),
    "ring": box((24, 3, 3), (1, 1, 1), torus),
    "fine": box((16, 12, 12), (0.2, 0.15, 0.15)),
    "slivers": box((8, 8, 8), (0.1, 0.1, 0.1), lambda x: [x[0], x[1] * (1 + 49 * (x[1] > 0.09)) / 50, x[2]]),
}


class Organs(ProgramCase):
    def mesh(self, name):
        return self.write(name + ".mesh", medit(*SHAPES[name]))

    def explained(self, path):
        done = heml("explain", path, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def test_every_mesh_is_held_and_in_real_time_by_the_cost_model(self):
        for name in SHAPES:
            with self.subTest(name):
                explained, _ = self.explained(self.mesh(name))
                chosen = explained["chosen"]
                self.assertLessEqual(chosen["load"], 0.7)
                self.assertLessEqual(chosen["stretch"], 1.5)
                self.assertGreaterEqual(chosen["supported_area"], 0.12)
                held, nodes = explained["body"]["held_nodes"], explained["body"]["nodes"]
                if name == "plate":  # one element thick, on its flat face: corners and middles of edges there
                    self.assertEqual(held, 33 * 33)
                else:
                    self.assertLess(held, nodes / 2)
                self.assertEqual(explained["method"]["integrator"], chosen["integrator"])
                self.assertEqual([text["about"] for text in chosen["texts"]],
                                 ["unit", "up", "supports", "element", "tissue", "method"])

    def test_slivers_get_an_implicit_method_and_a_good_block_an_explicit_one(self):
        block, _ = self.explained(self.mesh("block"))
        slivers, _ = self.explained(self.mesh("slivers"))
        self.assertEqual(block["chosen"]["integrator"], "verlet")
        self.assertEqual(block["chosen"]["young"], 1e4)
        self.assertIsNone(block["chosen"]["budget_iterations"])
        self.assertEqual(slivers["chosen"]["integrator"], "backward_euler")
        self.assertEqual(block["chosen"]["findings"], [])
        self.assertEqual([(found["count"], found["found"], found["mended"]) for found in slivers["chosen"]["findings"]],
                         [(2240, "slivers", False)])
        self.assertEqual((slivers["chosen"]["read_tets"], slivers["chosen"]["tets"]), (2560, 2560))
        self.assertLess(slivers["chosen"]["min_dihedral"], 5)
        self.assertGreaterEqual(slivers["chosen"]["rate"], 10)
        self.assertGreaterEqual(slivers["chosen"]["budget_iterations"], 1)

    def test_the_body_stays_together_and_nothing_of_its_mesh_is_changed(self):
        for name in ("slivers", "ring", "millimetres"):
            with self.subTest(name):
                path = self.mesh(name)
                done = heml("solve", path, "--out", self.folder / name)
                self.assertEqual(done.returncode, 0, done.stderr)
                report = json.loads((self.folder / name / "report.json").read_text())
                nodes, tets = SHAPES[name]
                corners = report.get("corner_nodes", report["nodes"])
                self.assertEqual((corners, report["tets"]), (len(nodes), len(tets)))
                self.assertGreater(report["min_J"], 0.2)
                self.assertLess(report["max_J"], 2)
                self.assertEqual(report["recoveries"], 0)

    def test_small_bodies_have_quadratic_elements_and_their_nodes_come_first(self):
        for name, element in (("ring", "p2"), ("slivers", "p1"), ("fine", "p1")):
            with self.subTest(name):
                explained, told = self.explained(self.mesh(name))
                self.assertEqual(explained["chosen"]["element"], element)
                self.assertIn(f"({element})", told)
        done = heml("solve", self.mesh("ring"), "--out", self.folder / "ring")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = (self.folder / "ring" / "positions.csv").read_text().splitlines()[1:]
        nodes = SHAPES["ring"][0]
        self.assertGreater(len(rows), 4 * len(nodes))
        held = [k for k, x in enumerate(nodes) if x[1] < 1e-9]  # the underside rests where the file has it
        self.assertGreater(len(held), 20)
        for k in held:
            place = [float(number) for number in rows[k].split(",")[1:]]
            self.assertLess(max(abs(a - b) for a, b in zip(place, nodes[k])), 1e-12)

    def test_the_same_mesh_gives_the_same_bits_each_time(self):
        path = self.mesh("slivers")
        hashes = set()
        for _ in range(2):
            done = heml("solve", path, "--out", self.folder / "out")
            self.assertEqual(done.returncode, 0, done.stderr)
            hashes.add(json.loads((self.folder / "out" / "report.json").read_text())["state_hash"])
        self.assertEqual(len(hashes), 1)

    def test_what_changes_the_file_s_numbers_is_warned_of(self):
        _, told = self.explained(self.mesh("millimetres"))
        self.assertIn("warning", told)
        self.assertIn("read in millimetres: scaled by 0.001", told)
        _, told = self.explained(self.mesh("block"))
        self.assertNotIn("warning", told)
        self.assertIn("rests on the lowest", told)

    def test_a_scene_file_has_nothing_chosen(self):
        scene = self.write("scene.json", {
            "schema_version": 1, "mesh": {"file": str(self.mesh("block"))},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}]})
        explained, _ = self.explained(scene)
        self.assertIsNone(explained["chosen"])

    def test_a_rate_event_is_recorded_and_verified(self):
        path = self.write("scene.json", {
            "schema_version": 1, "mesh": {"file": str(self.mesh("block"))},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}],
            "boundary": [{"box": [[-1, -1, -1], [1, 1e-6, 1]], "fix": True}], "gravity": [0, -9.81, 0],
            "solver": {"duration": 0.1},
            "events": [{"step": 50, "integrator": "backward_euler"}, {"step": 50, "rate": 60},
                       {"step": 50, "budget": 1}]})
        done = heml("replay", path, "--record", self.folder / "out.jsonl")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = heml("replay", self.folder / "out.jsonl", "--verify")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
