"""Work done by hand in the window: asked about on quitting, saved as a recording, restored after a kill."""
import json
import subprocess
import unittest

from window_case import BINARY, WindowCase


class Work(WindowCase):
    def pull(self):
        self.drag(self.display.picture().tissue(220, 640), (30, 20), steps=4)

    def left_files(self):
        return list((self.folder / "state" / "heml").glob("unsaved-*.jsonl"))

    def wait_for_left_work(self):
        """Waits until the file has the release, and with it the whole drag."""
        self.wait_for("a file of unsaved work",
                      lambda: any('"release"' in file.read_text() for file in self.left_files()))

    def test_quitting_asks_about_work_and_saves_it(self):
        self.open_display(640, 360)
        self.begin_light()
        self.pull()
        self.play(20)
        self.do("key", "ctrl+q")
        self.do("key", "Escape")
        self.do("key", "ctrl+q")  # it still runs: Esc cancelled
        self.xdo("key", "Return")
        self.finish()
        [saved] = self.folder.glob("heml-*.jsonl")
        keys = [key for line in saved.read_text().splitlines()[1:] for key in json.loads(line)]
        self.assertIn("grasp", keys)
        self.assertIn("release", keys)
        self.assertIn("end", keys)
        replayed = subprocess.run([BINARY, "replay", saved], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertEqual(self.left_files(), [])

    def test_without_work_or_with_a_recording_nothing_is_asked(self):
        self.open_display(640, 360)
        self.begin_light()
        self.do("key", "2", "key", "w")
        self.quit()
        self.begin_light("--record", "out.jsonl")
        self.pull()
        self.quit()
        self.assertEqual(self.left_files(), [])

    def test_work_of_a_killed_program_is_offered_and_restored(self):
        self.open_display(640, 360)
        self.begin_light()
        self.pull()
        self.wait_for_left_work()
        self.end()  # kills it
        [left] = self.left_files()
        tick = json.loads(left.read_text().splitlines()[-1])["step"]
        self.begin_light()
        self.xdo("key", "Return")
        self.wait_for("the time at which it was killed", lambda: self.status().tick >= tick)
        self.settle()
        self.assertEqual(self.status()[1:3], (tick, "paused"))
        self.assertFalse(left.exists(), "the restored work is that of another program now")
        self.do("key", "ctrl+q")
        self.xdo("key", "Right", "key", "Return")  # Discard
        self.finish()
        self.assertEqual(self.left_files(), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
