"""Files of other programs, read, and files for other programs, read back. HEML_BINARY is the path of the program.

What is written is parsed here by the formats' specifications; with meshio, PyVista (VTK), gmsh, pygltflib and trimesh (all on
PyPI) their readers and writers join in, and the tests that need them say so where they are skipped.
"""
import importlib.util
import json
import math
import re
import struct
import unittest

from program import ProgramCase, beam, heml

NODES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1.5), (0.3, -1, 0.2)]
TETS = [(0, 1, 2, 3), (1, 2, 3, 4), (0, 3, 1, 5)]
REGIONS = [1, 2, 2]


def needs(*modules):
    """Skips a test, with a word, where one of the modules is not here."""
    missing = [m for m in modules if importlib.util.find_spec(m) is None]
    return unittest.skipIf(missing, f"Python's {', '.join(missing)} is not here (PyPI)")


def medit(path):
    """Nodes, tetrahedra and regions of a .mesh file that heml wrote."""
    words = path.read_text().split()
    at = words.index("Vertices")
    count = int(words[at + 1])
    values = words[at + 2:at + 2 + 4 * count]
    nodes = [tuple(map(float, values[i:i + 3])) for i in range(0, len(values), 4)]
    at = words.index("Tetrahedra")
    values = list(map(int, words[at + 2:at + 2 + 5 * int(words[at + 1])]))
    rows = [values[i:i + 5] for i in range(0, len(values), 5)]
    return nodes, [tuple(n - 1 for n in row[:4]) for row in rows], [row[4] for row in rows]


class Reading(ProgramCase):
    def assert_read(self, path, regions=REGIONS, nodes=NODES):
        done = heml("mesh", path, "--out", self.folder / "read.mesh", "--scale", 1)
        self.assertEqual(done.returncode, 0, f"{path.name}: {done.stderr}")
        points, tets, found = medit(self.folder / "read.mesh")
        self.assertEqual([set(t) for t in tets], [set(t) for t in TETS], path.name)
        self.assertEqual(found, regions, path.name)
        self.assertEqual(points, [tuple(map(float, p)) for p in nodes], path.name)

    @needs("pyvista")
    def test_vtu_of_vtk_in_every_form(self):
        import vtk
        grid = vtk.vtkUnstructuredGrid()
        points = vtk.vtkPoints()
        points.SetDataTypeToDouble()
        for node in NODES:
            points.InsertNextPoint(node)
        grid.SetPoints(points)
        for tet in TETS:
            ids = vtk.vtkIdList()
            for n in tet:
                ids.InsertNextId(n)
            grid.InsertNextCell(vtk.VTK_TETRA, ids)
        region = vtk.vtkIntArray()
        region.SetName("region")
        for value in REGIONS:
            region.InsertNextValue(value)
        grid.GetCellData().AddArray(region)
        path = self.folder / "organ.vtu"
        for mode in ("Ascii", "Binary", "Appended"):
            for compressor in ("None", "ZLib"):
                for encode in (0, 1):
                    for header in ("UInt32", "UInt64"):
                        for order in ("Little", "Big"):
                            writer = vtk.vtkXMLUnstructuredGridWriter()
                            writer.SetFileName(str(path))
                            writer.SetInputData(grid)
                            getattr(writer, f"SetDataModeTo{mode}")()
                            getattr(writer, f"SetCompressorTypeTo{compressor}")()
                            getattr(writer, f"SetHeaderTypeTo{header}")()
                            getattr(writer, f"SetByteOrderTo{order}Endian")()
                            writer.SetEncodeAppendedData(encode)
                            writer.SetBlockSize(40)
                            self.assertEqual(writer.Write(), 1)
                            with self.subTest(mode=mode, compressor=compressor, encode=encode, header=header, order=order):
                                self.assert_read(path)
        writer.SetCompressorTypeToLZ4()
        writer.Write()
        self.assert_refused(heml("mesh", path, "--out", self.folder / "b.mesh"), 3, "vtkLZ4DataCompressor", "zlib")

    @needs("meshio")
    def test_files_of_meshio(self):
        import meshio
        import numpy as np
        mesh = meshio.Mesh(np.array(NODES, float), [("tetra", np.array(TETS))],
                           cell_data={"region": [np.array(REGIONS)], "gmsh:physical": [np.array(REGIONS)],
                                      "gmsh:geometrical": [np.array(REGIONS)]})
        for name, options in (("a.vtu", {}), ("b.vtu", {"binary": True, "compression": None}), ("c.vtu", {"binary": False}),
                              ("d.msh", {"file_format": "gmsh22", "binary": True})):
            meshio.write(self.folder / name, mesh, **options)
            with self.subTest(name):
                self.assert_read(self.folder / name)
        mesh = meshio.Mesh(np.array(NODES, float), [("tetra", np.array(TETS))],
                           cell_sets={"liver": [np.array([0])], "vein": [np.array([1, 2])]})
        meshio.write(self.folder / "f.inp", mesh)
        self.assert_read(self.folder / "f.inp")

    @needs("gmsh")
    def test_msh_of_gmsh_with_names(self):
        import gmsh
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.addBox(1, 0, 0, 1, 1, 1)
        gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], 4, "liver")
        gmsh.model.addPhysicalGroup(3, [2], 9, "tumour")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
        gmsh.model.mesh.generate(3)
        read = {}
        for version in (2.2, 4.1):
            for binary in (0, 1):
                for parametric in (0, 1) if version > 4 else (0,):
                    gmsh.option.setNumber("Mesh.MshFileVersion", version)
                    gmsh.option.setNumber("Mesh.Binary", binary)
                    gmsh.option.setNumber("Mesh.SaveParametric", parametric)
                    path = self.folder / "boxes.msh"
                    gmsh.write(str(path))
                    told = heml("explain", path)
                    self.assertEqual(told.returncode, 0, told.stderr)
                    self.assertIn("region 4, liver", told.stdout)
                    self.assertIn("region 9, tumour", told.stdout)
                    done = heml("mesh", path, "--out", self.folder / "read.mesh", "--scale", 1)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    nodes, tets, regions = medit(self.folder / "read.mesh")
                    read[version, binary, parametric] = nodes, [set(t) for t in tets], regions
                    self.assertEqual(set(regions), {4, 9})
            for parametric in (0, 1) if version > 4 else (0,):
                (a, *rest_a), (b, *rest_b) = read[version, 0, parametric], read[version, 1, parametric]
                self.assertEqual(rest_a, rest_b)
                self.assertTrue(all(math.dist(p, q) < 1e-15 for p, q in zip(a, b, strict=True)))

    def test_names_of_a_written_msh_come_back(self):
        lines = ["*NODE"] + [f"{n + 1}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(NODES)]
        lines += ["*ELEMENT, TYPE=C3D4"] + [f"{t + 1}, " + ", ".join(str(n + 1) for n in tet) for t, tet in enumerate(TETS)]
        lines += ["*ELSET, ELSET=liver", "1,", "*ELSET, ELSET=portal vein, GENERATE", "2, 3"]
        path = self.write("organ.inp", "\n".join(lines) + "\n")
        self.assert_read(path)
        self.assertEqual(heml("mesh", path, "--out", self.folder / "organ.msh").returncode, 0)
        told = heml("explain", self.folder / "organ.msh")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("region 2, portal vein", told.stdout)
        told = json.loads(heml("explain", "--json", self.folder / "organ.msh").stdout)
        self.assertEqual({m["region"]: m.get("name") for m in told["materials"]}, {1: "liver", 2: "portal vein"})

    def test_an_include_is_refused_with_a_word(self):
        path = self.write("organ.inp", "*INCLUDE, INPUT=nodes.inp\n")
        self.assert_refused(heml("explain", path), 3, "organ.inp: line 1", "nodes.inp", "put its lines here")


def ply(path):
    """Points and triangles of an ASCII .ply file."""
    lines = path.read_text().splitlines()
    counts = [int(line.split()[2]) for line in lines if line.startswith("element")]
    at = lines.index("end_header") + 1
    points = [tuple(map(float, line.split()[:3])) for line in lines[at:at + counts[0]]]
    return points, [tuple(map(int, line.split()[1:])) for line in lines[at + counts[0]:at + sum(counts)]]


class Glb:
    """A parsed .glb file, by the glTF 2.0 specification."""

    SIZES = {"SCALAR": 1, "VEC3": 3}
    TYPES = {5126: ("f", 4), 5125: ("I", 4)}

    def __init__(self, path):
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(data[20:20 + size])
        at = 20 + size
        size, kind = struct.unpack_from("<I4s", data, at)
        assert kind == b"BIN\0" and at + 8 + size == len(data) and size == self.json["buffers"][0]["byteLength"]
        self.buffer = data[at + 8:]

    def values(self, index):
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        code, size = self.TYPES[accessor["componentType"]]
        width = self.SIZES[accessor["type"]]
        assert view["byteOffset"] % size == 0 and view["byteLength"] == accessor["count"] * width * size
        flat = struct.unpack_from(f"<{accessor['count'] * width}{code}", self.buffer, view["byteOffset"])
        rows = [flat[i:i + width] for i in range(0, len(flat), width)]
        for end, pick in (("min", min), ("max", max)):
            if end in accessor:
                assert [pick(row[i] for row in rows) for i in range(width)] == [f32(v) for v in accessor[end]]
        return list(flat) if width == 1 else rows

    def channel(self, node, path):
        """Times and values of an animation, or None."""
        animation = self.json["animations"][0]
        for channel in animation["channels"]:
            if channel["target"] == {"node": node, "path": path}:
                sampler = animation["samplers"][channel["sampler"]]
                return self.values(sampler["input"]), self.values(sampler["output"]), sampler["interpolation"]
        return None

    def positions(self, node, time, attribute="POSITION"):
        """Of a node's mesh at a time, as a viewer computes them: LINEAR weights of the morph targets."""
        primitive = self.json["meshes"][self.json["nodes"][node]["mesh"]]["primitives"][0]
        base = self.values(primitive["attributes"][attribute])
        targets = [self.values(t[attribute]) for t in primitive.get("targets", [])]
        times, weights, interpolation = self.channel(node, "weights")
        assert interpolation == "LINEAR" and len(weights) == len(times) * len(targets)
        rows = [weights[i:i + len(targets)] for i in range(0, len(weights), len(targets))]
        k = max([i for i, t in enumerate(times) if t <= time + 1e-9], default=0)
        share = 0 if k + 1 == len(times) else max(0, (time - times[k]) / (times[k + 1] - times[k]))
        here = [a + share * (b - a) for a, b in zip(rows[k], rows[min(k + 1, len(times) - 1)])]
        return [tuple(p[i] + sum(w * t[n][i] for w, t in zip(here, targets) if w) for i in range(3))
                for n, p in enumerate(base)]

    def triangles(self, node):
        mesh = self.json["meshes"][self.json["nodes"][node]["mesh"]]
        flat = [i for primitive in mesh["primitives"] for i in self.values(primitive["indices"])]
        return {tuple(flat[i:i + 3]) for i in range(0, len(flat), 3)}


def f32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


class AnimatedGlb(ProgramCase):
    def export(self, scene, *options, name="film.glb"):
        path = self.write("scene.json", scene)
        done = heml("export", path, "--out", self.folder / name, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Glb(self.folder / name)

    def test_positions_are_those_of_the_ply_frames(self):
        glb = self.export(beam(), "--fps", 100)
        done = heml("export", self.folder / "scene.json", "--out", self.folder / "ply", "--format", "ply", "--fps", 100)
        self.assertEqual(done.returncode, 0, done.stderr)
        frames = [ply(path) for path in sorted((self.folder / "ply").glob("*.ply"))]
        times, _, _ = glb.channel(0, "weights")
        self.assertEqual(len(times), len(frames))
        self.assertEqual(glb.triangles(0), set(frames[0][1]))
        moved = 0
        for k in (0, len(frames) // 2, len(frames) - 1):
            self.assertAlmostEqual(times[k], 0.01 * k, delta=1.1e-3)
            positions = glb.positions(0, times[k])
            self.assertEqual(len(positions), len(frames[k][0]))
            for got, expected in zip(positions, frames[k][0]):
                self.assertLess(math.dist(got, expected), 1e-7)
            moved = max(map(math.dist, positions, frames[0][0]))
        self.assertGreater(moved, 1e-3)
        middle = glb.positions(0, (times[1] + times[2]) / 2)
        for got, a, b in zip(middle, frames[1][0], frames[2][0]):
            self.assertLess(math.dist(got, [(x + y) / 2 for x, y in zip(a, b)]), 1e-7)

    def test_normals_have_length_one_and_point_outward(self):
        glb = self.export(beam(), "--fps", 100)
        times, _, _ = glb.channel(0, "weights")
        for time in (times[0], times[-1]):
            points, normals = glb.positions(0, time), glb.positions(0, time, "NORMAL")
            self.assertTrue(all(abs(math.hypot(*n) - 1) < 1e-5 for n in normals))
            flux = sum(n[1] * (p[1] - 0.01) for n, p in zip(normals, points))
            self.assertGreater(flux, 0)

    def test_a_cut_begins_a_mesh_of_its_own(self):
        scene = beam(events=[{"at": 0.02, "remove": {"box": [[0.06, -1, -1], [1, 1, 1]]}}])
        glb = self.export(scene, "--fps", 100)
        self.assertEqual(len(glb.json["nodes"]), 2)
        times, _, _ = glb.channel(1, "weights")
        self.assertAlmostEqual(times[0], 0.03, delta=1.1e-3)  # the first frame after the event
        first, second = glb.channel(0, "scale"), glb.channel(1, "scale")
        self.assertEqual(first[2], "STEP")
        self.assertEqual(first[1], [(1, 1, 1), (0, 0, 0)])
        self.assertEqual(second[1], [(0, 0, 0), (1, 1, 1)])
        self.assertEqual(first[0][1], second[0][1])
        self.assertNotEqual(glb.triangles(0), glb.triangles(1))

    def test_regions_are_materials_with_names(self):
        lines = ["*NODE"] + [f"{n + 1}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(NODES)]
        lines += ["*ELEMENT, TYPE=C3D4, ELSET=liver", "1, 1, 2, 3, 4", "*ELEMENT, TYPE=C3D4, ELSET=vein", "2, 2, 3, 4, 5"]
        self.write("two.inp", "\n".join(lines))
        glb = self.export(beam(mesh={"file": "two.inp"}, boundary=[], gravity=[0, 0, 0],
                               solver={"duration": 0.002, "threads": 1}))
        self.assertEqual([m["name"] for m in glb.json["materials"]], ["liver", "vein"])
        self.assertEqual([p["material"] for p in glb.json["meshes"][0]["primitives"]], [0, 1])
        self.assertEqual(len(glb.triangles(0)), 6)

    def test_names_and_formats_that_do_not_go_together_are_refused(self):
        path = self.write("scene.json", beam())
        self.assert_refused(heml("export", path, "--out", self.folder / "a", "--format", "glb"), 2, ".glb")
        self.assert_refused(heml("export", path, "--out", self.folder / "a.glb", "--format", "ply"), 2, ".glb")

    @needs("pygltflib")
    def test_pygltflib_reads_it(self):
        import pygltflib
        glb = self.export(beam(), "--fps", 100)
        read = pygltflib.GLTF2().load(str(self.folder / "film.glb"))
        self.assertEqual(len(read.meshes[0].primitives[0].targets), len(glb.channel(0, "weights")[0]) - 1)
        self.assertEqual(read.animations[0].channels[0].target.path, "weights")

    @needs("trimesh", "numpy")
    def test_trimesh_reads_it(self):
        import trimesh
        glb = self.export(beam(), "--fps", 100)
        mesh = next(iter(trimesh.load(self.folder / "film.glb", process=False).geometry.values()))
        self.assertEqual(len(mesh.faces), len(glb.triangles(0)))
        self.assertAlmostEqual(mesh.volume, 0.1 * 0.02 * 0.02, delta=1e-9)


class OpenUsd(ProgramCase):
    def export(self, scene):
        path = self.write("scene.json", scene)
        for out in ("film.usda", "film.glb"):
            done = heml("export", path, "--out", self.folder / out, "--fps", 100)
            self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "film.usda", Glb(self.folder / "film.glb")

    def test_points_of_the_skin_are_those_of_the_glb(self):
        path, glb = self.export(beam())
        text = path.read_text()
        self.assertTrue(text.startswith("#usda 1.0\n"))
        self.assertEqual(text.count("{"), text.count("}"))
        skin = text[text.index('def Mesh "skin"'):]
        samples = re.search(r"points.timeSamples = \{(.*?)\n\s*\}", skin, re.DOTALL)[1].strip().splitlines()
        times, _, _ = glb.channel(0, "weights")
        self.assertEqual(len(samples), len(times))
        for k in (0, len(times) // 2, len(times) - 1):
            code, points = samples[k].split(": ")
            self.assertAlmostEqual(float(code), 100 * times[k], delta=1e-4)
            points = [tuple(map(float, p.split(","))) for p in re.findall(r"\(([^)]*)\)", points)]
            for got, expected in zip(points, glb.positions(0, times[k]), strict=True):
                self.assertLess(math.dist(got, expected), 1e-7)

    @needs("pxr")
    def test_usd_reads_it(self):
        from pxr import Usd, UsdGeom
        path, glb = self.export(beam(events=[{"at": 0.02, "remove": {"box": [[0.06, -1, -1], [1, 1, 1]]}}]))
        stage = Usd.Stage.Open(str(path))
        self.assertEqual(UsdGeom.GetStageUpAxis(stage), "Y")
        self.assertEqual(stage.GetTimeCodesPerSecond(), 100)
        self.assertEqual(str(stage.GetDefaultPrim().GetPath()), "/body")
        for k, shown_at in ((1, 0), (2, 3)):
            tissue = UsdGeom.TetMesh(stage.GetPrimAtPath(f"/body/part_{k}/tissue"))
            skin = UsdGeom.Mesh(stage.GetPrimAtPath(f"/body/part_{k}/skin"))
            self.assertEqual(tissue.GetPurposeAttr().Get(), "guide")
            tets, points = tissue.GetTetVertexIndicesAttr().Get(), tissue.GetPointsAttr().Get(shown_at)
            volume = 0
            for tet in tets:
                a, b, c, d = ([float(x) for x in points[n]] for n in tet)
                u, v, w = ([q - p for p, q in zip(a, e)] for e in (b, c, d))
                volume += (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                           + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6
            length = 0.1 if k == 1 else volume / 4e-4
            self.assertAlmostEqual(volume, length * 4e-4, delta=1e-7)
            self.assertGreater(length, 0.04)
            faces = UsdGeom.TetMesh.ComputeSurfaceFaces(tissue, shown_at)
            self.assertEqual({frozenset(f) for f in faces},
                             {frozenset(f) for f in tissue.GetSurfaceFaceVertexIndicesAttr().Get()})
            self.assertEqual(len(skin.GetFaceVertexCountsAttr().Get()), len(glb.triangles(k - 1)))
            self.assertTrue(skin.ValidateTopology(skin.GetFaceVertexIndicesAttr().Get(), skin.GetFaceVertexCountsAttr().Get(),
                                                  len(skin.GetPointsAttr().Get(shown_at)))[0])
        first, second = (UsdGeom.Imageable(stage.GetPrimAtPath(f"/body/part_{k}")) for k in (1, 2))
        for code, visible in ((0, (True, False)), (1, (True, False)), (4, (False, True))):
            self.assertEqual(tuple(p.ComputeVisibility(code) != "invisible" for p in (first, second)), visible)


if __name__ == "__main__":
    unittest.main()
