"""What is left of the files when the program is killed, or the disk is full, at any moment: under its final name a file
is absent, old or whole, and of a recording all lines but the last can be played. HEML_BINARY is the path of the
program."""
import json
import random
import re
import resource
import signal
import subprocess
import time
import unittest

from program import BINARY, ProgramCase, beam, heml

MOMENTS = 25
TICKS = 120


def busy_beam():
    """A beam whose run spends much of its time writing."""
    return beam(
        solver={"integrator": "verlet", "rate": 1000, "duration": TICKS / 1000, "threads": 1},
        outputs={"times": [k / 1000 for k in range(0, TICKS, 4)], "vtu": True, "history": True},
        events=[{"step": k, "gravity": [0, -9.81 - k, 0]} for k in range(TICKS)])


def limit_of_files(room):
    """Lets no file grow beyond so many bytes: a full disk."""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    return limit


def is_json(text):
    try:
        json.loads(text)
    except ValueError:
        return False
    return True


class Killed(ProgramCase):
    def kill_at_moments(self, *arguments, after):
        """Runs the program again and again; kills it at moments spread over the time it takes, and calls `after`. That
        time is measured again whenever a run ends before its moment: a busy machine may have been slow in the first."""
        def run(moment):
            """Whether it was killed, and how long it was there, s."""
            begin = time.monotonic()
            started = subprocess.Popen([BINARY, *map(str, arguments)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            try:
                started.wait(moment)
            except subprocess.TimeoutExpired:
                started.kill()
            return started.wait() == -signal.SIGKILL, time.monotonic() - begin

        self.assertEqual(heml(*arguments).returncode, 0)
        whole = run(None)[1]
        moments = random.Random(1)
        killed = 0
        for _ in range(10 * MOMENTS):
            was_killed, seconds = run(whole * moments.random())
            killed += was_killed
            if not was_killed:
                whole = min(whole, seconds)
            after()
            if killed == MOMENTS:
                break
        self.assertEqual(killed, MOMENTS, "the program was killed while it ran")

    def assert_whole(self, path):
        """A file of solve under its final name."""
        text = path.read_text()
        self.assertTrue(text.endswith("\n"), path.name)
        if path.suffix == ".json":
            json.loads(text)
        elif path.suffix == ".vtu":
            self.assertTrue(text.endswith("</VTKFile>\n"), path.name)
        elif path.name.startswith("positions"):
            self.assertEqual(len(text.splitlines()), 1 + 7 * 3 * 3, path.name)

    def assert_partial(self, recording):
        """What there is of a recording is played, unless not even its first line is whole."""
        lines = (recording.read_text() if recording.exists() else "").splitlines()
        if lines and not is_json(lines[-1]):
            lines.pop()  # the one that was being written
        checkpoints = sum('"checkpoint"' in line for line in lines)
        done = heml("replay", recording, "--verify", "--partial")
        if checkpoints:
            self.assertEqual(done.returncode, 0, done.stderr)
            compared = re.search(r"(\d+) of (\d+) checkpoints compared", done.stdout)
            self.assertEqual(int(compared[1]), checkpoints, done.stdout)
        elif lines:
            self.assert_refused(done, 1, "no checkpoint")
        else:
            self.assert_refused(done, 3, recording.name)

    def test_solve_leaves_whole_files(self):
        scene, out = self.write("scene.json", busy_beam()), self.folder / "out"

        def after():
            for path in out.iterdir() if out.exists() else ():
                if path.suffix != ".part":
                    self.assert_whole(path)

        self.kill_at_moments("solve", scene, "--out", out, after=after)

    def test_an_old_file_stays_until_the_new_one_is_whole(self):
        self.write("m.json", {"law": "neo_hookean", "young": 1e4, "poisson": 0.3})
        self.write("F.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n" + 20000 * "1,0,0,0,1,0,0,0,1\n")
        table = self.folder / "P.csv"

        def after():
            text = table.read_text()
            self.assertTrue(text == "old\n" or len(text.splitlines()) == 20001, text[-80:])
            table.write_text("old\n")

        self.kill_at_moments("probe", self.folder / "m.json", "--F", self.folder / "F.csv", "--out", table, after=after)

    def test_a_recording_is_played_up_to_where_it_was_killed(self):
        scene, recording = self.write("scene.json", busy_beam()), self.folder / "r.jsonl"

        def after():
            self.assert_partial(recording)
            recording.unlink(missing_ok=True)

        self.kill_at_moments("replay", scene, "--record", recording, after=after)

    def test_a_recording_on_a_full_disk(self):
        scene, recording = self.write("scene.json", busy_beam()), self.folder / "r.jsonl"
        self.assertEqual(heml("replay", scene, "--record", recording).returncode, 0)
        text = recording.read_bytes()
        ends = [k + 1 for k, c in enumerate(text) if c == ord("\n")]
        rooms = {0, 1, 2, ends[0] - 1, ends[0], ends[0] + 1, ends[1] - 1, ends[1], ends[1] + 1, ends[-2], len(text) - 1}
        rooms |= set(random.Random(2).sample(range(len(text)), 10))
        for room in sorted(rooms):
            with self.subTest(room):
                recording.unlink(missing_ok=True)
                done = heml("replay", scene, "--record", recording, preexec_fn=limit_of_files(room))
                self.assert_refused(done, 3, "r.jsonl", "cannot be written")
                self.assertEqual(recording.read_bytes(), text[:room])
                self.assert_partial(recording)
        recording.unlink()
        self.assertEqual(heml("replay", scene, "--record", recording, preexec_fn=limit_of_files(len(text))).returncode, 0)

    def test_solve_on_a_full_disk(self):
        scene, out = self.write("scene.json", busy_beam()), self.folder / "out"
        for room in (0, 1, 500, 2000, 4000, 8000, 16000, 32000):
            with self.subTest(room):
                done = heml("solve", scene, "--out", out, preexec_fn=limit_of_files(room))
                self.assert_refused(done, 3, "cannot be written")
                for path in out.iterdir() if out.exists() else ():
                    self.assertNotEqual(path.suffix, ".part")
                    self.assert_whole(path)


if __name__ == "__main__":
    unittest.main()
