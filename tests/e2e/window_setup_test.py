"""A scene set up by mouse in the window: nodes are selected, fixed and loaded, undone, recorded, and saved into a scene
that gives the same bits."""
import json
import subprocess
import unittest

from window_case import BINARY, WindowCase, light_scene


def loose_scene():
    """A box that nothing holds, seen from the front: 4 cells, 5 nodes along each side."""
    box = {"size": [0.1, 0.1, 0.1], "cells": [4, 4, 4], "origin": [0, 0, 0]}
    return {**light_scene(), "mesh": {"box": box}, "boundary": [], "gravity": [0, 0, 0], "view": {"side": "front"}}


def nodes(chosen):
    return [x + 5 * (y + 5 * z) for z in range(5) for y in range(5) for x in range(5) if chosen(x, y, z)]


class Setup(WindowCase):
    def begin_paused(self):
        self.open_display(1280, 720)
        (self.folder / "loose.json").write_text(json.dumps(loose_scene()))
        self.begin("loose.json", "--record", "out.jsonl", "--size", "1280x720")
        self.xdo("mousemove", 1276, 716, "key", "space", "key", "r")
        picture = self.steady()
        red = [(x, y) for x, y in picture.red(350, 1010) if y > 120]
        xs, ys = [x for x, _ in red], [y for _, y in red]
        self.left, self.right, self.top, self.bottom = min(xs), max(xs), min(ys), max(ys)
        self.do("key", "e")
        return picture

    def at(self, across, up):
        """A place on the front of the box, 0 to 1 from its left and its lower edge."""
        return (round(self.left + across * (self.right - self.left)),
                round(self.bottom - up * (self.bottom - self.top)))

    def select(self, corner, other, key=None):
        a, b = self.at(*corner), self.at(*other)
        if key:
            self.xdo("keydown", key)
        self.drag(a, (b[0] - a[0], b[1] - a[1]), steps=3)
        if key:
            self.xdo("keyup", key)

    def press(self, x, y):
        self.do("mousemove", x, y, "click", 1)
        self.do("mousemove", 1276, 716)

    FIX, FREE, LOAD = (81, 228), (205, 228), (81, 298)  # in the panel

    def test_selected_nodes_are_fixed_and_loaded_undone_and_saved_with_the_same_bits(self):
        before = self.begin_paused()
        self.select((-0.05, 1.05), (1.05, 0.9))  # the upper edge, from outside the box
        self.do("mousemove", 1276, 716)
        self.assertGreater(self.steady().change(before, 350, 1010), 0.05, "no dots")
        self.press(*self.FIX)
        self.press(*self.FREE)
        self.do("key", "ctrl+z")
        self.select((0.6, 0.15), (1.05, -0.05))
        self.select((0.9, 0.15), (1.05, -0.05), key="Control_L")
        self.press(*self.LOAD)
        self.do("key", "ctrl+z", "key", "ctrl+shift+z")
        self.do("key", "space")
        self.play(60)
        self.do("key", "space")
        self.do("key", "ctrl+s")
        self.wait_for("a saved scene", lambda: list(self.folder.glob("heml-light-*.json")))
        self.quit()

        front = {"fixed": nodes(lambda x, y, z: y == 4 and z == 4),
                 "pulled": nodes(lambda x, y, z: y == 0 and z == 4 and x == 3)}
        fixed, freed = self.seen("boundary")
        self.assertEqual([entry["nodes"] for entry in fixed], [front["fixed"]])
        self.assertEqual(freed, [])
        [loads] = self.seen("loads")
        self.assertEqual([entry["nodes"] for entry in loads], [front["pulled"]])
        self.assertEqual(self.seen("history"), [-1, -1, 1])
        self.verify()

        [saved] = self.folder.glob("heml-light-*.json")
        scene = json.loads(saved.read_text())
        self.assertEqual([entry["nodes"] for entry in scene["boundary"]], [front["fixed"]])
        self.assertEqual([entry["force"] for entry in scene["loads"]], [[0, 0.1, 0]])
        self.assertEqual(scene.get("events", []), [])
        end = self.events()[-1]
        ticks = end["step"] - max(event["step"] for event in self.events() if "history" in event or "loads" in event)
        scene["solver"]["duration"] = 0.002 * ticks
        saved.write_text(json.dumps(scene))
        subprocess.run([BINARY, "solve", saved, "--out", "solved"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads((self.folder / "solved/report.json").read_text())
        self.assertEqual(report["state_hash"], end["hash"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
