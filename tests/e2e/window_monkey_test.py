"""The window under random mouse and keys: it goes on answering, and its recordings replay to the bit. In `tests/run.sh
--long` alone, since what happens depends on the machine's pace; HEML_MONKEY_SEED repeats one kind of run."""
import os
import random
import time
import unittest

from window_case import WindowCase, light_scene

KEYS = """g o n s c i d m e x t k h l b f a w u j y z q p r 1 2 3 4 5 6 7 8 9 0 space period comma plus minus Tab Escape
Return Delete Left Right Up Down Home End F1 F2 F6 ctrl+F6 KP_1 KP_3 KP_5 KP_7 shift+r shift+t ctrl+z ctrl+shift+z""".split()
NUMBERS = ["0", "1", "-1", "0.3", "1e-9", "1e12", "500"]
SECONDS = 120


@unittest.skipUnless(os.environ.get("HEML_LONG"), "minutes of random input")
class Monkey(WindowCase):
    def stroke(self, random, width, height):
        """With the left button over the middle of the picture, slow or fast."""
        x, y = random.randrange(width // 4, 3 * width // 4), random.randrange(height // 8, 7 * height // 8)
        words = ["mousemove", x, y, "mousedown", 1]
        for _ in range(random.randrange(1, 10)):
            x = min(width - 1, max(0, x + random.randrange(-60, 61)))
            y = min(height - 1, max(0, y + random.randrange(-60, 61)))
            words += ["mousemove", x, y, "sleep", random.choice(["0.01", "0.05", "0.1"])]
        return words + ["mouseup", 1]

    def act(self, random, width, height):
        place = ["mousemove", random.randrange(width), random.randrange(height)]
        other = ["mousemove", random.randrange(width), random.randrange(height)]
        button = random.choice([1, 3])
        kinds = {
            "key": ["key", random.choice(KEYS)],
            "click": place + ["click", random.choice([1, 1, 1, 3, 4, 5])],
            "number": place + ["keydown", "ctrl", "click", 1, "keyup", "ctrl", "type", "--", random.choice(NUMBERS)],
            "drag": place + ["mousedown", button] + other + ["mouseup", button],
            "stroke": self.stroke(random, width, height),
        }
        self.xdo(*kinds[random.choices(list(kinds), [25, 10, 5, 10, 50])[0]])

    def play_about(self, scene, width, height):
        seed = int(os.environ.get("HEML_MONKEY_SEED", time.time()))
        print(f"seed {seed}")
        self.open_display(width, height)
        self.begin(scene, "--record", "out.jsonl", "--size", f"{width}x{height}", colours=50)
        dice, end = random.Random(seed), time.monotonic() + SECONDS
        while time.monotonic() < end:
            self.assertIsNone(self.program.poll(), self.log.read_text()[-2000:])
            self.act(dice, width, height)
        self.settle()
        self.end()
        for file in sorted(self.folder.glob("out*.jsonl")):
            self.verify(file.name, "--partial")

    def test_a_box_in_a_small_window(self):
        self.play_about(self.write_light(light_scene()), 640, 480)

    def test_muscle(self):
        self.play_about("ventricle", 1280, 720)

    def test_tissue_that_tears(self):
        self.play_about("strip_tears", 1280, 720)

    def test_two_bodies(self):
        self.play_about("kidney_on_pad", 1280, 720)


if __name__ == "__main__":
    unittest.main()
