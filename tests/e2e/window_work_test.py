"""Work done by hand in the window: asked about on quitting, saved as a recording, restored after a kill."""
import json
import os
import shutil
import subprocess
import unittest

from window_case import BINARY, WindowCase, light_scene

BAR = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 0.1 0 0
3 0 0.1 0
4 0 0 0.1
5 0.1 0.1 0.1
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 1 1 2 3 4 5
$EndElements
"""


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

    def test_a_recording_does_not_replace_one_that_is_there(self):
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl")
        for wanted in ("another window", "new file"):  # while it is written, and afterwards
            before = (self.folder / "out.jsonl").read_text()
            second = subprocess.run([BINARY, "run", "light.json", "--record", "out.jsonl"], cwd=self.folder,
                                    env=self.environment, capture_output=True, text=True)
            self.assertEqual(second.returncode, 3, second.stderr)
            self.assertIn(wanted, second.stderr)
            self.assertTrue((self.folder / "out.jsonl").read_text().startswith(before))
            if self.descendants is not None:
                self.quit()
        self.verify()

    def test_a_recording_that_failed_is_told_at_the_end_also_where_the_past_is_shown(self):
        pipe = self.folder / "pipe.jsonl"
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        self.process_options = {"restore_signals": False}  # a pipe without a reader is then an error, not a signal
        self.open_display(640, 360)
        self.begin_light("--record", pipe)
        self.play(20)
        os.close(reader)
        self.pull()
        self.play(20)
        self.xdo("key", "space")
        self.do("key", "Home")
        self.do("key", "ctrl+q")
        self.xdo("key", "Right", "key", "Return")  # Discard
        self.program.communicate(timeout=60)
        self.assertEqual(self.program.returncode, 3, self.log.read_text()[-2000:])
        self.assertIn("the recording ended early", self.log.read_text())

    def test_a_scene_is_saved_in_full_when_its_folder_is_gone(self):
        work, home = self.folder / "work", self.folder / "home"
        work.mkdir(), home.mkdir()
        (work / "body.msh").write_text(BAR)
        (work / "bar.json").write_text(json.dumps(dict(light_scene(), name="bar", mesh={"file": "body.msh"})))
        self.open_display(640, 360)
        self.environment["HOME"] = str(home)
        self.process_options = {"cwd": work}
        self.begin("bar.json", "--size", "640x360", colours=50)
        shutil.rmtree(work)
        self.do("key", "ctrl+s")
        self.pull()
        self.do("key", "ctrl+q")
        self.xdo("key", "Return")  # Save
        self.finish()
        [scene] = home.glob("heml-bar-*.json")
        [recording] = home.glob("heml-bar-*.jsonl")
        self.assertEqual(len(list(home.glob("heml-bar-mesh-*.msh"))), 2)
        for file, command in ((scene, ("solve", scene, "--out", home / "out")), (recording, ("replay", recording))):
            with self.subTest(file.suffix):
                done = subprocess.run([BINARY, *command], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)

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
