"""Makes tests/golden/kidney_by_hand.jsonl anew: the default scene in a window, with a real mouse and keyboard.

    HEML_BINARY=build/release/app/heml python3 tests/e2e/play_by_hand.py
"""
import pathlib
import time

from window_test import MISSING, Window

RECORDING = pathlib.Path(__file__).resolve().parents[1] / "golden" / "kidney_by_hand.jsonl"


class ByHand(Window):
    """Not a test: what a person does in half a minute."""

    def play(self):
        self.open_display(1280, 720)
        RECORDING.unlink(missing_ok=True)
        self.start("--record", RECORDING, "--size", "1280x720")
        self.wait_for("a picture", lambda: self.display.picture().colours() > 500)
        time.sleep(0.5)
        x, y = self.display.picture().tissue(300, 1010)
        self.drag((x, y), (70, 60))                                 # pulled, and let go
        self.do("Young's modulus", "material", lambda: self.drag((188, 248), (14, 0), steps=3))
        self.xdo("key", "c", "sleep", 0.3)
        self.do("a cut", "cut", lambda: self.drag((x - 70, y + 70), (60, 50), steps=6))
        self.xdo("key", "ctrl+z", "sleep", 0.3)
        self.do("a cut again", "cut", lambda: self.drag((x - 60, y + 60), (80, -10), steps=6))
        self.xdo("key", "o", "sleep", 0.3)
        self.do("a probe", "probe", lambda: self.drag((x, y), (12, -8), steps=4))
        self.xdo("key", "n", "sleep", 0.5, "mousemove", x, y, "click", 1, "sleep", 0.5)
        self.xdo("key", "g", "sleep", 0.3)
        self.drag((x - 40, y + 20), (-40, 50), steps=4)             # against the pin
        self.xdo("key", "ctrl+q")
        self.program.communicate(timeout=60)
        print(*(f"{key}: {len(self.seen(key, RECORDING))}" for key in
                ("grasp", "move", "release", "material", "cut", "undo", "probe", "pin", "checkpoint")))

    def do(self, what, key, action):
        before = len(self.seen(key, RECORDING))
        action()
        self.wait_for(what, lambda: len(self.seen(key, RECORDING)) > before, 10)


if __name__ == "__main__":
    if MISSING:
        raise SystemExit(1)
    hand = ByHand("play")
    hand.setUp()
    try:
        hand.play()
    finally:
        hand.doCleanups()
