"""Messages about a scene name its file, once, and where in it the fault is. HEML_BINARY is the path of the program."""
import unittest

from program import ProgramCase, beam, heml

NEO_HOOKEAN = {"law": "neo_hookean", "young": 1e4, "poisson": 0.3}
TET = ("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
       "Tetrahedra\n1\n1 2 3 4 7\nEnd\n")


def box(size, **more):
    return {"box": {"size": size, "cells": [1, 1, 1]}} | more


class Messages(ProgramCase):
    NAME = "a scene é.json"

    def solved(self, **changes):
        self.write(self.NAME, beam(**changes))
        return heml("solve", self.NAME, "--out", "out", cwd=self.folder)

    def assert_names_file_once(self, line, place):
        self.assertTrue(line.startswith(f"{self.NAME}: {place}"), line)
        self.assertEqual(line.count(self.NAME), 1, line)

    def test_errors_that_only_the_mesh_shows_name_the_scene(self):
        self.write("tet.mesh", TET)
        tet = {"file": "tet.mesh"}
        for place, words, changes in (
                ("materials: region 0 (element 0) has no material", "add an entry",
                 {"materials": [NEO_HOOKEAN | {"region": 3}]}),
                ("materials: region 7 (element 0) has no material", "add an entry",
                 {"mesh": tet, "materials": [NEO_HOOKEAN | {"region": 3}], "boundary": []}),
                ("materials[0].young: box 6x2x2 has no field 'E'", "it has none",
                 {"materials": [NEO_HOOKEAN | {"young": {"field": "E"}}]}),
                ("mesh: box 1x1x1: element 0: has no volume", "nodes 0", {"mesh": box([1e-20, 1, 1])}),
                ("mesh: box 1x1x1: node 1: position", "coordinates up to", {"mesh": box([1e200, 1, 1])}),
                ("mesh: box 1x1x1: node 0: position", "coordinates up to", {"mesh": box([1, 1, 1], translate=[1e20, 0, 0])}),
                ("mesh: tet.mesh: node 1: position", "coordinates up to", {"mesh": tet | {"scale": 1e100}}),
                ("mesh.rotate.degrees: is 1e+300", "from",
                 {"mesh": box([1, 1, 1], rotate={"axis": [0, 0, 1], "degrees": 1e300})}),
                ("regions[0]: no element of region 5", "choose elements", {"regions": [{"region": 5, "name": "a"}]}),
                ("boundary[0].nodes[0]: is 99", "nodes 0 to", {"boundary": [{"nodes": [99], "fix": True}]}),
                ("loads[0]: its 1 nodes hold no face", "boundary face", {"loads": [{"nodes": [1], "pressure": 1}]}),
                ("outputs.markers[0]: its box selects no node", "the body reaches",
                 {"outputs": {"markers": [{"box": [[5, 5, 5], [6, 6, 6]]}]}}),
                ("events: step 1: grasp.node: is 99", "nodes 0 to", {"events": [{"step": 1, "grasp": {"node": 99}}]})):
            with self.subTest(place=place):
                done = self.solved(**changes)
                self.assert_refused(done, 3, words, alone=True)
                self.assert_names_file_once(done.stderr.removeprefix("heml: error: "), place)

    def test_a_fault_of_a_mesh_file_names_that_file_alone(self):
        self.write("flat.mesh", TET.replace("0 0 1 0", "1 1 0 0"))
        done = self.solved(mesh={"file": "flat.mesh"})
        self.assert_refused(done, 3, "flat.mesh: element 0: has no volume", alone=True)
        done = heml("solve", "flat.mesh", "--out", "out", cwd=self.folder)
        self.assert_refused(done, 3, "flat.mesh", alone=True)

    def test_a_scene_without_a_name_is_told_apart_from_one_that_is_not_there(self):
        for command in (["solve", "", "--out", "out"], ["explain", ""], ["replay", ""]):
            self.assert_refused(heml(*command, cwd=self.folder), 3, "SCENE: is empty", alone=True)

    def test_warnings_name_the_scene(self):
        for place, changes in (
                ("materials[1]: no element carries region 3; the mesh has 0",
                 {"materials": [NEO_HOOKEAN, NEO_HOOKEAN | {"region": 3}]}),
                ("materials[0]: the default applies to no element",
                 {"materials": [NEO_HOOKEAN, NEO_HOOKEAN | {"region": 0}]}),
                ("self_contact.within_bodies: false leaves out all contact", {"self_contact": {"within_bodies": False}}),
                ("1 of 1 events are left out", {"solver": {"integrator": "static"}, "events": [{"step": 3, "release": True}]}),
                ("1 of 2 events are left out: they come after solver.duration, 0.05 s",
                 {"events": [{"at": 0.01, "gravity": [0, 0, 0]}, {"at": 2, "gravity": [0, 1, 0]}]}),
                ("positions: 1 of 5 elements are inverted or flat",
                 {"mesh": box([1, 1, 1]), "materials": [NEO_HOOKEAN | {"law": "stvk"}], "gravity": [0, 0, 0],
                  "boundary": [{"nodes": [0, 1, 2, 3, 4, 5, 6], "fix": True}, {"nodes": [7], "translate": [-0.9, -0.9, -0.9]}]})):
            with self.subTest(place=place):
                done = self.solved(**changes)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assert_names_file_once(done.stderr.removeprefix("heml: warning: "), place)


if __name__ == "__main__":
    unittest.main()
