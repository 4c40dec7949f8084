"""What the tests of the window share: a display (Xvfb), a real mouse and keyboard (xdotool), and waiting for what the
program says that it has drawn. HEML_BINARY names the program."""
import collections
import json
import os
import pathlib
import re
import select
import shutil
import subprocess
import tempfile
import time
import unittest

from display import Display

BINARY = os.environ["HEML_BINARY"]
MISSING = [tool for tool in ("Xvfb", "xdotool") if not shutil.which(tool)]
if MISSING:
    print("skipped: not installed:", ", ".join(MISSING))
PATIENCE = 180  # seconds, for what takes one on a quiet machine

Status = collections.namedtuple("Status", "picture tick motion state key")  # of a line of `--log-pictures`


def light_scene():
    return {
        "schema_version": 1,
        "name": "light",
        "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [2, 2, 2], "origin": [0, 0, 0]}},
        "materials": [{"law": "neo_hookean", "young": 5e3, "poisson": 0.3, "density": 1000}],
        "boundary": [{"box": [[-1, 0.0999, -1], [1, 1, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"step": 0.002, "damping": 1, "threads": 1},
    }


@unittest.skipIf(MISSING, "Xvfb and xdotool are needed")
class WindowCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.log = self.folder / "pictures.log"
        self.descendants = None  # the end of a pipe

    # The program.

    def open_display(self, width, height):
        self.display = Display(self.folder, width, height)
        self.addCleanup(self.display.close)
        self.environment = dict(os.environ, DISPLAY=self.display.name, XDG_STATE_HOME=str(self.folder / "state"))

    def start(self, *arguments):
        """Every process that this begins has an end of a pipe: when all have ended, it has."""
        self.descendants, held = os.pipe()
        with open(self.log, "w") as log:
            self.program = subprocess.Popen([BINARY, "run", "--log-pictures", *map(str, arguments)], cwd=self.folder,
                                            env=self.environment, stdout=subprocess.PIPE, stderr=log, text=True,
                                            pass_fds=(held,))
        os.close(held)
        self.addCleanup(self.end)

    def end(self):
        """So that nobody writes into the folder while it is removed: a video is made to its end without the program."""
        if self.descendants is None:
            return
        self.program.kill()
        self.program.wait()
        self.program.stdout.close()
        ended, _, _ = select.select([self.descendants], [], [], PATIENCE)
        os.close(self.descendants)
        self.descendants = None
        self.assertTrue(ended, "what the program began goes on without it")

    def begin(self, *arguments, colours=200):
        """Starts it, until it shows a scene and takes keys."""
        self.start(*arguments)
        self.wait_for("a picture", lambda: self.display.picture().colours() > colours)
        self.settle()

    def begin_light(self, *arguments, scene=None, size="640x360"):
        file = self.folder / "light.json"
        file.write_text(json.dumps(scene or light_scene()))
        self.begin(file, "--size", size, *arguments)

    def quit(self):
        self.xdo("key", "ctrl+q")
        return self.finish()

    def finish(self):
        out, _ = self.program.communicate(timeout=PATIENCE)
        self.assertEqual(self.program.returncode, 0, self.log.read_text()[-2000:])
        line = r"(\d+) pictures drawn, (\d+) ticks, (\d+) missed deadlines, (\S+) wall seconds .*\n"
        numbers = re.fullmatch(line, out)
        self.assertTrue(numbers, out)
        self.end()
        return int(numbers[1]), int(numbers[2])

    # Mouse and keyboard.

    def xdo(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def do(self, *words):
        """Mouse and keys, until all that came of them is drawn."""
        self.xdo(*words)
        self.settle()

    def drag(self, start, by, steps=8, held=lambda: None):
        self.do("mousemove", *start)
        self.do("mousedown", 1)
        for k in range(1, steps + 1):
            self.do("mousemove", start[0] + by[0] * k // steps, start[1] + by[1] * k // steps)
        held()
        self.do("mouseup", 1)

    # Waiting. Each wait ends by what the program or the screen shows; PATIENCE only bounds it.

    def wait_for(self, what, reached):
        end = time.monotonic() + PATIENCE
        while not reached():
            self.assertIsNone(self.program.poll(), "the program ended early")
            self.assertLess(time.monotonic(), end, f"{what}: not within {PATIENCE} s")
            time.sleep(0.03)  # between two looks

    def status(self):
        """Of the last picture that was drawn."""
        line = r"^picture (\d+), tick (\d+), (\w+), (\w+), key (\d+)$"
        lines = re.findall(line, self.log.read_text(), re.MULTILINE)
        if not lines:
            return Status(0, 0, "running", "busy", 0)
        picture, tick, motion, state, key = lines[-1]
        return Status(int(picture), int(tick), motion, state, int(key))

    def settle(self):
        """What was done before is done: the program has seen a key that was pressed after it, one without a meaning, and
        has nothing left to show, open, list or film."""
        f9, f10 = 298, 299  # as GLFW counts them
        key = f10 if self.status().key == f9 else f9
        self.xdo("key", "F10" if key == f10 else "F9")
        self.wait_for("an answer", lambda: self.status().key == key and self.status().state != "busy")

    def play(self, ticks):
        """Until so many more have gone by in the window."""
        goal = self.status().tick + ticks
        self.wait_for(f"tick {goal}", lambda: self.status().tick >= goal)

    def steady(self):
        """A picture after which nothing changes any more; of a paused body."""
        self.settle()
        self.wait_for("a still picture", lambda: self.status().state == "still")
        last = [None]

        def same():  # the screen may come after the program
            before, last[0] = last[0], self.display.picture()
            return before and before.data == last[0].data

        self.wait_for("a still screen", same)
        return last[0]

    # Recordings.

    def events(self, file="out.jsonl"):
        """The recording so far, without the scene and a line that is still being written."""
        lines = (self.folder / file).read_text().split("\n")[1:-1]
        return [json.loads(line) for line in lines]

    def commands(self, file):
        return [event for event in self.events(file) if "checkpoint" not in event and "end" not in event]

    def seen(self, key, file="out.jsonl"):
        return [event[key] for event in self.events(file) if key in event]

    def wait_for_event(self, key, number=1, file="out.jsonl"):
        self.wait_for(f"{key} in {file}", lambda: len(self.seen(key, file)) >= number)

    def name_in(self, file):
        """Of the scene that is recorded there."""
        path = self.folder / file
        line = path.read_text().split("\n")[0] if path.exists() else ""
        return json.loads(line).get("name") if line.endswith("}") else None

    def wait_for_scene(self, name, file):
        """Recorded there, and in the window."""
        self.wait_for(f"{name} in {file}", lambda: self.name_in(file) == name)
        self.settle()

    def replay(self, file="out.jsonl", *options):
        return subprocess.run([BINARY, "replay", file, "--verify", *options], cwd=self.folder, capture_output=True,
                              text=True, timeout=2 * PATIENCE)

    def verify(self, file="out.jsonl", *options):
        replayed = self.replay(file, *options)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        return replayed.stdout
