"""End-to-end tests of the command line: exit codes, messages, files. HEML_BINARY is the path of the program."""
import csv
import json
import math
import unittest
import xml.etree.ElementTree

from program import SOURCE, ProgramCase, beam, heml

SHARED = SOURCE.parent / "shared" / "data"


def cantilever(**changes):
    return beam(**{
        "name": "cantilever",
        "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [10, 2, 2], "origin": [0, 0, 0]}},
        "solver": {"integrator": "verlet", "duration": 0.1, "damping": 2},
    } | changes)


class CommandLine(ProgramCase):
    def positions(self, scene):
        out = self.folder / "out"
        done = heml("solve", self.write("scene.json", scene), "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "positions.csv") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], ["node", "x", "y", "z"])
        return [tuple(map(float, row[1:])) for row in rows[1:]]

    def test_what_a_command_cannot_do_is_refused_not_left_out(self):
        scene = self.write("scene.json", cantilever())
        done = heml("run", scene, "--record", self.folder / "r.jsonl", cwd=self.folder)  # without a display
        self.assert_refused(done, 2, "--record", "heml replay SCENE --record FILE")
        self.assertEqual(heml("export", scene, "--out", self.folder / "vtu").returncode, 0)
        mesh = sorted((self.folder / "vtu").glob("*.vtu"))[0]
        done = heml("mesh", mesh, "--out", self.folder / "o.msh", "--max-volume", "1e-9")
        self.assert_refused(done, 2, "--max-volume", "surface")

    def test_a_mesh_that_is_all_given_twice_is_refused(self):
        self.write("twice.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                                      "Tetrahedra\n2\n1 2 3 4 0\n1 2 3 4 0\nEnd\n")
        for command in (["explain", "twice.mesh"], ["solve", "twice.mesh", "--out", "o"]):
            self.assert_refused(heml(*command, cwd=self.folder), 3, "twice.mesh", "no surface", "given twice")

    def test_a_cut_beside_the_body_is_warned_of_and_a_refused_event_leaves_what_was_reached(self):
        def blade(x):
            return {"cut": {"sweep": [[[x, -1, -1], [x, -1, 1]], [[x, 1, -1], [x, 1, 1]]]}}

        def sweeps(*xs):
            return [{"step": 5, "cut": dict(blade(x)["cut"], goes_on=k > 0)} for k, x in enumerate(xs)]

        through = heml("solve", self.write("scene.json", cantilever(events=sweeps(0.2, 0.053) + [{"step": 9, "undo": True}])),
                       "--out", self.folder / "through")
        self.assertEqual(through.returncode, 0, through.stderr)
        self.assertNotIn("parted nothing", through.stderr)
        events = sweeps(0.2, 0.3) + [{"step": 9, "undo": True}]
        refused = heml("solve", self.write("scene.json", cantilever(events=events)), "--out", self.folder / "out")
        self.assert_refused(refused, 3, "step 9", "the cut of step 5 parted nothing")
        self.assertEqual(refused.stderr.count("step 5: the cut parted nothing"), 1, refused.stderr)
        self.assertIn(str(self.folder / "out"), refused.stderr)
        report = json.loads((self.folder / "out" / "report.json").read_text())
        self.assertFalse(report["converged"])
        self.assertEqual(report["ticks"], 9)
        self.assertIn("parted nothing", report["refused"])
        self.assertTrue((self.folder / "out" / "positions.csv").exists())

    def test_solve_converges_at_the_order_of_each_integrator(self):
        def run(integrator, step):
            return self.positions(cantilever(solver={"integrator": integrator, "duration": 0.1, "damping": 2, "step": step}))

        def difference(a, b):
            return math.sqrt(sum((p - q) ** 2 for x, y in zip(a, b) for p, q in zip(x, y)) / len(a))

        reference = run("verlet", 1e-5)
        for integrator, order in (("symplectic_euler", 1), ("verlet", 2)):
            errors = [difference(run(integrator, step), reference) for step in (4e-4, 2e-4, 1e-4)]
            self.assertAlmostEqual(math.log2(errors[0] / errors[1]), order, delta=0.2)
            self.assertAlmostEqual(math.log2(errors[1] / errors[2]), order, delta=0.2)

    def test_solve_writes_what_the_contract_lists(self):
        scene = cantilever(outputs={"times": [0.03, 0.0712345], "positions": True})
        out = self.folder / "out"
        done = heml("solve", self.write("scene.json", scene), "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((out / "report.json").read_text())
        for key in ("converged load steps iterations residual wall_seconds kinetic_energy elastic_energy potential_energy "
                    "min_J max_J inverted reaction nodes tets state_hash").split():
            self.assertIn(key, report)
        self.assertTrue(report["converged"])
        self.assertEqual((report["nodes"], report["tets"]), (99, 200))
        self.assertEqual(len(report["reaction"]), 1)
        self.assertTrue((out / "positions_0.csv").exists() and (out / "positions_1.csv").exists())
        again = self.folder / "again"
        heml("solve", self.folder / "scene.json", "--out", again)
        self.assertEqual(report["state_hash"], json.loads((again / "report.json").read_text())["state_hash"])

    def test_export_writes_what_paraview_opens(self):
        out = self.folder / "frames"
        done = heml("export", self.write("scene.json", cantilever()), "--out", out, "--fps", "50")
        self.assertEqual(done.returncode, 0, done.stderr)
        series = xml.etree.ElementTree.parse(out / "frames.pvd").getroot().findall("Collection/DataSet")
        self.assertEqual([float(s.get("timestep")) for s in series], sorted(float(s.get("timestep")) for s in series))
        self.assertEqual(len(series), 6)
        for each in series:
            piece = xml.etree.ElementTree.parse(out / each.get("file")).getroot().find("UnstructuredGrid/Piece")
            count = {"PointData": int(piece.get("NumberOfPoints")), "CellData": int(piece.get("NumberOfCells"))}
            self.assertEqual(count, {"PointData": 99, "CellData": 200})
            for kind, entries in count.items():
                for array in piece.find(kind):
                    self.assertEqual(len(array.text.split()), entries * int(array.get("NumberOfComponents")))

    def test_an_unstable_step_is_exit_4_and_what_was_reached_is_written(self):
        scene = cantilever(solver={"step": 0.01, "duration": 5})
        scene["materials"][0]["young"] = 1e6
        out = self.folder / "out"
        self.assert_refused(heml("solve", self.write("scene.json", scene), "--out", out), 4)
        self.assertFalse(json.loads((out / "report.json").read_text())["converged"])
        self.assertTrue((out / "positions.csv").exists())

    def test_implicit_steps_that_do_not_converge_are_rescued_and_counted_unless_a_step_is_given(self):
        solver = {"integrator": "backward_euler", "duration": 0.1, "rate": 60, "tolerance": 1e-30}
        out = self.folder / "out"
        for young, counted, other in ((1e4, "explicit_rescues", "unconverged_steps"),
                                      (1e9, "unconverged_steps", "explicit_rescues")):
            scene = cantilever(solver=solver)
            scene["materials"][0]["young"] = young
            done = heml("solve", self.write("scene.json", scene), "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("implicit steps did not converge", done.stderr)
            report = json.loads((out / "report.json").read_text())
            self.assertEqual((report[counted], report[other]), (report["ticks"], 0))
            self.assertEqual(report["converged"], report["unconverged_steps"] == 0)
            self.assertEqual(report["unconverged_residual"] > 0, report["unconverged_steps"] > 0)
        scene["solver"]["step"] = 1 / scene["solver"].pop("rate")
        self.assert_refused(heml("solve", self.write("scene.json", scene), "--out", out), 4, "did not converge")
        self.assertEqual(json.loads((out / "report.json").read_text())["unconverged_steps"], 0)

    def test_leaving_the_range_of_a_law_is_exit_4_and_names_the_element(self):
        scene = cantilever()
        scene["boundary"].append({"box": [[0.0999, -1, -1], [1, 1, 1]], "translate": [-0.15, 0, 0], "over": 0.02})
        scene["solver"]["duration"] = 0.2
        self.assert_refused(heml("solve", self.write("scene.json", scene), "--out", self.folder / "out"), 4, "element ")

    def test_probe_agrees_with_the_formula(self):
        material = self.write("m.json", {"law": "neo_hookean", "lambda": 3e4, "mu": 4e3})
        table = self.write("F.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n1.2,0,0,0,0.9,0,0,0,0.95\n-1,0,0,0,1,0,0,0,1\n")
        out = self.folder / "P.csv"
        done = heml("probe", material, "--F", table, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("warning"), 1)
        rows = list(csv.reader(out.read_text().splitlines()))
        self.assertEqual(rows[0][:3], ["W", "P11", "P12"])
        log_J = math.log(1.2 * 0.9 * 0.95)
        W = 2e3 * (1.2**2 + 0.9**2 + 0.95**2 - 3) - 4e3 * log_J + 1.5e4 * log_J**2
        self.assertAlmostEqual(float(rows[1][0]) / W, 1, delta=1e-12)
        self.assertAlmostEqual(float(rows[1][1]) / (4e3 * 1.2 + (3e4 * log_J - 4e3) / 1.2), 1, delta=1e-12)
        self.assertTrue(all(math.isnan(float(cell)) for cell in rows[2]))

    def test_a_script_replays_and_its_hash_is_that_of_solve(self):
        scene = cantilever(events=[
            {"step": 5, "grasp": {"node": 98, "radius": 0.01}},
            {"at": 0.02, "move": [0.12, 0.03, 0.03]},
            {"step": 60, "release": True},
        ])
        path = self.write("session.json", scene)
        done = heml("replay", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("100 ticks", done.stdout)
        heml("solve", path, "--out", self.folder / "out")
        report = json.loads((self.folder / "out" / "report.json").read_text())
        self.assertIn(report["state_hash"], done.stdout)
        for threads in (1, 2):
            self.assertIn(report["state_hash"], heml("replay", path, "--threads", threads).stdout)

    def test_verify_names_step_and_node_that_differ(self):
        scene = cantilever(checkpoints=[{"step": 10, "checkpoint": "0123456789abcdef", "nodes": "0000" * 99}])
        done = heml("replay", self.write("session.json", scene), "--verify")
        self.assert_refused(done, 1, "10", "node")
        nothing = heml("replay", self.write("session.json", cantilever()), "--verify")
        self.assert_refused(nothing, 1, "no checkpoint")

    def test_capture_needs_no_display_and_run_falls_back_to_it(self):
        scene = self.write("scene.json", cantilever())
        out = self.folder / "frames"
        done = heml("capture", scene, "--out", out, "--frames", 3, "--size", "320x180")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in out.iterdir()), [f"frame_0000{k}.png" for k in range(3)])
        header = (out / "frame_00000.png").read_bytes()[:24]
        self.assertEqual((int.from_bytes(header[16:20], "big"), int.from_bytes(header[20:24], "big")), (320, 180))
        fallback = heml("run", scene, cwd=self.folder)
        self.assertEqual(fallback.returncode, 0, fallback.stderr)
        self.assertEqual(len(list((self.folder / "heml-frames").iterdir())), 60)
        self.assertIn("heml-frames", fallback.stderr)

    def test_explain_speaks_to_people_and_to_programs(self):
        scene = self.write("scene.json", cantilever())
        text = heml("explain", scene)
        self.assertEqual(text.returncode, 0, text.stderr)
        for word in ("99 nodes", "200 tetrahedra", "neo_hookean", "verlet", "stable step", "Omitted", "viscosity", "Memory"):
            self.assertIn(word, text.stdout)
        done = heml("explain", scene, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        for key in "scene name body materials method limit solver tools memory startup left_out warnings measured".split():
            self.assertIn(key, told)
        self.assertEqual((told["body"]["tets"], told["body"]["held_nodes"]), (200, 9))
        self.assertEqual([term["name"] for term in told["materials"][0]["terms"]], ["law"])
        self.assertEqual(told["method"]["integrator"], "verlet")
        self.assertIsNone(told["solver"])
        self.assertIsNone(told["measured"])
        self.assertEqual(told["memory"]["all"], sum(v for k, v in told["memory"].items() if k != "all"))
        measured = json.loads(heml("explain", scene, "--json", "--measure").stdout)["measured"]
        self.assertEqual(measured["changes"][0]["feature"], "as it is")
        self.assertIn("precision", [change["feature"] for change in measured["changes"]])
        self.assertIn("rms mm", heml("explain", scene, "--measure").stdout)


    def test_explain_tells_the_mass_that_scaling_adds(self):
        body = cantilever()
        body["solver"]["mass_scaling"] = 0.02
        scaled = self.write("scaled.json", body)
        text = heml("explain", scaled)
        self.assertEqual(text.returncode, 0, text.stderr)
        self.assertRegex(text.stdout, r"mass scaling +2 % of the mass added, at \d+ nodes")
        method = json.loads(heml("explain", scaled, "--json").stdout)["method"]
        self.assertAlmostEqual(method["added_mass"], 0.02, 6)
        self.assertGreater(method["heavier_nodes"], 0)
        del body["solver"]["mass_scaling"]
        plain = json.loads(heml("explain", self.write("plain.json", body), "--json").stdout)["method"]
        self.assertEqual((plain["added_mass"], plain["heavier_nodes"]), (0, 0))
        self.assertLess(plain["stable_step"], method["stable_step"])
        body["solver"]["mass_scaling"] = 1.5
        refused = heml("solve", self.write("heavy.json", body), "--out", self.folder / "out")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("solver.mass_scaling", refused.stderr)

    def test_explain_says_where_a_body_has_no_stable_step(self):
        tiny = cantilever()
        tiny["mesh"] = {"box": {"size": [1e-7, 1e-7, 1e-7], "cells": [4, 4, 4]}}
        tiny["boundary"] = [{"box": [[-1, -1, -1], [1, 1, 1e-9]], "fix": True}]
        tiny["solver"] = {"integrator": "verlet", "precision": "float", "duration": 0.01}
        text = heml("explain", self.write("tiny.json", tiny))
        self.assertIn("none: the stiffness of the body is no number that single precision can hold", text.stdout)
        for word in ("nan", "inf "):
            self.assertNotIn(word, text.stdout)

    def test_every_shipped_scene_is_explained(self):
        scenes = sorted((SOURCE / "assets" / "scenes").glob("*.json"))
        self.assertGreater(len(scenes), 3)
        for path in scenes:
            with self.subTest(path.name):
                done = heml("explain", path, "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                told = json.loads(done.stdout)
                self.assertEqual(told["name"], path.stem)
                self.assertNotIn("halted", [warning["about"] for warning in told["warnings"]])

    def test_a_tetrahedral_scene_is_solved_without_drawing_or_meshing_libraries(self):
        """Checks the dynamic loader's log of mapped libraries, child processes included."""
        def loaded(*arguments):
            record = self.folder / "record"
            record.mkdir(exist_ok=True)
            done = heml(*arguments, env={"LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(record / "ld")})
            self.assertEqual(done.returncode, 0, done.stderr)
            text = "".join(path.read_text(errors="replace") for path in record.iterdir())
            for path in record.iterdir():
                path.unlink()
            return text

        scene = self.write("scene.json", cantilever())
        drawing = loaded("capture", scene, "--out", self.folder / "frames", "--frames", 1, "--size", "64x64")
        if "libc.so" not in drawing:
            self.skipTest("this loader keeps no record")
        self.assertIn("libOSMesa", drawing, "the record would show it")
        for arguments in (["solve", scene, "--out", self.folder / "out"], ["explain", scene], ["replay", scene]):
            record = loaded(*arguments)
            self.assertIn("libc.so", record)
            for library in ("libOSMesa", "libGL.", "libGLX", "libEGL", "libassimp", "libtet", "libLLVM"):
                self.assertNotIn(library, record, arguments)

    def test_refine_writes_a_scene_that_stands_alone(self):
        scene = self.write("scene.json", cantilever())
        out = self.folder / "fine"
        done = heml("refine", scene, "--out", out, "--error", 45, "--tets", 3000)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("tetrahedra, estimated error", done.stdout)
        scene.unlink()
        explained = json.loads(heml("explain", out / "scene.json", "--json").stdout)
        self.assertGreater(explained["body"]["tets"], 200)
        few = heml("refine", out / "scene.json", "--out", self.folder / "same", "--error", 1, "--tets", 100)
        self.assertEqual(few.returncode, 1)
        self.assertIn("--tets", few.stderr)
        asking = cantilever(mesh=dict(cantilever()["mesh"], refine={"error": 0.45, "tets": 3000}))
        loaded = json.loads(heml("explain", self.write("asking.json", asking), "--json").stdout)
        self.assertEqual(loaded["body"]["tets"], explained["body"]["tets"])

    def test_a_recorded_hand_feels_the_tissue_every_millisecond(self):
        scene = cantilever(events=[{"step": 1, "grasp": {"point": [0.1, 0.01, 0.01], "radius": 0.012}}],
                           solver={"integrator": "backward_euler", "step": 1 / 60, "duration": 0.5, "damping": 2})
        hand = self.write("hand.csv", "time,x,y,z\n0,0.1,0.01,0.01\n0.1,0.1,0.01,0.01\n0.5,0.1,0.03,0.01\n")
        done = heml("haptics", self.write("scene.json", scene), "--hand", hand, "--out", self.folder / "felt.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "felt.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertGreaterEqual(len(rows), 500)
        for k, row in enumerate(rows):
            self.assertAlmostEqual(float(row["time"]), k / 1000, places=9)
        self.assertLess(float(rows[490]["fy"]), -0.01, "pulled up, it pulls down")
        self.assert_refused(heml("haptics", self.folder / "scene.json", "--hand", self.write("no.csv", "a\n"), "--out",
                                 self.folder / "felt.csv"), 3, "no.csv", "line 1", "time,x,y,z")

    def test_installed_scenes_are_found_by_name_where_no_file_has_it(self):
        here = self.folder / "by_name"
        here.mkdir()
        by_name = heml("explain", "strip_tears", "--json", cwd=here)
        self.assertEqual(by_name.returncode, 0, by_name.stderr)
        self.assertEqual(json.loads(by_name.stdout)["name"], "strip_tears")
        missing = heml("solve", "no_such_scene", "--out", here / "out", cwd=here)
        self.assertEqual(missing.returncode, 3)
        self.assertIn("no_such_scene", missing.stderr)

    def test_wrong_usage_is_exit_2(self):
        scene = self.write("scene.json", cantilever())
        for arguments in (["capture", scene], ["bogus"], ["solve", scene], ["capture", scene, "--out", "x", "--size", "big"],
                          ["capture", scene, "--out", "x", "--frames", "0"], ["probe"], ["mesh", "a.obj", "--out", "a.txt"],
                          ["replay", scene, "--fps", "-3"], ["explain"]):
            self.assertEqual(heml(*arguments, cwd=self.folder).returncode, 2, arguments)
        self.assertEqual(heml("--help").returncode, 0)

    def test_bad_input_is_one_message_and_exit_3(self):
        def changed(**changes):
            return json.dumps(cantilever(**changes))

        material = cantilever()["materials"][0]
        tet = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 {x} 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n{e}$EndElements\n"
        whole = "1\n1 4 2 5 5 1 2 3 4\n"
        self.write("nan.msh", tet.format(x="nan", e=whole))
        self.write("empty.msh", tet.format(x="1", e="0\n"))
        self.write("one.msh", tet.format(x="0.1", e=whole))
        self.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        table = [
            ("no such file", None, ["missing.json"]),
            ("broken JSON", '{"schema_version": 1,', ["line 1"]),
            ("unknown key", changed(gravitation=[0, 0, 0]), ["gravitation", "gravity"]),
            ("NaN coordinate", changed(mesh={"file": "nan.msh"}), ["nan.msh", "line 7"]),
            ("open surface", changed(mesh={"surface": "open.obj"}), ["open.obj", "open"]),
            ("zero tetrahedra", changed(mesh={"file": "empty.msh"}), ["empty.msh", "tetrahedra"]),
            ("region without material", changed(mesh={"file": "one.msh"}, boundary=[], materials=[dict(material, region=1)]),
             ["region 5"]),
            ("negative density", changed(materials=[dict(material, density=-1)]), ["materials[0].density"]),
            ("Poisson 0.5", changed(materials=[dict(material, poisson=0.5)]), ["materials[0].poisson", "0.49"]),
            ("no such law", changed(materials=[{"law": "steel"}]), ["materials[0].law", "stvk"]),
            ("empty selection", changed(boundary=[{"box": [[5, 5, 5], [6, 6, 6]], "fix": True}]), ["boundary[0]"]),
            ("node that is not there", changed(boundary=[{"nodes": [100000], "fix": True}]), ["boundary[0]"]),
        ]
        for name, text, words in table:
            with self.subTest(name):
                path = self.folder / "missing.json" if text is None else self.write("scene.json", text)
                for command in (["solve", path, "--out", self.folder / "out"], ["capture", path, "--out", self.folder / "out"],
                                ["explain", path]):
                    done = heml(*command)
                    self.assert_refused(done, 3, *words)
                    self.assertFalse((self.folder / "out").exists(), "no surprise files")

    def test_a_surface_becomes_a_mesh_that_can_be_solved(self):
        corners, sides = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1)], [(1, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4)]
        surface = self.write("s.obj", "".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                             "".join(f"f {a} {b} {c}\n" for a, b, c in sides))
        done = heml("mesh", surface, "--out", self.folder / "s.msh")
        self.assertEqual(done.returncode, 0, done.stderr)
        scene = cantilever(mesh={"file": "s.msh"}, solver={"integrator": "static"})
        done = heml("solve", self.write("scene.json", scene), "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((self.folder / "out" / "report.json").read_text())
        self.assertEqual((report["nodes"], report["tets"]), (4, 1))

    def test_from_a_surface_to_frames_in_one_command(self):
        liver = SHARED / "liver2.obj"
        if not liver.exists():
            self.skipTest("no surfaces by others here")
        done = heml("capture", liver, "--out", self.folder / "frames", "--frames", 2, "--size", "320x180")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(list((self.folder / "frames").iterdir())), 2)


if __name__ == "__main__":
    unittest.main()
