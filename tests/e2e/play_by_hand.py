"""Records tests/golden/kidney_by_hand.jsonl: the default scene in a window, with simulated mouse and keyboard input.

    HEML_BINARY=build/release/app/heml python3 tests/e2e/play_by_hand.py [FILE]
"""
import pathlib
import sys

from window_case import MISSING, WindowCase

RECORDING = pathlib.Path(__file__).resolve().parents[1] / "golden" / "kidney_by_hand.jsonl"


class ByHand(WindowCase):
    """Not a test: half a minute of a user's session."""

    def perform(self, recording):
        self.open_display(1280, 720)
        recording.unlink(missing_ok=True)
        self.begin("--record", recording, "--size", "1280x720", colours=500)
        x, y = self.display.picture().tissue(300, 1010)
        self.drag((x, y), (70, 60))                                 # pull and release
        self.until("material", recording, lambda: self.drag((188, 248), (14, 0), steps=3))  # Young's modulus
        self.do("key", "c")
        self.until("cut", recording, lambda: self.drag((x - 70, y + 70), (60, 50), steps=6))
        self.do("key", "ctrl+z")
        self.until("cut", recording, lambda: self.drag((x - 60, y + 60), (80, -10), steps=6))
        self.do("key", "o")
        self.until("probe", recording, lambda: self.drag((x, y), (12, -8), steps=4))
        self.do("key", "n")
        self.do("mousemove", x, y)
        self.do("click", 1)
        self.do("key", "g")
        self.drag((x - 40, y + 20), (-40, 50), steps=4)             # pull against the pin
        self.quit()
        print(*(f"{key}: {len(self.seen(key, recording))}" for key in
                ("grasp", "move", "release", "material", "cut", "history", "probe", "pin", "checkpoint")))

    def until(self, key, recording, action):
        before = len(self.seen(key, recording))
        action()
        self.wait_for_event(key, before + 1, recording)


if __name__ == "__main__":
    if MISSING:
        raise SystemExit(1)
    hand = ByHand("perform")
    hand.setUp()
    try:
        hand.perform(pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else RECORDING)
    finally:
        hand.doCleanups()
