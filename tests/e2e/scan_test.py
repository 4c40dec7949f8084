"""Label maps: heml mesh, and scenes of them."""
import gzip
import json
import struct
import unittest

from program import ProgramCase, heml

SIDE = 32  # voxels of 6 mm


def nifti(label, side=SIDE, voxels=None):
    """A cube of voxels, gzip; label(x, y, z) in millimetres from its middle."""
    header = bytearray(352)
    step = 192 / side
    first = (step - 192) / 2
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, side, side, side, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, 1, step, step, step, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2
    struct.pack_into("<hh", header, 252, 0, 1)
    struct.pack_into("<12f", header, 280, step, 0, 0, first, 0, step, 0, first, 0, 0, step, first)
    header[344:348] = b"n+1\0"
    if voxels is None:
        at = [first + step * n for n in range(side)]
        voxels = bytes(label(x, y, z) for z in at for y in at for x in at)
    return gzip.compress(bytes(header) + voxels)


def ellipsoid(x, y, z, a, b, c):
    return (x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 < 1


def organs(x, y, z):
    if ellipsoid(x - 20, y, z, 30, 25, 25):
        return 4
    return 1 if ellipsoid(x, y, z, 80, 50, 60) else 0


def gmsh(path):
    lines = path.read_text().splitlines()
    nodes = lines.index("$Nodes")
    elements = lines.index("$Elements")
    points = [tuple(map(float, line.split()[1:])) for line in lines[nodes + 2:nodes + 2 + int(lines[nodes + 1])]]
    tets = [list(map(int, line.split())) for line in lines[elements + 2:elements + 2 + int(lines[elements + 1])]]
    return points, [(tet[3], [n - 1 for n in tet[5:]]) for tet in tets], lines


class Scans(ProgramCase):
    def scan(self, name="scan.nii.gz", label=organs, **more):
        path = self.folder / name
        path.write_bytes(nifti(label, **more))
        return path

    def test_heml_mesh_makes_a_region_a_label_with_its_name(self):
        self.write("scan.json", {"labels": {"background": 0, "liver": 1, "lesion": 4}})
        done = heml("mesh", self.scan(), "--out", self.folder / "organ.msh", "--tets", 6000)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("label 1 (liver): ", done.stdout)
        points, tets, lines = gmsh(self.folder / "organ.msh")
        self.assertIn('3 4 "lesion"', lines)
        self.assertTrue(4500 <= len(tets) <= 7500, len(tets))
        self.assertEqual({region for region, _ in tets}, {1, 4})
        used = [points[n] for _, tet in tets for n in tet]
        for axis, half in enumerate((0.080, 0.050, 0.060)):  # metres
            self.assertAlmostEqual(max(x[axis] for x in used), half, delta=0.003)
            self.assertAlmostEqual(min(x[axis] for x in used), -half, delta=0.003)
        faces = {}
        for _, tet in tets:
            for left_out in tet:
                face = tuple(sorted(set(tet) - {left_out}))
                faces[face] = faces.get(face, 0) + 1
        self.assertLessEqual(max(faces.values()), 2)

    def test_chosen_labels_alone(self):
        done = heml("mesh", self.scan(), "--out", self.folder / "one.vtu", "--tets", 2000, "--labels", 4)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("label 1", done.stdout)
        self.assert_refused(heml("mesh", self.scan(), "--out", self.folder / "one.vtu", "--labels", "4,7"), 3, "label 7")

    def test_options_that_do_not_fit(self):
        scan = self.scan()
        for options in (("--improve",), ):
            self.assertEqual(heml("mesh", scan, "--out", self.folder / "a.msh", *options).returncode, 2)
        box = self.write("box.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                         "Tetrahedra\n1\n1 2 3 4 0\nEnd\n")
        for options in (("--labels", "1"), ("--tets", "9")):
            self.assertEqual(heml("mesh", box, "--out", self.folder / "a.msh", *options).returncode, 2)

    def test_a_bare_label_map_is_a_scene(self):
        done = heml("explain", self.scan(), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        explained = json.loads(done.stdout)
        self.assertEqual(sorted(material["region"] for material in explained["materials"]), [1, 4])
        self.assertEqual(explained["chosen"]["scale"], 1)
        self.assertAlmostEqual(explained["chosen"]["length"], 0.16, delta=0.004)

    def test_a_scene_of_a_label_map(self):
        self.scan()
        scene = self.write("scene.json", {
            "schema_version": 1, "mesh": {"labels": "scan.nii.gz", "tets": 2000},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.4},
                          {"region": 4, "law": "neo_hookean", "young": 5e4, "poisson": 0.4}],
            "boundary": [{"box": [[-1, -1, -1], [1, -0.03, 1]], "fix": True}],
            "gravity": [0, -9.81, 0], "solver": {"integrator": "static"}})
        for out in ("one", "two"):
            done = heml("solve", scene, "--out", self.folder / out)
            self.assertEqual(done.returncode, 0, done.stderr)
        first, second = (json.loads((self.folder / out / "report.json").read_text()) for out in ("one", "two"))
        self.assertTrue(first["converged"])
        self.assertEqual(first["state_hash"], second["state_hash"])
        self.write("wrong.json", {"schema_version": 1, "mesh": {"asset": "kidney", "tets": 5},
                                  "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.4}]})
        self.assert_refused(heml("explain", self.folder / "wrong.json"), 3, "mesh.tets", "label map")

    def test_damaged_files_are_refused_before_memory_is_taken(self):
        whole = nifti(organs)
        cut = self.folder / "cut.nii.gz"
        cut.write_bytes(whole[:len(whole) // 2])
        self.assert_refused(heml("explain", cut), 3, "cut.nii.gz", "cut off")
        huge = bytearray(gzip.decompress(whole)[:400])
        struct.pack_into("<3h", huge, 42, 1000, 1000, 1000)
        (self.folder / "huge.nii").write_bytes(bytes(huge))
        self.assert_refused(heml("explain", self.folder / "huge.nii"), 3, "1000 x 1000 x 1000", "crop")
        empty = self.scan("empty.nii.gz", voxels=bytes(SIDE ** 3))
        self.assert_refused(heml("explain", empty), 3, "holds no label")


if __name__ == "__main__":
    unittest.main()
