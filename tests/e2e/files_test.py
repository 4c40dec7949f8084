"""Output files and streams: inputs are never overwritten, and write errors are reported. HEML_BINARY is the path of the
program."""
import json
import os
import resource
import shutil
import threading
import unittest

from program import ProgramCase, beam, heml

SURFACE = """v 0 0 0
v 0.1 0 0
v 0 0.1 0
v 0 0 0.1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""
TET = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 0.1 0 0\n3 0 0.1 0\n4 0 0 0.1\n$EndNodes\n" \
      "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n"


class Files(ProgramCase):
    def assert_refused(self, *arguments):
        super().assert_refused(*arguments, alone=True)

    def content(self):
        return {path.relative_to(self.folder): path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def test_no_command_writes_over_what_it_reads(self):
        self.write("report.json", beam())
        self.write("scene.json", beam())
        self.write("frame_00000.png", beam())
        self.write("frames.pvd", beam())
        self.write("m.json", {"law": "neo_hookean", "young": 1e4, "poisson": 0.3})
        self.write("m.csv", "stretch,stress\n1.1,900\n1.2,1700\n1.3,2400\n")
        self.write("F.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n1,0,0,0,1,0,0,0,1\n")
        self.write("hand.csv", "time,x,y,z\n0,0.1,0.01,0.01\n0.01,0.1,0.01,0.01\n")
        self.write("s.obj", SURFACE)
        self.write("body.msh", TET)
        self.write("positions.csv", "node,x,y,z\n0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0,0,0.1\n")
        self.write("of_files.json", beam(mesh={"file": "body.msh"}, boundary=[], initial={"positions": "positions.csv"}))
        done = heml("replay", "scene.json", "--record", "recovery.jsonl", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        before = self.content()
        for arguments, named in (
                (["solve", "report.json", "--out", "."], "report.json"),
                (["solve", "recovery.jsonl", "--out", "."], "recovery.jsonl"),
                (["solve", "of_files.json", "--out", "."], "positions.csv"),
                (["capture", "frame_00000.png", "--out", ".", "--frames", "2"], "frame_00000.png"),
                (["export", "frames.pvd", "--out", "."], "frames.pvd"),
                (["replay", "scene.json", "--record", "scene.json"], "scene.json"),
                (["replay", "recovery.jsonl", "--record", "./recovery.jsonl"], "recovery.jsonl"),
                (["replay", "of_files.json", "--record", "body.msh"], "body.msh"),
                (["replay", "frame_00000.png", "--frames", "."], "frame_00000.png"),
                (["refine", "scene.json", "--out", "."], "scene.json"),
                (["tune", "scene.json", "--within", "1s", "--quick", "--out", "scene.json"], "scene.json"),
                (["fit", "scene.json", "--data", "m.csv", "--parameter", "gravity[1]", "--out", "m.csv"], "m.csv"),
                (["haptics", "scene.json", "--hand", "hand.csv", "--out", "hand.csv"], "hand.csv"),
                (["probe", "m.json", "--F", "F.csv", "--out", "F.csv"], "F.csv"),
                (["probe", "m.json", "--F", "F.csv", "--out", "m.json"], "m.json"),
                (["bench-test", "m.json", "--data", "m.csv", "--out", "m.csv"], "m.csv"),
                (["bench-test", "m.json", "--data", "m.csv", "--out", "m.txt"], "m.json"),
                (["bench-test", "m.json", "--out", "c.csv", "--plot", "m.json"], "m.json"),
                (["mesh", "body.msh", "--out", "body.msh"], "body.msh"),
                (["study", "accuracy", "--quick", "--scene", "report.html", "--out", "."], "report.html"),
                (["run", "scene.json", "--record", "scene.json"], None)):
            with self.subTest(" ".join(arguments)):
                if named == "report.html":
                    shutil.copy(self.folder / "scene.json", self.folder / "report.html")
                    before = self.content()
                if named is None:
                    continue  # without a display this would capture; the window tests cover recording in the window
                self.assert_refused(heml(*arguments, cwd=self.folder), 3, named, "is read by this run", "another --")
                self.assertEqual(self.content(), before)

    def test_what_cannot_be_written_is_said_before_the_run(self):
        """If the run began before the check, it would take hours."""
        long = self.write("long.json", beam(solver={"duration": 100000, "threads": 1}))
        self.write("hand.csv", "time,x,y,z\n0,0.1,0.01,0.01\n100000,0.1,0.01,0.01\n")
        self.write("file", "")
        for arguments in (["solve", long, "--out", "/proc/none"], ["solve", long, "--out", "file/in"],
                          ["export", long, "--out", "/proc/none"], ["capture", long, "--out", "/proc/none"],
                          ["replay", long, "--frames", "/proc/none"], ["replay", long, "--record", "/proc/none"],
                          ["replay", long, "--record", "none/r.jsonl"], ["refine", long, "--out", "/proc/none"],
                          ["tune", long, "--within", "1s", "--out", "none/t.json"], ["replay", long, "--record", "."],
                          ["haptics", long, "--hand", "hand.csv", "--out", "none/felt.csv"],
                          ["bench", "--json", "none/rows.json"], ["bench", "--out", "/proc/none"],
                          ["study", "stability", "--out", "/proc/none"]):
            with self.subTest(" ".join(map(str, arguments))):
                done = heml(*arguments, cwd=self.folder)
                remedy = "give the name of a file" if arguments[-1] == "." else "another --"
                self.assert_refused(done, 3, str(arguments[-1]), remedy)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["file", "hand.csv", "long.json"])

    def test_a_full_disk_is_exit_3_and_takes_nothing_away(self):
        def full_disk(room=2000):
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            import signal
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        scene = self.write("scene.json", beam())
        out = self.folder / "out"
        self.assertEqual(heml("solve", scene, "--out", out).returncode, 0)
        self.assert_refused(heml("solve", scene, "--out", out, preexec_fn=full_disk), 3, "positions.csv", "cannot be written")
        self.assertEqual(list(out.iterdir()), [], "no part of a file is left")
        self.assert_refused(heml("replay", scene, "--record", self.folder / "r.jsonl",
                                 preexec_fn=lambda: full_disk(800)), 3, "r.jsonl", "cannot be written")
        self.assert_refused(heml("export", scene, "--out", out, "--format", "ply", preexec_fn=full_disk), 3, "frame_00000.ply",
                            "cannot be written")
        self.assert_refused(heml("capture", scene, "--out", out, "--frames", 1, "--size", "320x180", preexec_fn=full_disk),
                            3, "frame_00000.png", "cannot be written")
        self.assertEqual(list(out.iterdir()), [])
        self.write("m.json", {"law": "neo_hookean", "young": 1e4, "poisson": 0.3})
        table = self.write("P.csv", "kept")
        self.write("F.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n" + 500 * "1,0,0,0,1,0,0,0,1\n")
        done = heml("probe", "m.json", "--F", "F.csv", "--out", table, cwd=self.folder, preexec_fn=full_disk)
        self.assert_refused(done, 3, "P.csv", "cannot be written")
        self.assertEqual(table.read_text(), "kept")

    def test_devices_and_pipes_are_written_through(self):
        scene = self.write("scene.json", beam())
        self.write("m.json", {"law": "neo_hookean", "young": 1e4, "poisson": 0.3})
        self.write("F.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n1,0,0,0,1,0,0,0,1\n")
        probe = ["probe", "m.json", "--F", "F.csv", "--out"]
        for arguments in (["replay", scene, "--record", "/dev/full"], [*probe, "/dev/full"],
                          ["bench-test", "m.json", "--out", "/dev/full"]):
            with self.subTest(" ".join(map(str, arguments))):
                self.assert_refused(heml(*arguments, cwd=self.folder), 3, "/dev/full: cannot be written", "No space left")
        self.assertIn("W,P11", heml(*probe, "/dev/stdout", cwd=self.folder).stdout)
        with open(self.folder / "redirected", "w") as file:
            done = heml("bench-test", "m.json", "--out", "/dev/stdout", cwd=self.folder, stdout=file)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "redirected").read_text()
        self.assertTrue(text.startswith("stretch,"))
        self.assertTrue(text.endswith("points in /dev/stdout\n"), text[-80:])
        os.mkfifo(self.folder / "pipe")
        read = []
        reader = threading.Thread(target=lambda: read.append((self.folder / "pipe").read_text()))
        reader.start()
        done = heml("replay", scene, "--record", self.folder / "pipe")
        reader.join()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(json.loads(read[0].splitlines()[-1])["end"])

    def test_standard_output_that_takes_no_more_is_said_once(self):
        scene = self.write("scene.json", beam())
        for arguments in (["materials"], ["materials", "--json"], ["explain", scene], ["explain", scene, "--json"],
                          ["replay", scene], ["--help"], ["solve", scene, "--out", self.folder / "out"], ["--version"]):
            with self.subTest(" ".join(map(str, arguments))), open("/dev/full", "w") as full:
                done = heml(*arguments, stdout=full)
                self.assert_refused(done, 3, "standard output: cannot be written", "space left")

    def test_numbers_that_are_none_are_wrong_usage(self):
        scene = self.write("scene.json", beam())
        self.write("m.json", {"law": "neo_hookean", "young": 1e4, "poisson": 0.3})
        self.write("s.obj", SURFACE)
        commands = {
            "--fps": [["replay", scene], ["capture", scene, "--out", "o"], ["export", scene, "--out", "o"]],
            "--exit-after": [["run", scene]],
            "--draw-stall": [["run", scene]],
            "--scale": [["mesh", "s.obj", "--out", "o.msh"]],
            "--radius-edge-ratio": [["mesh", "s.obj", "--out", "o.msh"]],
            "--max-volume": [["mesh", "s.obj", "--out", "o.msh"]],
            "--error": [["refine", scene, "--out", "o"], ["tune", scene]],
            "--within": [["tune", scene]],
            "--at": [["refine", scene, "--out", "o"]],
            "--stiffest": [["haptics", scene, "--hand", "h", "--out", "o"]],
            "--force": [["haptics", scene, "--hand", "h", "--out", "o"]],
            "--from": [["bench-test", "m.json", "--out", "o"]],
            "--to": [["bench-test", "m.json", "--out", "o"]],
            "--step-stretch": [["bench-test", "m.json", "--test", "relaxation", "--out", "o"]],
        }
        for option, all_of in commands.items():
            for command in all_of:
                for value in ("nan", "inf", "-1", "x") + (("0",) if option == "--fps" else ()):
                    if (option, value) == ("--from", "-1") and "shear" in command:
                        continue
                    with self.subTest(f"{command[0]} {option} {value}"):
                        done = heml(*command, f"{option}={value}", cwd=self.folder)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertIn(option, done.stderr)
        for option, command in (("--frames", ["capture", scene, "--out", "o"]), ("--threads", ["replay", scene]),
                                ("--tets", ["refine", scene, "--out", "o"]), ("--points", ["bench-test", "m.json", "--out", "o"]),
                                ("--case", ["study", "stability", "--out", "o"])):
            for value in ("nan", "1.5", "-1", "99999999999"):
                with self.subTest(f"{command[0]} {option} {value}"):
                    self.assertEqual(heml(*command, f"{option}={value}", cwd=self.folder).returncode, 2)
        self.assertFalse((self.folder / "o").exists())

    def test_threads_have_the_cap_of_scenes(self):
        scene = self.write("scene.json", beam())
        self.assertEqual(heml("replay", scene, "--threads", 256).returncode, 0)
        in_scene = heml("replay", self.write("many.json", beam(solver={"threads": 100000})))
        self.assertEqual(in_scene.returncode, 3)
        done = heml("replay", scene, "--threads", 100000)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--threads", done.stderr)
        for text in (done.stderr, in_scene.stderr):
            self.assertIn("is 100000 (must be a whole number from 0 to 256)", text)


if __name__ == "__main__":
    unittest.main()
