"""The window's timeline: showing earlier times, resuming from them, and comparison runs."""
import json
import subprocess
import unittest

from window_case import BINARY, WindowCase, light_scene


class Time(WindowCase):
    def look_between_the_drags(self):
        """Drags the timeline to a time after the first drag and before the second, by bisection."""
        after = next(event["step"] for event in self.events() if "release" in event)
        before = [event["step"] for event in self.events() if "grasp" in event][1]
        left, right = 278, 510  # x of the track, left of its buttons
        self.do("mousemove", right, 341)
        self.do("mousedown", 1)
        while not after < self.status().tick < before:
            self.assertLess(left + 1, right, f"no place of the bar is between ticks {after} and {before}")
            middle = (left + right) // 2
            self.do("mousemove", middle, 341)
            left, right = (middle, right) if self.status().tick <= after else (left, middle)
        self.do("mouseup", 1)

    def test_an_earlier_moment_is_looked_at_and_resumed_in_a_new_recording(self):
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl")
        place = self.display.picture().tissue(220, 640)
        self.drag(place, (40, 30))
        self.wait_for_event("release")
        self.play(120)
        self.drag(place, (-40, 20))
        self.wait_for_event("release", 2)
        self.xdo("key", "space", "mousemove", 630, 20)
        present = self.steady()
        self.look_between_the_drags()
        past = self.steady()
        self.assertGreater(past.change(present, 220, 640), 0.05, "the past looks as the present")
        self.xdo("key", "Escape", "mousemove", 630, 20)
        self.assertLess(self.steady().change(present, 220, 640), 0.01, "the present is not what it was")
        self.look_between_the_drags()
        written = (self.folder / "out.jsonl").read_text()
        self.do("key", "b")
        self.wait_for_scene("light", "out-2.jsonl")
        self.do("key", "space")
        self.play(60)
        self.drag(self.display.picture().tissue(220, 640), (20, -30))
        self.wait_for("a release", lambda: "release" in self.commands("out-2.jsonl")[-1])
        self.quit()
        self.assertTrue((self.folder / "out.jsonl").read_text().startswith(written), "the old recording was changed")
        old, new = self.commands("out.jsonl"), self.commands("out-2.jsonl")
        shared = next((k for k, pair in enumerate(zip(old, new)) if pair[0] != pair[1]), min(len(old), len(new)))
        self.assertGreater(shared, 0, "nothing of the first recording led to the moment")
        self.assertLess(shared, len(old), "all of the first recording did")
        self.assertGreater(len(new), shared)
        for file in ("out.jsonl", "out-2.jsonl"):
            self.verify(file)

    def test_clicks_on_the_timeline_show_what_is_under_the_mouse(self):
        self.open_display(1280, 720)
        self.begin_light("--record", "out.jsonl", size="1280x720")
        self.play(500)
        self.xdo("mousemove", 1270, 715, "key", "space")
        self.steady()
        live = self.status().tick
        first, last = 378, 863  # x of the track's ends, pixels
        shown = []
        for k in range(20):
            x = first + (last - first) * (2 * k + 1) // 40
            self.do("mousemove", x, 693)
            self.do("click", 1)  # the buttons that come with the first click move nothing
            shown.append(self.status().tick)
            under_mouse = live * (x - first) / (last - first)  # a frame is shown for the ticks up to the next
            self.assertLessEqual(shown[-1], under_mouse + 2 * live / (last - first), f"x = {x}")
            self.do("click", 1)
            self.assertEqual(self.status().tick, shown[-1], "the same place shows another time")
        self.assertEqual(shown, sorted(shown))
        self.assertGreater(len(set(shown)), 5)
        self.quit()

    def test_a_recording_is_resumed_beside_itself(self):
        self.open_display(640, 360)
        scene = dict(light_scene(), events=[{"at": 0.1, "grasp": {"node": 0, "radius": 0.02}},
                                            {"at": 0.4, "move": [0.03, 0.0, 0.0]}, {"at": 1.0, "release": True}])
        (self.folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([BINARY, "replay", "scene.json", "--record", "tape.jsonl"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        tape = (self.folder / "tape.jsonl").read_bytes()
        self.begin("tape.jsonl", "--size", "640x360")
        self.play(max(event["step"] for event in self.events("tape.jsonl")))  # to its end
        self.xdo("mousemove", 638, 300, "key", "space")
        self.steady()
        self.do("key", "Home")
        self.do("key", "Right", "key", "Right")
        self.do("key", "b")
        self.wait_for_scene("light", "tape-2.jsonl")
        self.quit()
        self.assertEqual((self.folder / "tape.jsonl").read_bytes(), tape)
        self.verify("tape-2.jsonl")

    def test_laws_side_by_side_are_grasped_looked_back_at_and_resumed_together(self):
        self.open_display(1280, 720)
        self.begin_light("--beside", "stvk+backward_euler", "--record", "out.jsonl", size="1280x720")
        panes = (300, 650), (665, 1010)  # x ranges between the panel's columns, pixels
        before = self.display.picture()

        def both_follow():
            self.wait_for("both bodies to follow the drag",
                          lambda: all(self.display.picture().change(before, *pane) > 2 for pane in panes))

        self.drag(before.tissue(*panes[1]), (60, 40), held=both_follow)
        self.wait_for_event("release")
        self.xdo("mousemove", 1270, 715, "key", "space")
        present = self.steady()
        self.xdo(*["key", "Left"] * 12)
        past = self.steady()
        bodies = 630  # the row above the hint and the timeline, which differ anyway
        for pane in panes:
            self.assertGreater(past.change(present, *pane, bodies), 0.05, "the past looks as the present")
        self.do("key", "b")
        self.wait_for_scene("light", "out-2.jsonl")
        resumed = self.steady()
        for pane in panes:
            self.assertLess(resumed.change(past, *pane, bodies), 0.01, "it was resumed elsewhere than where one looked")
        self.quit()
        self.assertEqual(len(self.seen("grasp")), 1)
        for file in ("out.jsonl", "out-2.jsonl"):  # of the first body only: comparison runs are not recorded
            self.verify(file)


if __name__ == "__main__":
    unittest.main(verbosity=2)
