"""Base class of the window tests: a display (Xvfb), mouse and keyboard input (xdotool), and waiting for what the
program reports as drawn. HEML_BINARY is the path of the program."""
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
PATIENCE = 180  # s, time limit for actions that take one on an idle machine

Status = collections.namedtuple("Status", "frame tick motion state key")  # a line of `--log-pictures`


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
        self.descendants = None  # read end of a pipe, see start()
        self.process_options = {}  # of subprocess.Popen, in place of those of start()

    # The program.

    def open_display(self, width, height):
        self.display = Display(self.folder, width, height)
        self.addCleanup(self.display.close)
        self.environment = dict(os.environ, DISPLAY=self.display.name, XDG_STATE_HOME=str(self.folder / "state"))

    def start(self, *arguments):
        """Starts the program. It and its child processes inherit the write end of a pipe, which closes when all of them
        have ended."""
        self.descendants, held = os.pipe()
        with open(self.log, "w") as log:
            options = dict(cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=log, text=True,
                           pass_fds=(held,))
            self.program = subprocess.Popen([BINARY, "run", "--log-pictures", *map(str, arguments)],
                                            **(options | self.process_options))
        os.close(held)
        self.addCleanup(self.end)

    def end(self):
        """Kills the program and waits for its child processes, since ffmpeg finishes a video without it and must not
        write into the folder while that is removed."""
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
        """Starts the program and waits until it shows a scene and accepts keys."""
        self.start(*arguments)
        # The display may still show what a program before drew: the log tells of this one.
        self.wait_for("a picture", lambda: self.status().frame > 0 and self.display.picture().colours() > colours)
        self.settle()

    def write_light(self, scene=None):
        file = self.folder / "light.json"
        file.write_text(json.dumps(scene or light_scene()))
        return file

    def begin_light(self, *arguments, scene=None, size="640x360"):
        self.begin(self.write_light(scene), "--size", size, *arguments)

    def quit(self):
        self.xdo("key", "ctrl+q")
        return self.finish()

    def finish(self):
        out, _ = self.program.communicate(timeout=PATIENCE)
        self.assertEqual(self.program.returncode, 0, self.log.read_text()[-2000:])
        line = r"(\d+) frames drawn, (\d+) ticks, (\d+) missed deadlines, (\S+) wall seconds .*\n"
        numbers = re.fullmatch(line, out)
        self.assertTrue(numbers, out)
        self.end()
        return int(numbers[1]), int(numbers[2])

    # Mouse and keyboard.

    def xdo(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def do(self, *words):
        """Sends mouse and key input and waits until its effects are drawn."""
        self.xdo(*words)
        self.settle()

    def drag(self, start, by, steps=8, held=lambda: None):
        self.do("mousemove", *start)
        self.do("mousedown", 1)
        for k in range(1, steps + 1):
            self.do("mousemove", start[0] + by[0] * k // steps, start[1] + by[1] * k // steps)
        held()
        self.do("mouseup", 1)

    def take_hold(self, left, right):
        """Presses on the tissue, and again where it swung from under the mouse: the picture may be old on a busy
        machine. Returns the place. out.jsonl has no grasp yet."""
        for _ in range(3):
            place = self.display.picture().tissue(left, right)
            self.do("mousemove", *place)
            self.do("mousedown", 1)
            self.play(3)  # commands are recorded with the next tick
            if self.seen("grasp"):
                return place
            self.do("mouseup", 1)
        self.fail("the tissue was missed three times")

    # Waiting. Each wait ends on a condition of the program or the screen; PATIENCE is only the time limit.

    def wait_for(self, what, reached):
        end = time.monotonic() + PATIENCE
        while not reached():
            self.assertIsNone(self.program.poll(), "the program ended early")
            self.assertLess(time.monotonic(), end, f"{what}: not within {PATIENCE} s")
            time.sleep(0.03)  # polling interval

    def status(self):
        """Status line of the last frame drawn."""
        line = r"^frame (\d+), tick (\d+), (\w+), (\w+), key (\d+)$"
        lines = re.findall(line, self.log.read_text(), re.MULTILINE)
        if not lines:
            return Status(0, 0, "running", "busy", 0)
        frame, tick, motion, state, key = lines[-1]
        return Status(int(frame), int(tick), motion, state, int(key))

    def settle(self):
        """Waits until earlier input is processed: sends a key without a meaning and waits until the program has seen it
        and has nothing left to show, open, list or film."""
        f9, f10 = 298, 299  # GLFW key codes
        key = f10 if self.status().key == f9 else f9
        self.xdo("key", "F10" if key == f10 else "F9")
        self.wait_for("an answer", lambda: self.status().key == key and self.status().state != "busy")

    def play(self, ticks):
        """Waits until the window has advanced by so many ticks."""
        goal = self.status().tick + ticks
        self.wait_for(f"tick {goal}", lambda: self.status().tick >= goal)

    def steady(self):
        """Waits until the picture of a paused body no longer changes, and returns it."""
        self.settle()
        self.wait_for("a still picture", lambda: self.status().state == "still")
        last = [None]

        def same():  # the screen may lag behind the program
            before, last[0] = last[0], self.display.picture()
            return before and before.data == last[0].data

        self.wait_for("a still screen", same)
        return last[0]

    # Recordings.

    def events(self, file="out.jsonl"):
        """Events of the recording so far, without the scene line and an incomplete last line."""
        lines = (self.folder / file).read_text().split("\n")[1:-1]
        return [json.loads(line) for line in lines]

    def commands(self, file):
        return [event for event in self.events(file) if "checkpoint" not in event and "end" not in event]

    def seen(self, key, file="out.jsonl"):
        return [event[key] for event in self.events(file) if key in event]

    def wait_for_event(self, key, number=1, file="out.jsonl"):
        self.wait_for(f"{key} in {file}", lambda: len(self.seen(key, file)) >= number)

    def name_in(self, file):
        """Name of the scene recorded in `file`; None: not written yet."""
        path = self.folder / file
        line = path.read_text().split("\n")[0] if path.exists() else ""
        return json.loads(line).get("name") if line.endswith("}") else None

    def wait_for_scene(self, name, file):
        """Waits until the scene is recorded in `file` and shown in the window."""
        self.wait_for(f"{name} in {file}", lambda: self.name_in(file) == name)
        self.settle()

    def replay(self, file="out.jsonl", *options):
        return subprocess.run([BINARY, "replay", file, "--verify", *options], cwd=self.folder, capture_output=True,
                              text=True, timeout=2 * PATIENCE)

    def verify(self, file="out.jsonl", *options):
        replayed = self.replay(file, *options)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        return replayed.stdout
