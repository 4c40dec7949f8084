"""Committed recordings replay to the same bits, with one thread and with two. HEML_BINARY is the path of the program.

If a change of results is intended, raise kernel_revision (engine/heml/scenario/build_identity.hpp) and record again
from the scenes of the same names:

    for s in kidney_pull liver_cut kidney_on_table twist; do build/release/app/heml replay assets/scenes/$s.json --record tests/golden/$s.jsonl; done

play_by_hand.py records kidney_by_hand in a window.
"""
import json
import os
import pathlib
import subprocess
import unittest

BINARY = os.environ["HEML_BINARY"]
GOLDEN = sorted((pathlib.Path(__file__).resolve().parents[1] / "golden").glob("*.jsonl"))


class GoldenRecordings(unittest.TestCase):
    def test_each_plays_to_the_same_bits(self):
        self.assertGreaterEqual(len(GOLDEN), 3)
        for recording in GOLDEN:
            checkpoints = sum('"checkpoint"' in line for line in recording.read_text().splitlines())
            for threads in ("1", "2"):
                with self.subTest(recording=recording.name, threads=threads):
                    done = subprocess.run([BINARY, "replay", recording, "--verify", "--threads", threads],
                                          capture_output=True, text=True, timeout=280)
                    if "this processor does not have" in done.stderr:
                        self.skipTest("other instructions")
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    self.assertIn(f"{checkpoints} checkpoints compared", done.stdout)

    def test_one_changed_digit_is_noticed(self):
        lines = GOLDEN[0].read_text().splitlines()
        last = max(k for k, line in enumerate(lines) if "checkpoint" in line)
        checkpoint = json.loads(lines[last])
        first = checkpoint["checkpoint"][0]
        checkpoint["checkpoint"] = ("1" if first == "0" else "0") + checkpoint["checkpoint"][1:]
        lines[last] = json.dumps(checkpoint)
        changed = pathlib.Path(os.environ.get("TMPDIR", "/tmp")) / f"heml-golden-{os.getpid()}.jsonl"
        self.addCleanup(changed.unlink)
        changed.write_text("\n".join(lines) + "\n")
        done = subprocess.run([BINARY, "replay", changed, "--verify"], capture_output=True, text=True, timeout=280)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"step {checkpoint['step']}", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
