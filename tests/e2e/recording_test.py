"""`heml replay --verify`: which alterations of recordings it detects, and its messages. HEML_BINARY is the path of the
program."""
import json
import unittest

from program import SOURCE, ProgramCase, beam, heml

GOLDEN = SOURCE / "tests" / "golden" / "twist.jsonl"


def pulled_beam(**changes):
    return beam(**{
        "name": "beam",
        "solver": {"integrator": "verlet", "duration": 0.5, "damping": 2},
        "events": [{"step": 150, "grasp": {"point": [0.1, 0.01, 0.01], "radius": 0.012}},
                   {"step": 151, "move": [0.11, 0.02, 0.01]}, {"step": 190, "move": [0.1, 0.02, 0.02]},
                   {"step": 260, "release": True}],
    } | changes)


class Recordings(ProgramCase):
    def record(self, scene, code=0):
        (self.folder / "scene.json").write_text(json.dumps(scene))
        file = self.folder / "r.jsonl"
        done = heml("replay", self.folder / "scene.json", "--record", file)
        self.assertEqual(done.returncode, code, done.stderr)
        return [json.loads(line) for line in file.read_text().splitlines()]

    def verify(self, lines, *options):
        file = self.folder / "altered.jsonl"
        file.write_text("".join(json.dumps(line) + "\n" for line in lines))
        return heml("replay", file, "--verify", *options)

    def test_a_recording_ends_with_what_proves_it(self):
        lines = self.record(pulled_beam())
        self.assertEqual(lines[0]["recorded"]["format"], 2)
        end, checkpoints = lines[-1], [line for line in lines if "checkpoint" in line]
        self.assertEqual(end, {"step": 500, "end": True, "checkpoints": 6, "hash": checkpoints[-1]["checkpoint"]})
        done = self.verify(lines)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("6 of 6 checkpoints compared", done.stdout)
        self.assertEqual(done.stderr, "")

    def test_every_alteration_is_exit_1(self):
        lines = self.record(pulled_beam())
        places = [k for k, line in enumerate(lines) if "checkpoint" in line]

        def altered(change):
            copy = json.loads(json.dumps(lines))
            change(copy)
            return copy

        def other_digit(text):
            return ("1" if text[0] == "0" else "0") + text[1:]

        def end_at(copy, step):
            copy[-1]["step"] = step

        def swap_moves(copy):
            first, second = (line for line in copy if "move" in line)
            first["move"], second["move"] = second["move"], first["move"]

        changes = {
            "the end moved": lambda c: end_at(c, 50),
            "the end moved behind": lambda c: end_at(c, 501),
            "the second half dropped": lambda c: c.__delitem__(slice(places[2] + 1, len(c) - 1)),
            "no end": lambda c: c.pop(),
            "a checkpoint dropped": lambda c: c.pop(places[3]),
            "a state's hash": lambda c: c[places[2]].update(checkpoint=other_digit(c[places[2]]["checkpoint"])),
            "a node's hash": lambda c: c[places[4]].update(nodes=other_digit(c[places[4]]["nodes"])),
            "the end's hash": lambda c: c[-1].update(hash=other_digit(c[-1]["hash"])),
            "the end's count": lambda c: c[-1].update(checkpoints=5),
            "a halt that never was": lambda c: c[-1].update(halt="unstable"),
            "an event": lambda c: [line for line in c if "move" in line][0].update(move=[0.11, 0.02, 0.0101]),
            "two events swapped": swap_moves,
            "an event dropped": lambda c: c.remove([line for line in c if "release" in line][0]),
            "another kernel revision": lambda c: c[0]["recorded"].update(kernel_revision=0),
        }
        for name, change in changes.items():
            with self.subTest(name):
                done = self.verify(altered(change))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertRegex(done.stdout, r"\d+ of \d+ checkpoints compared")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        revision = self.verify(altered(changes["another kernel revision"])).stderr
        self.assertRegex(revision, r"kernel revision 0 .*revision [1-9]\d*: .*cannot be compared")
        self.assertIn("5 of 6 checkpoints compared", self.verify(altered(changes["a checkpoint dropped"])).stdout)
        differs = self.verify(altered(changes["a state's hash"]))
        self.assertIn("6 of 6 checkpoints compared", differs.stdout)
        self.assertIn("differs at step 200", differs.stderr)
        # Each line names its step: their order in the file says nothing.
        shuffled = altered(lambda c: c.insert(3, c.pop(4)))
        self.assertEqual(self.verify(shuffled).returncode, 0)

    def test_what_is_no_recording_is_exit_3(self):
        lines = self.record(pulled_beam())
        text = "".join(json.dumps(line) + "\n" for line in lines)
        last = len(lines)
        unknown = json.loads(json.dumps(lines))
        unknown[0]["recorded"]["format"] = 3
        for name, content, *words in (
                ("empty", "", "is empty"),
                ("blank", "\n\n", "is empty"),
                ("a later format", "".join(json.dumps(line) + "\n" for line in unknown), "recorded.format"),
                ("garbage at the end", text + "garbage\n", f"line {last + 1}", "not valid JSON"),
                ("garbage without line end", text + "garbage", f"line {last + 1}", "not valid JSON"),
                ("an event after the end", text + '{"step": 500, "release": true}\n', f"line {last + 1}", "after the end"),
                ("a second end", text + json.dumps(lines[-1]) + "\n", f"line {last + 1}", "second end")):
            with self.subTest(name):
                file = self.write("altered.jsonl", content)
                self.assert_refused(heml("replay", file, "--verify"), 3, file.name, *words, alone=True)

    def test_a_recording_cut_anywhere_is_exit_1(self):
        self.record(pulled_beam())
        text = (self.folder / "r.jsonl").read_text()
        for size in (len(text) // 2, len(text) - 5):
            done = heml("replay", self.write("cut.jsonl", text[:size]), "--verify")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("cut off in the middle", done.stderr)
            self.assertIn("no end record", done.stderr)

    def test_instructions_of_a_recording(self):
        lines = self.record(pulled_beam())
        file = self.folder / "portable.jsonl"
        done = heml("replay", self.folder / "r.jsonl", "--record", file, "--instructions", "portable")
        self.assertEqual(done.returncode, 0, done.stderr)
        portable = [json.loads(line) for line in file.read_text().splitlines()]
        self.assertEqual(portable[0]["recorded"]["instructions"], "portable")
        self.assertEqual(heml("replay", file, "--verify").returncode, 0)
        if lines[0]["recorded"]["instructions"] != "portable":
            self.assertNotEqual(portable[-1]["hash"], lines[-1]["hash"])
        done = heml("replay", file, "--record", self.folder / "x.jsonl", "--instructions", "sse")
        self.assert_refused(done, 2, "sse", "this processor has portable")
        self.assertEqual(heml("replay", file, "--instructions", "portable").returncode, 2)
        self.assertEqual(heml("replay", file, "--verify", "--record", self.folder / "x.jsonl", "--instructions", "portable").returncode, 2)

    def test_partial_verifies_what_a_crash_left(self):
        lines = self.record(pulled_beam())
        cut = lines[:-3]
        self.assertEqual(self.verify(cut).returncode, 1)
        done = self.verify(cut, "--partial")
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in cut:
            if line.get("step") == 300 and "checkpoint" in line:
                line["checkpoint"] = "0" * 16
        self.assertEqual(self.verify(cut, "--partial").returncode, 1)
        self.assertEqual(heml("replay", self.folder / "r.jsonl", "--partial").returncode, 2)

    def test_recordings_without_a_format(self):
        whole = [json.loads(line) for line in GOLDEN.read_text().splitlines()]
        self.assertNotIn("format", whole[0]["recorded"])
        done = self.verify(whole)
        if "this processor does not have" in done.stderr:
            self.skipTest("other instructions")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "^heml: warning: .*format 1.*--record")
        places = [k for k, line in enumerate(whole) if "checkpoint" in line]
        for name, lines in (("end moved", whole[:-1] + [{"step": 50, "end": True}]), ("no end", whole[:-1]),
                            ("the last dropped", whole[:places[-1]] + whole[-1:]),
                            ("the first alone", whole[:places[0] + 1] + whole[-1:])):
            with self.subTest(name):
                self.assertEqual(self.verify(lines).returncode, 1)

    def test_a_halt_is_recorded_shown_again_and_verifies(self):
        scene = pulled_beam(events=[], gravity=[0, 0, 0])
        scene["boundary"].append({"box": [[0.0999, -1, -1], [1, 1, 1]], "translate": [-0.15, 0, 0], "over": 0.1})
        scene["solver"] = {"integrator": "verlet", "duration": 0.2, "rate": 30, "threads": 1}
        end = self.record(scene, code=4)[-1]
        self.assertIn("left the range of its law", end["halt"])
        done = heml("replay", self.folder / "r.jsonl", "--verify")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"stopped at step {end['step']}, as recorded: {end['halt']}", done.stdout)
        self.assertEqual(heml("replay", self.folder / "r.jsonl").returncode, 4)
        lines = [json.loads(line) for line in (self.folder / "r.jsonl").read_text().splitlines()]
        lines[-1].pop("halt")
        done = self.verify(lines)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"its end at step {end['step']} says that the run halted, and not why", done.stderr)
        lines[-1]["halt"] = "unstable"
        self.assertEqual(self.verify(lines).returncode, 1)

    def test_the_recording_of_a_recovery_verifies(self):
        scene = pulled_beam(gravity=[0, 0, 0], events=[{"step": 10, "gravity": [-30000, 0, 0]}, {"step": 12, "gravity": [0, 0, 0]}])
        scene["solver"] = {"integrator": "backward_euler", "rate": 60, "duration": 2, "recovery": True}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        done = heml("solve", self.folder / "scene.json", "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = heml("replay", self.folder / "out" / "recovery.jsonl", "--verify")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("format 1"), 0)


if __name__ == "__main__":
    unittest.main()
