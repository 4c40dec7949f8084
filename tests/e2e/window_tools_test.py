"""The window's tools by mouse and keyboard: effects are drawn, recorded, and replay to the same bits."""
import json
import re
import struct
import unittest

from window_case import WindowCase, light_scene


class Tools(WindowCase):
    def pull_the_body(self, left, right, by, steps=8):
        before = self.display.picture()
        x, y = self.take_hold(left, right)
        for k in range(1, steps + 1):
            self.do("mousemove", x + by[0] * k // steps, y + by[1] * k // steps)
        self.wait_for("a picture that follows the drag",
                      lambda: self.display.picture().change(before, left, right) > 1)
        self.do("mouseup", 1)
        self.wait_for_event("release")
        self.assertGreaterEqual(len(self.seen("move")), 3)

    def change_the_material(self, scale):
        """Drags rows of the panel until one changes a parameter: which row that is depends on the layout, and a row
        above it may change the law."""
        first = json.loads((self.folder / "out.jsonl").read_text().split("\n")[0])["materials"][0]["law"]
        for row in range(10):
            self.drag((int(scale * 170), int(scale * (140 + 13 * row))), (int(scale * 24), 0), steps=4)
            self.do("key", "Escape")
            self.play(3)  # commands are recorded with the next tick
            laws = [first] + [material["law"] for material in self.seen("material")]
            if any(law == before for before, law in zip(laws, laws[1:])):
                return
        self.fail("no row of the material was dragged")

    def choose_a_tissue(self):
        """Chooses a tissue preset from the list that opens under its row."""
        before = len(self.seen("material"))
        self.do("mousemove", 195, 170)
        self.do("click", 1)
        self.do("mousemove", 195, 240)
        self.do("click", 1)
        self.wait_for_event("material", before + 1)
        self.assertNotEqual(self.seen("material")[-1], self.seen("material")[before - 1])

    def remove_tissue(self, left, right, corner):
        self.xdo("mousemove", *corner, "key", "space")
        paused = self.steady()
        self.do("mousemove", *paused.tissue(left, right))
        self.do("key", "Delete")
        self.wait_for_event("remove")
        self.do("mousemove", *corner)
        self.wait_for("a hole", lambda: self.display.picture().change(paused, left, right) > 0.05)

    def play_a_session(self, width, height):
        left, right = (300, 1010) if width >= 1000 else (220, width)  # between the panel's columns
        scale = 1 if width >= 1000 else 0.74
        self.open_display(width, height)
        self.begin("--record", "out.jsonl", "--size", f"{width}x{height}", colours=500)
        self.pull_the_body(left, right, (width // 20, height // 12))
        self.change_the_material(scale)
        if width >= 1000:
            self.choose_a_tissue()
        self.remove_tissue(left, right, (width - 30, height - 5))
        paused = self.steady()
        self.do("key", "3")
        self.wait_for("other colours", lambda: self.display.picture().change(paused, left, right) > 3)
        coloured = self.steady()
        self.do("key", "Tab")
        self.wait_for("a hidden panel", lambda: self.display.picture().change(coloured, 0, int(scale * 250)) > 3)
        self.do("key", "p")
        self.wait_for("a saved picture", lambda: list(self.folder.glob("heml-*.png")))
        self.do("key", "r", "key", "space")
        self.wait_for_event("reset")
        self.play(30)
        drawn, ticks = self.quit()
        self.assertGreater(drawn, 10)
        self.assertGreater(ticks, 100)

        order = [key for event in self.events() for key in ("grasp", "move", "release") if key in event]
        self.assertLess(order.index("grasp"), order.index("move"))
        self.assertLess(order.index("move"), order.index("release"))
        self.verify()
        [saved] = self.folder.glob("heml-*.png")
        head = saved.read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">2I", head[16:]), (width, height))

    def test_a_session_with_mouse_and_keys_is_recorded_and_replays(self):
        self.play_a_session(1280, 720)

    def test_a_small_window_is_as_usable(self):
        self.play_a_session(640, 360)

    def test_forceps_close_where_the_mouse_is_and_stay_in_sight_under_a_panel(self):
        self.open_display(1280, 720)
        self.begin_light("--record", "out.jsonl", size="1280x720")
        before = self.display.picture()
        x, y = before.tissue(300, 1010)

        def changed(left, right, top, bottom):
            now = self.display.picture()
            places = [(a, b) for a in range(left, right, 2) for b in range(top, bottom, 2)]
            return sum(max(abs(p - q) for p, q in zip(now.pixel(*at), before.pixel(*at))) > 40 for at in places)

        self.do("mousemove", x, y)
        self.do("mousedown", 1)
        self.wait_for_event("grasp")
        self.wait_for("jaws on the tissue", lambda: changed(x - 15, x + 15, y - 15, y + 15) > 10)
        for step in range(1, 9):
            self.do("mousemove", x + (120 - x) * step // 8, y)
        self.wait_for("a panel that fades", lambda: self.display.picture().change(before, 30, 220) > 5)
        self.do("mouseup", 1)
        self.wait_for_event("release")
        self.wait_for("the panel", lambda: self.display.picture().change(before, 30, 220) < 4)
        self.quit()
        self.verify()

    def on_the_clamp(self, bare):
        """A place on the shaft of a clamp that stands over the body: of pixels that were tissue in `bare` and
        are steel now, with those about them, the one nearest to their middle."""
        now, red = self.steady(), set(bare.red(300, 1010))
        about = [(x, y) for x in (-2, 0, 2) for y in (-2, 0, 2)]

        def is_steel(x, y):
            return max(now.pixel(x, y)) - min(now.pixel(x, y)) < 40 < max(now.pixel(x, y))

        steel = [(x, y) for x, y in red if all(is_steel(x + dx, y + dy) for dx, dy in about)]
        middle = [sum(at[k] for at in steel) / len(steel) for k in range(2)]
        return min(steel, key=lambda at: (at[0] - middle[0]) ** 2 + (at[1] - middle[1]) ** 2)

    def at_the_clamp(self, bare, *act):
        """Moves the mouse onto a clamp and acts there, while the body is paused: it swings."""
        self.do("mousemove", 1278, 718, "key", "space")
        self.do("mousemove", *self.on_the_clamp(bare))
        self.do(*act)
        self.do("key", "space")

    def test_a_grasp_is_left_as_a_clamp_taken_up_again_and_removed(self):
        self.open_display(1280, 720)
        box = {"size": [0.1, 0.1, 0.1], "cells": [4, 4, 4], "origin": [0, 0, 0]}
        scene = {**light_scene(), "gravity": [0, 0, 0], "mesh": {"box": box}}
        self.begin_light("--record", "out.jsonl", scene=scene, size="1280x720")
        before = self.display.picture()
        self.do("mousemove", 640, 380)
        self.do("mousedown", 1)
        self.wait_for_event("grasp")
        self.do("key", "l")
        self.wait_for_event("grasp", 2)
        self.do("mouseup", 1)
        self.do("mousemove", 1278, 718)
        self.wait_for("a drawn clamp", lambda: self.display.picture().change(before, 300, 1010) > 0.3)
        self.assertFalse(self.seen("release"), "what a clamp holds is not released")
        taken, left = self.seen("grasp")
        self.assertEqual(left, {**taken, "hand": 1})
        self.drag((480, 520), (-30, 20))  # the hand is free for a second grasp, of other nodes
        self.wait_for_event("grasp", 3)
        self.wait_for_event("release")
        self.at_the_clamp(before, "mousedown", 1)
        self.wait_for_event("grasp", 4)
        self.assertEqual(self.seen("grasp")[3], taken)
        self.do("key", "l")
        self.wait_for_event("grasp", 5)
        self.do("mouseup", 1)
        self.at_the_clamp(before, "key", "Delete")
        self.wait_for("its removal", lambda: {"hand": 1} in self.seen("release"))
        self.assertFalse(self.seen("remove"), "tissue is left alone")
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.at_the_clamp(before, "mousedown", 1)
        self.wait_for_event("grasp", 6)
        self.assertEqual(self.seen("grasp")[5], taken, "it is there again and is taken up")
        self.do("mouseup", 1)
        self.quit()
        self.verify()

    def test_a_scalpel_cuts_and_undo_takes_it_back(self):
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl")
        self.xdo("mousemove", 638, 358, "key", "c", "key", "space")
        whole = self.steady()
        place = whole.tissue(220, 640)
        self.drag((place[0] - 60, place[1] - 20), (120, 40), steps=12)
        self.wait_for_event("cut", 3)
        strokes = [cut.get("goes_on", False) for cut in self.seen("cut")]
        self.assertEqual(strokes, [False] + [True] * (len(strokes) - 1))
        self.do("mousemove", 638, 358, "key", "space")
        self.play(120)
        self.xdo("key", "space")
        self.assertGreater(self.steady().change(whole, 220, 640), 0.05, "the cut does not open")
        opened = self.steady()
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.wait_for("the body closes", lambda: self.display.picture().change(opened, 220, 640) > 0.05)
        self.do("key", "ctrl+shift+z")
        self.wait_for_event("history", 2)
        self.wait_for("the cut opens again", lambda: self.display.picture().change(opened, 220, 640) < 0.02)
        self.do("key", "ctrl+z")
        self.wait_for_event("history", 3)
        self.do("key", "ctrl+z")  # nothing left to undo: reported, not recorded
        self.quit()
        self.assertEqual(self.seen("history"), [-1, 1, -1])
        self.verify()

    def test_scissors_snip_at_a_click_and_on_along_a_drag_and_undo_takes_snips_back(self):
        self.open_display(1280, 720)
        self.begin_light("--record", "out.jsonl", size="1280x720")
        self.xdo("mousemove", 1278, 718, "key", "i", "key", "space")
        whole = self.steady()
        x, y = whole.tissue(300, 1010)
        self.do("mousemove", x, y + 40)
        self.wait_for("open scissors", lambda: self.display.picture().change(whole, 300, 1010) > 0.1)
        self.do("click", 1)
        self.wait_for_event("cut")
        self.assertEqual(len(self.seen("cut")), 1)
        self.drag((x - 120, y), (240, 0), steps=6)
        self.wait_for_event("cut", 3)
        cuts = self.seen("cut")
        self.assertEqual([cut.get("goes_on", False) for cut in cuts], [False, False] + [True] * (len(cuts) - 2))
        for before, after in zip(cuts[1:], cuts[2:]):
            self.assertEqual(before["sweep"][-1], after["sweep"][0], "snips join")
        self.do("mousemove", 1278, 718)
        cut = self.steady()
        self.assertGreater(cut.change(whole, 300, 1010), 0.01)
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.do("key", "ctrl+z")
        self.wait_for_event("history", 2)
        self.assertLess(self.steady().change(whole, 300, 1010), 0.01, "undo leaves no snip")
        self.quit()
        self.verify()

    def test_cautery_burns_at_a_press_and_along_a_drag_and_undo_takes_a_press_back(self):
        self.open_display(1280, 720)
        self.begin_light("--record", "out.jsonl", size="1280x720")
        self.xdo("mousemove", 1278, 718, "key", "d", "key", "space")
        whole = self.steady()
        x, y = whole.tissue(300, 1010)
        self.do("mousemove", x, y + 40)
        self.do("click", 1)
        self.wait_for_event("cauterize")
        self.drag((x - 60, y), (120, 0), steps=8)
        self.wait_for_event("cauterize", 4)
        burns = self.seen("cauterize")
        self.assertEqual([burn.get("goes_on", False) for burn in burns], [False, False] + [True] * (len(burns) - 2))
        for before, after in zip(burns[1:], burns[2:]):
            self.assertEqual(before["sweep"][-1], after["sweep"][0], "the stroke has no gap")
        self.assertEqual(len({(burn["radius"], burn["shrink"]) for burn in burns}), 1)
        self.do("mousemove", 1278, 718)
        burnt = self.steady()
        self.assertGreater(burnt.change(whole, 300, 1010), 0.2, "no char is to be seen")
        self.do("key", "space")
        self.play(60)
        self.do("key", "space")
        self.steady()
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.do("key", "ctrl+z")
        self.wait_for_event("history", 2)
        self.assertLess(self.steady().change(whole, 300, 1010), 0.05, "undo leaves no burn")
        self.do("key", "ctrl+shift+z")
        self.wait_for_event("history", 3)
        self.wait_for("the spot again", lambda: self.display.picture().change(whole, 300, 1010) > 0.01)
        self.quit()
        self.assertEqual(self.seen("history"), [-1, -1, 1])
        self.verify()

    def test_cautery_pressed_beside_the_body_burns_from_where_it_comes_upon_it(self):
        self.open_display(1280, 720)
        self.begin_light("--record", "out.jsonl", size="1280x720")
        self.xdo("mousemove", 1278, 718, "key", "d", "key", "space")
        x, y = self.steady().tissue(300, 1010)
        self.do("mousemove", 360, y)
        self.do("mousedown", 1)
        self.do("mousemove", 364, y)
        self.do("mouseup", 1)
        self.assertEqual(self.seen("cauterize"), [], "nothing is there to burn")
        self.drag((360, y), (x - 360, 0), steps=12)
        self.wait_for_event("cauterize", 2)
        self.quit()
        burns = self.seen("cauterize")
        self.assertEqual([burn.get("goes_on", False) for burn in burns], [False] + [True] * (len(burns) - 1))
        for before, after in zip(burns, burns[1:]):
            self.assertEqual(before["sweep"][-1], after["sweep"][0], "the stroke has no gap")
        self.verify()

    def test_a_stroke_from_beside_the_body_to_its_other_side_takes_the_edges_along(self):
        self.open_display(1280, 720)
        at_rest = {**light_scene(), "gravity": [0, 0, 0]}  # whenever it is paused
        self.begin_light("--record", "out.jsonl", scene=at_rest, size="1280x720")
        self.xdo("mousemove", 1278, 718, "key", "c", "key", "space")
        self.steady()
        self.drag((360, 450), (620, 0), steps=31)  # from between palette and box to between box and panel
        self.wait_for_event("cut", 3)
        self.quit()
        sweeps = [cut["sweep"] for cut in self.seen("cut")]
        for tip, end in (sweeps[0][0], sweeps[-1][1]):  # neither blade touches the box
            along = [[a + k / 100 * (b - a) for a, b in zip(tip, end)] for k in range(101)]
            self.assertFalse([x for x in along if all(0 <= c <= 0.1 for c in x)])
        self.verify()

    def test_input_within_one_slow_picture_is_applied_in_its_order(self):
        self.open_display(1280, 720)
        at_rest = {**light_scene(), "gravity": [0, 0, 0]}
        self.begin_light("--record", "out.jsonl", "--draw-stall", 600, scene=at_rest, size="1280x720")
        x, y = self.display.picture().tissue(300, 1010)

        def stroke():
            return ["mousemove", x - 60, y, "mousedown", 1, "mousemove", x, y, "mousemove", x + 60, y, "mouseup", 1]

        self.do("key", "c", *stroke(), "key", "g", *stroke())
        self.wait_for_event("release")
        used = [key for event in self.events() for key in ("cut", "grasp", "move") if key in event]
        self.assertEqual(used[:4], ["cut", "cut", "grasp", "move"])
        self.assertLessEqual(set(used[4:]), {"move"})  # a tick has the last of its moves
        self.do("mousemove", 318, 60, "click", 1, *stroke())  # the second of the palette: the scalpel
        self.wait_for_event("cut", 4)
        self.do("mousemove", 318, 25, "click", 1, *stroke())
        self.wait_for_event("grasp", 2)
        self.assertEqual(len(self.seen("cut")), 4)
        self.quit()
        self.verify()

    def test_what_was_recorded_before_a_kill_replays(self):
        self.open_display(640, 480)
        self.begin("--record", "out.jsonl", "--size", "640x480", colours=500)
        x, y = self.take_hold(220, 640)
        self.do("mousemove", x + 30, y + 40)
        self.do("mouseup", 1)
        self.wait_for_event("release")
        self.wait_for("a checkpoint after it", lambda: "checkpoint" in self.events()[-1])
        recorded = self.events()
        self.end()
        with open(self.folder / "out.jsonl", "a") as file:
            file.write('{"step": 99')  # an incomplete line, as left by a kill
        cut = self.replay()
        self.assertEqual(cut.returncode, 1, cut.stdout + cut.stderr)
        self.assertIn("--partial", cut.stderr)
        said = re.match(r"(\d+) ticks replayed, (\d+) of \d+ check", self.verify("out.jsonl", "--partial"))
        self.assertGreaterEqual(int(said[1]), recorded[-1]["step"])
        self.assertGreaterEqual(int(said[2]), sum("checkpoint" in event for event in recorded))

    def test_pins_table_probe_and_sutures_work_by_mouse_and_keys(self):
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl")
        place = self.display.picture().tissue(220, 640)
        self.do("key", "t")
        self.wait_for_event("tables")
        self.do("key", "n")
        self.do("mousemove", *place)
        self.do("click", 1)
        self.wait_for_event("pin")
        self.play(3)  # the click releases what the picture shows under it
        self.do("click", 1)
        self.wait_for("its release", lambda: any("node" in value for value in self.seen("release")))
        self.do("key", "o")
        self.drag(place, (30, 10))
        self.wait_for("a withdrawn probe", lambda: "probe" in self.seen("release"))
        self.assertGreaterEqual(len(self.seen("probe")), 3)
        self.do("key", "s")
        self.do("mousemove", *place)
        self.do("click", 1)
        self.do("mousemove", place[0] + 50, place[1])
        self.do("click", 1)
        self.wait_for_event("suture")
        self.quit()
        self.verify()


if __name__ == "__main__":
    unittest.main(verbosity=2)
