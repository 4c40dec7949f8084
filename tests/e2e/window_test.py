"""The window as people use it: a display (Xvfb), a real mouse and keyboard (xdotool). HEML_BINARY names the program."""
import json
import mmap
import os
import pathlib
import re
import shutil
import statistics
import struct
import subprocess
import tempfile
import time
import unittest

BINARY = os.environ["HEML_BINARY"]
MISSING = [tool for tool in ("Xvfb", "xdotool") if not shutil.which(tool)]
if MISSING:
    print("skipped: not installed:", ", ".join(MISSING))


class Display:
    """A screen without a monitor, whose pixels are in a file."""

    def __init__(self, folder, width, height):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(folder),
             "-nolisten", "tcp"],
            pass_fds=(write,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()
        self.file = folder / "Xvfb_screen0"

    def close(self):
        self.server.terminate()
        self.server.wait()

    def picture(self):
        """The screen. The file is an X window dump: 25 big-endian words, a name, colours of 12 bytes, pixels."""
        with open(self.file, "rb") as file, mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ) as dump:
            words = struct.unpack(">25I", dump[:100])
            width, height, stride, start = words[4], words[5], words[12], words[0] + 12 * words[19]
            return Picture(width, height, stride, dump[start:start + stride * height])


class Picture:
    """Rows of blue, green, red, nothing."""

    def __init__(self, width, height, stride, data):
        self.width, self.height, self.stride, self.data = width, height, stride, data

    def pixel(self, x, y):
        at = y * self.stride + 4 * x
        blue, green, red = self.data[at:at + 3]
        return red, green, blue

    def places(self, left, right, step=4):
        return [(x, y) for y in range(0, self.height, step) for x in range(left, right, step)]

    def colours(self):
        return len({self.pixel(x, y) for x, y in self.places(0, self.width)})

    def change(self, other, left, right):
        """Mean difference of a channel, 0 to 255, between two columns."""
        places = self.places(left, right)
        return sum(abs(a - b) for p in places for a, b in zip(self.pixel(*p), other.pixel(*p))) / (3 * len(places))

    def tissue(self, left, right):
        """A place in the middle of what is red."""
        def is_red(place):
            red, green, _ = self.pixel(*place)
            return red > 90 and red > 1.7 * green

        red = [place for place in self.places(left, right) if is_red(place)]
        middle = statistics.median(x for x, _ in red), statistics.median(y for _, y in red)
        return min(red, key=lambda p: (p[0] - middle[0]) ** 2 + (p[1] - middle[1]) ** 2)


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
class Window(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def open_display(self, width, height):
        self.display = Display(self.folder, width, height)
        self.addCleanup(self.display.close)
        self.environment = dict(os.environ, DISPLAY=self.display.name, XDG_STATE_HOME=str(self.folder / "state"))

    def start(self, *arguments):
        self.program = subprocess.Popen([BINARY, "run", *map(str, arguments)], cwd=self.folder, env=self.environment,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.program.kill)

    def finish(self):
        out, errors = self.program.communicate(timeout=60)
        self.assertEqual(self.program.returncode, 0, errors)
        line = r"(\d+) pictures drawn, (\d+) ticks, (\d+) missed deadlines, (\S+) wall seconds .*\n"
        numbers = re.fullmatch(line, out)
        self.assertTrue(numbers, out)
        return int(numbers[1]), int(numbers[2])

    def xdo(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def helpers(self):
        """Programs that it has started and that still run."""
        tasks = pathlib.Path(f"/proc/{self.program.pid}/task").glob("*/children")
        return " ".join(task.read_text() for task in tasks).split()

    def films(self):
        return sorted(path for path in self.folder.glob("heml-*") if path.is_dir())

    def wait_for(self, what, reached, seconds=60):
        end = time.monotonic() + seconds
        while not reached():
            self.assertIsNone(self.program.poll(), "the program ended early")
            self.assertLess(time.monotonic(), end, f"{what}: not within {seconds} s")
            time.sleep(0.1)

    def drag(self, start, by, steps=8, held=lambda: None):
        self.xdo("mousemove", *start)
        time.sleep(0.4)
        self.xdo("mousedown", 1)
        time.sleep(0.3)
        for k in range(1, steps + 1):
            self.xdo("mousemove", start[0] + by[0] * k // steps, start[1] + by[1] * k // steps)
            time.sleep(0.06)
        time.sleep(0.5)
        held()
        self.xdo("mouseup", 1)
        time.sleep(0.3)

    def events(self, file="out.jsonl"):
        """The recording so far, without the scene and a line that is still being written."""
        lines = (self.folder / file).read_text().split("\n")[1:-1]
        return [json.loads(line) for line in lines]

    def commands(self, file):
        return [event for event in self.events(file) if "checkpoint" not in event and "end" not in event]

    def name_in(self, file):
        """Of the scene that is recorded there."""
        path = self.folder / file
        line = path.read_text().split("\n")[0] if path.exists() else ""
        return json.loads(line).get("name") if line else None

    def verify(self, file):
        replayed = subprocess.run([BINARY, "replay", file, "--verify"], cwd=self.folder, capture_output=True, text=True,
                                  timeout=400)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)

    def seen(self, key, file="out.jsonl"):
        return [event[key] for event in self.events(file) if key in event]

    def steady(self):
        """A picture after which nothing changes any more; of a paused body."""
        last = [self.display.picture()]

        def same():
            time.sleep(0.5)
            picture = self.display.picture()
            equal = picture.data == last[0].data
            last[0] = picture
            return equal

        self.wait_for("a still picture", same)
        return last[0]

    def play_a_session(self, width, height):
        left, right = (300, 1010) if width >= 1000 else (220, width)  # between the panel's columns
        scale = 1 if width >= 1000 else 0.74
        self.open_display(width, height)
        self.start("--record", "out.jsonl", "--size", f"{width}x{height}")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 500)
        time.sleep(1)

        before, dragged = self.display.picture(), []
        self.drag(before.tissue(left, right), (width // 20, height // 12),
                  held=lambda: dragged.append(self.display.picture()))
        self.wait_for("a release", lambda: self.seen("release"))
        self.assertGreater(dragged[0].change(before, left, right), 1, "the picture does not follow the drag")
        self.assertGreaterEqual(len(self.seen("move")), 3)

        law = json.loads((self.folder / "out.jsonl").read_text().split("\n")[0])["materials"][0]["law"]
        for row in range(10):
            self.drag((int(scale * 170), int(scale * (140 + 13 * row))), (int(scale * 24), 0), steps=4)
            self.xdo("key", "Escape")
            if any(material["law"] == law for material in self.seen("material")):
                break
        self.wait_for("a material", lambda: self.seen("material"), 10)
        if width >= 1000:  # a tissue with published numbers: the list opens under its row
            before = len(self.seen("material"))
            self.xdo("mousemove", 195, 170, "sleep", 0.5, "click", 1, "sleep", 1, "mousemove", 195, 240, "sleep", 0.5, "click", 1)
            self.wait_for("a preset", lambda: len(self.seen("material")) > before, 10)
            self.assertNotEqual(self.seen("material")[-1], self.seen("material")[before - 1])

        self.xdo("mousemove", width - 30, height - 5, "key", "space")
        paused = self.steady()
        self.xdo("mousemove", *paused.tissue(left, right))
        time.sleep(0.4)
        self.xdo("key", "Delete")
        self.wait_for("a removal", lambda: self.seen("remove"))
        self.xdo("mousemove", width - 30, height - 5)
        cut = self.steady()
        self.assertGreater(cut.change(paused, left, right), 0.05, "what was removed is still shown")
        paused = cut
        self.xdo("key", "3")
        self.wait_for("other colours", lambda: self.display.picture().change(paused, left, right) > 3)
        self.xdo("key", "Tab")
        coloured = self.display.picture()
        self.wait_for("a hidden panel", lambda: self.display.picture().change(coloured, 0, int(scale * 250)) > 3)
        self.xdo("key", "p")
        self.wait_for("a saved picture", lambda: list(self.folder.glob("heml-*.png")))
        self.xdo("key", "r", "key", "space")
        self.wait_for("a reset", lambda: self.seen("reset"))
        time.sleep(0.5)
        self.xdo("key", "ctrl+q")
        drawn, ticks = self.finish()
        self.assertGreater(drawn, 10)
        self.assertGreater(ticks, 100)

        order = [key for event in self.events() for key in ("grasp", "move", "release") if key in event]
        self.assertLess(order.index("grasp"), order.index("move"))
        self.assertLess(order.index("move"), order.index("release"))
        replayed = subprocess.run([BINARY, "replay", "out.jsonl", "--verify"], cwd=self.folder, capture_output=True,
                                  text=True, timeout=400)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        [saved] = self.folder.glob("heml-*.png")
        head = saved.read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">2I", head[16:]), (width, height))

    def test_a_session_with_mouse_and_keys_is_recorded_and_replays(self):
        self.play_a_session(1280, 720)

    def test_a_small_window_is_as_usable(self):
        self.play_a_session(640, 360)

    def test_a_scalpel_cuts_and_undo_takes_it_back(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--record", "out.jsonl", "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        self.xdo("mousemove", 638, 358, "key", "c", "key", "space")
        whole = self.steady()
        place = whole.tissue(220, 640)
        self.drag((place[0] - 60, place[1] - 20), (120, 40), steps=12)
        self.wait_for("a cut", lambda: len(self.seen("cut")) >= 3)
        strokes = [cut.get("goes_on", False) for cut in self.seen("cut")]
        self.assertEqual(strokes, [False] + [True] * (len(strokes) - 1))
        self.xdo("mousemove", 638, 358, "key", "space")
        time.sleep(2)
        self.xdo("key", "space")
        self.assertGreater(self.steady().change(whole, 220, 640), 0.05, "the cut does not open")
        self.xdo("key", "ctrl+z")
        self.wait_for("an undo", lambda: self.seen("undo"))
        self.xdo("key", "ctrl+z", "key", "ctrl+q")  # there is nothing more to undo: said, not recorded
        self.finish()
        self.assertEqual(len(self.seen("undo")), 1)
        replayed = subprocess.run([BINARY, "replay", "out.jsonl", "--verify"], cwd=self.folder, capture_output=True,
                                  text=True, timeout=100)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)

    def test_what_was_recorded_before_a_kill_replays(self):
        self.open_display(640, 480)
        self.start("--record", "out.jsonl", "--size", "640x480")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 500)
        time.sleep(1)
        self.drag(self.display.picture().tissue(220, 640), (30, 40), steps=4)
        self.wait_for("a release", lambda: self.seen("release"))
        self.wait_for("a checkpoint after it", lambda: "checkpoint" in self.events()[-1], 60)
        recorded = self.events()
        self.program.kill()
        self.program.wait()
        with open(self.folder / "out.jsonl", "a") as file:
            file.write('{"step": 99')  # as a kill in the middle of a line leaves it
        cut = subprocess.run([BINARY, "replay", "out.jsonl", "--verify"], cwd=self.folder, capture_output=True,
                             text=True, timeout=400)
        self.assertEqual(cut.returncode, 1, cut.stdout + cut.stderr)
        self.assertIn("--partial", cut.stderr)
        replayed = subprocess.run([BINARY, "replay", "out.jsonl", "--verify", "--partial"], cwd=self.folder,
                                  capture_output=True, text=True, timeout=400)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        ticks, checkpoints = map(int, re.match(r"(\d+) ticks replayed, (\d+) of \d+ check", replayed.stdout).groups())
        self.assertGreaterEqual(ticks, recorded[-1]["step"])
        self.assertGreaterEqual(checkpoints, sum("checkpoint" in event for event in recorded))

    def test_pins_table_probe_and_sutures_work_by_mouse_and_keys(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--record", "out.jsonl", "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        place = self.display.picture().tissue(220, 640)
        self.xdo("key", "t")
        self.wait_for("a table", lambda: self.seen("tables"))
        self.xdo("key", "n", "sleep", 0.5, "mousemove", *place, "click", 1)  # a picture between, as for any hand
        self.wait_for("a pin", lambda: self.seen("pin"))
        self.xdo("click", 1)
        self.wait_for("its release", lambda: any("node" in value for value in self.seen("release")))
        self.xdo("key", "o")
        self.drag(place, (30, 10))
        self.wait_for("a withdrawn probe", lambda: "probe" in self.seen("release"))
        self.assertGreaterEqual(len(self.seen("probe")), 3)
        self.xdo("key", "s", "sleep", 0.5, "mousemove", *place, "click", 1)
        time.sleep(0.3)
        self.xdo("mousemove", place[0] + 50, place[1], "click", 1)
        self.wait_for("a suture", lambda: self.seen("suture"))
        self.xdo("key", "ctrl+q")
        self.finish()
        replayed = subprocess.run([BINARY, "replay", "out.jsonl", "--verify"], cwd=self.folder, capture_output=True,
                                  text=True, timeout=100)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)

    def test_a_scene_is_found_by_typing_and_what_was_opened_is_remembered(self):
        self.open_display(1280, 720)
        scene = self.folder / "my_block.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--record", "out.jsonl", "--size", "1280x720")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        self.xdo("mousemove", 1270, 715)
        before = self.display.picture()
        self.xdo("key", "ctrl+o")
        self.wait_for("pictures of scenes", lambda: self.display.picture().change(before, 100, 800) > 8)
        time.sleep(1)
        self.xdo("type", "cantilever")
        time.sleep(0.5)
        self.xdo("key", "Return")
        self.wait_for("the cantilever", lambda: self.name_in("out-2.jsonl") == "cantilever")
        time.sleep(1)
        self.xdo("key", "ctrl+o")
        time.sleep(1)
        self.xdo("key", "Escape", "key", "ctrl+q")  # closed again: the next key is the window's
        self.finish()

        self.start("--record", "again.jsonl", "--size", "1280x720")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        self.xdo("key", "ctrl+o")
        time.sleep(2)
        self.xdo("type", "my_block")
        time.sleep(0.5)
        self.xdo("key", "Return")
        self.wait_for("the first scene", lambda: self.name_in("again-2.jsonl") == "light")
        self.xdo("key", "ctrl+q")
        self.finish()

    def test_an_earlier_moment_is_looked_at_and_resumed_in_a_new_recording(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--record", "out.jsonl", "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        place = self.display.picture().tissue(220, 640)
        self.drag(place, (40, 30))
        self.wait_for("a release", lambda: self.seen("release"))
        time.sleep(2)
        self.drag(place, (-40, 20))
        self.wait_for("another release", lambda: len(self.seen("release")) == 2)
        self.xdo("key", "space", "mousemove", 630, 20)
        present = self.steady()
        self.drag((600, 341), (-260, 0), steps=12)  # along the bar of time
        past = self.steady()
        self.assertGreater(past.change(present, 220, 640), 0.05, "the past looks as the present")
        self.xdo("key", "Escape", "mousemove", 630, 20)
        self.assertLess(self.steady().change(present, 220, 640), 0.01, "the present is not what it was")
        self.drag((600, 341), (-260, 0), steps=12)
        written = (self.folder / "out.jsonl").read_text()
        self.xdo("key", "b")
        self.wait_for("a second recording", lambda: self.name_in("out-2.jsonl") == "light")
        time.sleep(1)
        self.xdo("key", "space")
        time.sleep(1)
        self.drag(self.display.picture().tissue(220, 640), (20, -30))
        self.wait_for("a release", lambda: "release" in self.commands("out-2.jsonl")[-1])
        self.xdo("key", "ctrl+q")
        self.finish()
        self.assertTrue((self.folder / "out.jsonl").read_text().startswith(written), "the old recording was changed")
        old, new = self.commands("out.jsonl"), self.commands("out-2.jsonl")
        shared = next((k for k, pair in enumerate(zip(old, new)) if pair[0] != pair[1]), min(len(old), len(new)))
        self.assertGreater(shared, 0, "nothing of the first recording led to the moment")
        self.assertLess(shared, len(old), "all of the first recording did")
        self.assertGreater(len(new), shared)
        for file in ("out.jsonl", "out-2.jsonl"):
            self.verify(file)

    def test_a_recording_is_resumed_beside_itself(self):
        self.open_display(640, 360)
        scene = dict(light_scene(), events=[{"at": 0.1, "grasp": {"node": 0, "radius": 0.02}},
                                            {"at": 0.4, "move": [0.03, 0.0, 0.0]}, {"at": 1.0, "release": True}])
        (self.folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([BINARY, "replay", "scene.json", "--record", "tape.jsonl"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        tape = (self.folder / "tape.jsonl").read_bytes()
        self.start("tape.jsonl", "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(4)  # past its end
        self.xdo("mousemove", 638, 300, "key", "space")
        self.steady()
        self.xdo("key", "Home", "key", "Right", "key", "Right", "key", "b")
        self.wait_for("a new recording", lambda: self.name_in("tape-2.jsonl") == "light")
        time.sleep(1)
        self.xdo("key", "ctrl+q")
        self.finish()
        self.assertEqual((self.folder / "tape.jsonl").read_bytes(), tape)
        self.verify("tape-2.jsonl")

    def test_laws_side_by_side_are_grasped_looked_back_at_and_resumed_together(self):
        self.open_display(1280, 720)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--beside", "stvk+backward_euler", "--record", "out.jsonl", "--size", "1280x720")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        panes = (300, 650), (665, 1010)  # of what the panel's columns leave free
        before, dragged = self.display.picture(), []
        self.drag(before.tissue(*panes[1]), (60, 40), held=lambda: dragged.append(self.display.picture()))
        self.wait_for("a release", lambda: self.seen("release"))
        for pane in panes:
            self.assertGreater(dragged[0].change(before, *pane), 2, "one of the bodies does not follow the drag")
        self.xdo("mousemove", 1270, 715, "key", "space")
        present = self.steady()
        self.xdo(*["key", "Left"] * 12)
        past = self.steady()
        for pane in panes:
            self.assertGreater(past.change(present, *pane), 0.05, "the past looks as the present")
        self.xdo("key", "b")
        self.wait_for("a second recording", lambda: self.name_in("out-2.jsonl") == "light")
        resumed = self.steady()
        for left, right in panes:
            change = [resumed.change(other, left, right) for other in (past, present)]
            self.assertLess(change[0], change[1] / 2, "it was resumed elsewhere than where one looked")
        self.xdo("key", "ctrl+q")
        self.finish()
        self.assertEqual(len(self.seen("grasp")), 1)
        for file in ("out.jsonl", "out-2.jsonl"):  # of the first body: what is beside it leaves no trace
            self.verify(file)

    def test_colours_are_read_under_the_mouse(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        self.xdo("mousemove", 638, 300, "key", "space")
        x, y = self.steady().tissue(220, 640)

        def light_pixels_beside():  # where the reading stands, right of the mouse
            picture = self.steady()
            return sum(min(picture.pixel(a, b)) > 170 for a in range(x + 12, x + 90) for b in range(y - 8, y + 8))

        self.xdo("mousemove", x, y)
        self.assertLess(light_pixels_beside(), 5, "something is read of tissue without colours")
        self.xdo("key", "2")
        self.assertGreater(light_pixels_beside(), 25, "no reading beside the mouse")
        self.xdo("key", "ctrl+q")
        self.finish()

    def test_a_scene_that_was_saved_opens_the_same(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        saved = []

        def save(file):
            self.start(file, "--size", "640x360")
            self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
            time.sleep(1)
            if not saved:
                self.drag((125, 177), (24, 0), steps=4)
                self.xdo("key", "t", "key", "w", "key", "4")
                time.sleep(1)
            self.xdo("key", "ctrl+s")
            self.wait_for("a file", lambda: len(list(self.folder.glob("heml-*.json"))) > len(saved))
            time.sleep(0.5)
            self.xdo("key", "ctrl+q")
            self.finish()
            saved.append(max(self.folder.glob("heml-*.json"), key=lambda path: path.stat().st_mtime_ns))
            return json.loads(saved[-1].read_text())

        first = save(scene)
        self.assertEqual(first["view"]["field"], "von_mises")
        self.assertTrue(first["view"]["wireframe"])
        self.assertEqual(len(first["tables"]), 1)
        subprocess.run([BINARY, "replay", scene, "--record", "plain.jsonl"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        plain = json.loads((self.folder / "plain.jsonl").read_text().split("\n")[0])
        changed = [key for key in ("materials", "gravity", "mesh", "boundary", "loads") if first[key] != plain[key]]
        self.assertIn(changed, (["materials"], ["gravity"]), "what was dragged, and nothing else, is in the file")
        self.assertEqual(save(saved[0]), first)

    def test_a_film_becomes_pictures_and_a_video_where_ffmpeg_is(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        tools = self.folder / "tools"
        tools.mkdir()
        if not shutil.which("ffmpeg"):  # one that makes a file stands for it
            (tools / "ffmpeg").write_text('#!/bin/sh\nfor last; do :; done\necho video > "$last"\n')
            (tools / "ffmpeg").chmod(0o755)
        self.environment["PATH"] = f"{tools}:{self.environment['PATH']}"
        self.start(scene, "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        time.sleep(1)
        self.xdo("mousemove", 638, 300, "key", "v")
        self.wait_for("pictures", lambda: len(list(self.folder.glob("heml-*/frame_*.png"))) > 20)
        self.xdo("key", "v")
        self.wait_for("a video", lambda: list(self.folder.glob("heml-*.mp4")) + list(self.folder.glob("heml-*.webm")))
        self.wait_for("the video's end", lambda: not self.helpers())
        time.sleep(1)
        self.xdo("key", "v")
        self.wait_for("another film", lambda: len(self.films()) == 2)
        time.sleep(1)
        self.xdo("key", "ctrl+q")  # in the middle of it
        self.finish()
        for folder in self.films():
            numbers = sorted(int(path.stem[6:]) for path in folder.glob("frame_*.png"))
            self.assertEqual(numbers, list(range(len(numbers))))
            for path in folder.glob("frame_*.png"):
                self.assertEqual(struct.unpack(">2I", path.read_bytes()[16:24]), (640, 360))

    def test_slow_drawing_does_not_hold_up_the_engine(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        rates = {}
        for stall in (0, 50):
            self.start(scene, "--size", "320x180", "--exit-after", 6, "--draw-stall", stall)
            drawn, ticks = self.finish()
            rates[stall] = ticks / 6
            self.assertGreater(drawn, 5)
            if stall:
                self.assertLess(drawn, 6 / 0.05, "the stall was not there")
        self.assertGreater(rates[50], 0.9 * rates[0])

    @unittest.skipUnless(shutil.which("compare"), "imagemagick is needed")
    def test_the_window_shows_what_is_captured_without_a_display(self):
        self.open_display(640, 360)
        scene = self.folder / "still.json"
        scene.write_text(json.dumps(dict(light_scene(), gravity=[0, 0, 0])))
        self.start(scene, "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        self.xdo("mousemove", 638, 358)
        self.xdo("key", "Tab")
        time.sleep(1)
        self.xdo("key", "p")
        self.wait_for("a screenshot", lambda: list(self.folder.glob("heml-*.png")))
        time.sleep(1)
        self.xdo("key", "ctrl+q")
        self.finish()
        subprocess.run([BINARY, "capture", scene, "--out", "frames", "--frames", "1", "--size", "640x360"], cwd=self.folder,
                       check=True, stdout=subprocess.DEVNULL)
        shot = next(self.folder.glob("heml-*.png"))
        done = subprocess.run(["compare", "-metric", "RMSE", shot, self.folder / "frames/frame_00000.png", "null:"],
                              stderr=subprocess.PIPE, text=True)
        normalised = float(done.stderr.split("(")[1].split(")")[0])
        self.assertLess(normalised * 255, 3.0)  # the limit of committed frames

    def test_a_paused_window_draws_nothing(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        self.start(scene, "--size", "640x360")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 200)
        self.xdo("mousemove", 600, 350, "key", "space")
        self.steady()
        stat = pathlib.Path(f"/proc/{self.program.pid}/stat")

        def processor_time():
            fields = stat.read_text().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

        before = processor_time()
        time.sleep(3)
        self.assertLess(processor_time() - before, 0.15)
        self.xdo("key", "ctrl+q")
        self.finish()


if __name__ == "__main__":
    unittest.main(verbosity=2)
