"""Committed recordings replay to the same bits, with one thread and with two. HEML_BINARY is the path of the program.

Recordings made with portable kernels (their first line says so) replay on every processor, the others where the
processor has their instruction set.

If a change of results is intended, raise kernel_revision (engine/heml/scenario/build_identity.hpp) and record again from
the scenes of the same names, on a processor with AVX2 and without AVX-512:

    for s in kidney_pull liver_cut kidney_on_table twist; do build/release/app/heml replay assets/scenes/$s.json --record tests/golden/$s.jsonl; done
    for s in kidney_pull liver_cut twist; do python3 tests/golden/record.py build/release/app/heml assets/scenes/$s.json tests/golden/${s}_portable.jsonl; done

play_by_hand.py records kidney_by_hand in a window. kidney_pull and twist stay in format 1: take "format", "kernel_revision"
and "build" out of their first line, "checkpoints" and "hash" out of the last. Where the bits of one stay, its "kernel_revision"
alone is set to the new one.
"""
import json
import unittest

from program import SOURCE, ProgramCase, heml

# The C library's code for processors without FMA, which rounds otherwise; other C libraries than glibc do not read it.
WITHOUT_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA_Usable,-AVX2,-AVX2_Usable,-AVX512F"}
GOLDEN = sorted((SOURCE / "tests" / "golden").glob("*.jsonl"))
PORTABLE = [path for path in GOLDEN
            if json.loads(path.read_text().splitlines()[0])["recorded"]["instructions"] == "portable"]


class GoldenRecordings(ProgramCase):
    def play(self, recording, env=None):
        """Whether it could be played: always, if it is portable."""
        checkpoints = sum('"checkpoint":' in line for line in recording.read_text().splitlines())
        for threads in (1, 2):
            done = heml("replay", recording, "--verify", "--threads", threads, env=env)
            if recording not in PORTABLE and "this processor does not have" in done.stderr:
                return False
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn(f"{checkpoints} of {checkpoints} checkpoints compared", done.stdout)
            self.assertGreater(checkpoints, 2)
        return True

    def test_portable_recordings_play_to_the_same_bits(self):
        self.assertEqual([path.stem for path in PORTABLE], ["kidney_pull_portable", "liver_cut_portable", "twist_portable"])
        for recording in PORTABLE:
            with self.subTest(recording.name):
                self.play(recording)
                self.play(recording, WITHOUT_FMA)

    def test_the_others_play_to_the_same_bits_where_the_processor_has_their_instructions(self):
        others = [path for path in GOLDEN if path not in PORTABLE]
        self.assertGreaterEqual(len(others), 5)
        for recording in others:
            with self.subTest(recording.name):
                if not self.play(recording):
                    self.skipTest("other instructions")

    def test_one_changed_digit_is_noticed(self):
        lines = PORTABLE[-1].read_text().splitlines()
        last = max(k for k, line in enumerate(lines) if '"checkpoint":' in line)
        checkpoint = json.loads(lines[last])
        first = checkpoint["checkpoint"][0]
        checkpoint["checkpoint"] = ("1" if first == "0" else "0") + checkpoint["checkpoint"][1:]
        lines[last] = json.dumps(checkpoint)
        done = heml("replay", self.write("changed.jsonl", "\n".join(lines) + "\n"), "--verify")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"step {checkpoint['step']}", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
