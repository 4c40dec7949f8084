"""Models of FEBio from the command line: solved, explained, kept as scenes, or refused with all reasons."""
import json
import unittest

from program import ProgramCase, heml

NODES = [(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
TETS = [(1, 2, 4, 7), (0, 1, 2, 4), (3, 2, 1, 7), (5, 1, 4, 7), (6, 4, 2, 7)]


def turned(tet):
    a, b, c, d = ([NODES[n][i] for i in range(3)] for n in tet)
    u, v, w = ([p[i] - a[i] for i in range(3)] for p in (b, c, d))
    det = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
    return tet if det > 0 else (tet[0], tet[1], tet[3], tet[2])


def cube(material="<E>1000</E><v>0.3</v>", law="neo-Hookean", more=""):
    """A unit cube, all nodes moved so that it is stretched by 1.5 along x alone."""
    nodes = "".join(f'<node id="{n + 1}">{x},{y},{z}</node>\n' for n, (x, y, z) in enumerate(NODES))
    tets = "".join(f'<elem id="{t + 1}">{",".join(str(n + 1) for n in turned(tet))}</elem>\n' for t, tet in enumerate(TETS))
    side = lambda x: ", ".join(str(n + 1) for n in range(8) if NODES[n][0] == x)
    return f"""<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="4.0">
<Module type="solid"/>
<Control><analysis>STATIC</analysis><time_steps>10</time_steps><step_size>0.1</step_size></Control>
<Material><material id="1" name="stuff" type="{law}">{material}</material></Material>
<Mesh><Nodes name="all">{nodes}</Nodes><Elements type="tet4" name="cube">{tets}</Elements>
<NodeSet name="left">{side(0)}</NodeSet><NodeSet name="right">{side(1)}</NodeSet></Mesh>
<MeshDomains><SolidDomain name="cube" mat="stuff"/></MeshDomains>
<Boundary>
<bc type="zero displacement" node_set="left"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>
<bc type="zero displacement" node_set="right"><y_dof>1</y_dof><z_dof>1</z_dof></bc>
<bc type="prescribed displacement" node_set="right"><dof>x</dof><value lc="1">0.5</value></bc>
{more}</Boundary>
<LoadData><load_controller id="1" type="loadcurve"><points><pt>0,0</pt><pt>1,1</pt></points></load_controller></LoadData>
</febio_spec>
"""


class Feb(ProgramCase):
    def report(self, scene, out="out"):
        done = heml("solve", scene, "--out", self.folder / out)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / out / "report.json").read_text())

    def test_a_model_is_solved_to_the_closed_form_of_its_law(self):
        report = self.report(self.write("cube.feb", cube()))
        mu, lame = 1000 / 2.6, 1000 * 0.3 / (1.3 * 0.4)
        ln = 0.4054651081081644  # ln 1.5
        self.assertAlmostEqual(report["reaction"][1][0], mu * (1.5 - 1 / 1.5) + lame * ln / 1.5, places=8)
        self.assertAlmostEqual(report["elastic_energy"], mu / 2 * (1.5 ** 2 - 1) - mu * ln + lame / 2 * ln ** 2, places=8)

    def test_explain_names_its_parts_and_keeps_it_as_a_scene(self):
        model, kept = self.write("cube.feb", cube()), self.folder / "kept.json"
        done = heml("explain", model, "--save", kept)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("region 1, cube", done.stdout)
        scene = json.loads(kept.read_text())
        self.assertEqual(scene["mesh"]["file"], "cube.feb")
        self.assertEqual(self.report(kept, "kept")["state_hash"], self.report(model)["state_hash"])
        refused = heml("explain", model, "--save", model)
        self.assert_refused(refused, 3, "is read by this run")

    def test_it_serves_as_a_mesh_alone(self):
        self.write("cube.feb", cube(law="rigid body"))
        scene = self.write("scene.json", {
            "schema_version": 1, "mesh": {"file": "cube.feb"}, "materials": [{"law": "stvk", "young": 1e3, "poisson": 0}],
            "boundary": [{"nodes": [0, 2, 4, 6], "fix": True}], "solver": {"integrator": "static"}})
        self.assertEqual(self.report(scene)["tets"], 5)

    def test_all_that_is_refused_is_in_one_message(self):
        more = '<bc name="mean" type="normal displacement" surface="none"/>'
        done = heml("solve", self.write("odd.feb", cube(law="viscoelastic", more=more)), "--out", self.folder / "out")
        self.assert_refused(done, 3, "odd.feb", "'stuff' of type viscoelastic", "'mean' of type normal displacement", "holds 2 things")
        self.assertFalse((self.folder / "out").exists())

    def test_damaged_files_have_one_message(self):
        text = cube()
        for name, damaged, words in (
                ("cut", text[:len(text) // 2], ["cut off"]), ("empty", "", ["holds no XML"]),
                ("entities", text.replace("<febio_spec", '<!DOCTYPE f [<!ENTITY a "&b;&b;">]>\n<febio_spec'), ["DOCTYPE"]),
                ("deep", "<febio_spec version=\"4.0\">" + "<a>" * 100000, ["nested more than 64"]),
                ("old", text.replace('version="4.0"', 'version="1.2"'), ["1.2"]),
                ("count", text.replace("<time_steps>10", "<time_steps>1e400"), ["time_steps"])):
            with self.subTest(name):
                done = heml("explain", self.write(name + ".feb", damaged))
                self.assert_refused(done, 3, name + ".feb: line", *words)


if __name__ == "__main__":
    unittest.main()
