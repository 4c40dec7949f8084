"""A scene set up by mouse in the window: nodes are selected, fixed, loaded, pinned and tagged as a region, arrows are
dragged; all is undone, recorded, and saved into a scene that gives the same bits."""
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

    FIX, FREE, LOAD = (81, 254), (205, 254), (81, 324)  # in the panel
    THROUGH, ALONG, TAG = (33, 166), (191, 228), (81, 420)

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

        scene = self.saved()
        self.assertEqual([entry["nodes"] for entry in scene["boundary"]], [front["fixed"]])
        self.assertEqual([entry["force"] for entry in scene["loads"]], [[0, 0.1, 0]])
        self.assertEqual(scene.get("events", []), [])
        self.solves_to_the_same(scene)

    def test_nodes_are_fixed_in_one_direction_and_slide_in_the_others(self):
        self.begin_paused()
        self.select((-0.05, 1.05), (1.05, 0.9))
        self.press(*self.ALONG)
        self.press(141, 298)  # y
        self.press(*self.FIX)
        self.do("key", "space")
        self.play(30)
        self.do("key", "space")
        self.save()
        self.quit()
        [fixed] = self.seen("boundary")
        self.assertEqual([entry["axes"] for entry in fixed], ["y"])
        self.verify()
        scene = self.saved()
        self.assertEqual([entry["axes"] for entry in scene["boundary"]], ["y"])

    def saved(self):
        [file] = self.folder.glob("heml-light-*.json")
        return json.loads(file.read_text())

    def solves_to_the_same(self, scene):
        """Whether the scene, run for as long as the window did after the last change, ends in the recording's bits."""
        end = self.events()[-1]
        changes = ("history", "loads", "region", "reset", "gravity")
        ticks = end["step"] - max(event["step"] for event in self.events() if any(key in event for key in changes))
        scene["solver"]["duration"] = 0.002 * ticks
        (self.folder / "again.json").write_text(json.dumps(scene))
        subprocess.run([BINARY, "solve", "again.json", "--out", "solved"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads((self.folder / "solved/report.json").read_text())
        self.assertEqual(report["state_hash"], end["hash"])

    def save(self):
        self.do("key", "ctrl+s")
        self.wait_for("a saved scene", lambda: list(self.folder.glob("heml-light-*.json")))

    def test_selected_tissue_is_a_region_that_is_undone_and_saved_with_the_same_bits(self):
        self.begin_paused()
        self.press(*self.THROUGH)
        self.select((-0.05, 1.05), (0.55, -0.05))  # the left half, inside too
        self.press(*self.TAG)
        self.do("key", "ctrl+z", "key", "ctrl+shift+z")
        self.do("key", "space")
        self.play(30)
        self.do("key", "space")
        self.save()
        self.quit()
        [tag] = self.seen("region")
        self.assertEqual(tag["name"], "part 1")
        self.assertEqual(tag["nodes"], nodes(lambda x, y, z: x <= 2))
        self.assertEqual(self.seen("history"), [-1, 1])
        self.verify()
        scene = self.saved()
        [region] = scene["regions"]
        self.assertEqual((region["name"], region["number"], len(region["tets"])), ("part 1", 1, 2 * 4 * 4 * 5))
        self.assertEqual([entry.get("region") for entry in scene["materials"]], [None, 1])
        self.solves_to_the_same(scene)

    def test_selected_nodes_are_pinned_and_shift_r_puts_the_scene_back_in_one_step(self):
        self.begin_paused()
        self.select((-0.05, 1.05), (1.05, 0.9))
        self.do("key", "shift+n", "key", "ctrl+n", "key", "ctrl+z")
        self.press(*self.FIX)
        self.press(*self.LOAD)
        self.do("key", "shift+r", "key", "ctrl+z", "key", "shift+r")
        self.do("key", "space")
        self.play(30)
        self.do("key", "space")
        self.save()
        self.quit()
        top = nodes(lambda x, y, z: y == 4 and z == 4)
        self.assertEqual([pin["nodes"] for pin in self.seen("pin")], [top])
        self.assertEqual([pin["nodes"] for pin in self.seen("release") if isinstance(pin, dict)], [top])
        self.assertEqual([reset for reset in self.seen("reset") if reset != True], ["scene", "scene"])
        self.assertEqual(self.seen("history"), [-1, -1])
        self.verify()
        scene = self.saved()
        self.assertEqual((scene["boundary"], scene["loads"]), ([], []))
        self.solves_to_the_same(scene)

    def test_arrows_of_force_and_gravity_are_dragged_given_back_and_undone(self):
        self.begin_paused()
        self.select((-0.05, 0.1), (1.05, -0.05))
        middle, tip = self.at(0.5, 0), self.at(0.5, 0.4 * 3 ** 0.5 / 2)  # 0.4 of the body's radius
        self.drag(tip, (0, middle[1] - tip[1]), steps=4, held=lambda: self.do("key", "Escape"))
        self.assertEqual(self.seen("loads"), [])
        self.drag(tip, (tip[1] - middle[1], 0), steps=4)  # to the upper left: 45 degrees
        self.wait_for_event("loads")
        self.do("key", "ctrl+z")
        tip = self.at(0.5 - 0.4 * 3 ** 0.5 / 2 / 2 ** 0.5, 0.4 * 3 ** 0.5 / 2 / 2 ** 0.5)
        self.do("mousemove", *tip)
        self.do("mousedown", 1)
        self.xdo("keydown", "Shift_L")
        self.do("mousemove", tip[0] - 60, tip[1])
        self.do("mouseup", 1)
        self.xdo("keyup", "Shift_L")
        self.wait_for_event("loads", 2)
        self.do("key", "Escape", "key", "g")  # the section Selection goes
        self.press(190, 368)
        self.press(141, 518)  # Direction: x, y, z
        self.press(33, 420)
        self.xdo("keydown", "Shift_L")
        self.drag(self.at(0.5, 0.5), (40, -100), steps=4)
        self.xdo("keyup", "Shift_L")
        self.wait_for_event("gravity")
        self.do("key", "ctrl+z")
        self.quit()
        [gravity] = self.seen("gravity")
        self.assertGreater(gravity[1], 1)
        self.assertEqual((gravity[0], gravity[2]), (0, 0))
        first, second = (loads[0]["force"] for loads in self.seen("loads"))
        for value, expected in zip(first, (-0.1, 0.1, 0)):
            self.assertAlmostEqual(value, expected, delta=0.01)
        self.assertLess(second[0], -0.11)
        self.assertEqual(second[1:], [0, 0])
        self.assertEqual(self.seen("history"), [-1, -1])
        self.verify()


if __name__ == "__main__":
    unittest.main(verbosity=2)
