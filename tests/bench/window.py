"""Frames per second and missed deadlines of the window for scenes with organs, on this machine.

    HEML_BINARY=build/release/app/heml python3 tests/bench/window.py [SECONDS]
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[1] / "e2e"))
from display import Display  # noqa: E402

BINARY = os.environ["HEML_BINARY"]
SCENES = HERE.parents[2] / "assets" / "scenes"
EXPLICIT = {"integrator": "verlet", "rate": 1000, "budget": None}  # None: as if the scene did not say
CASES = [
    ("kidney, verlet at 1 kHz", "kidney_grasp", {}),
    ("uterus", "uterus", {}),
    ("uterus, verlet at 1 kHz", "uterus", EXPLICIT),
    ("uterus, verlet at 1 kHz, float", "uterus", EXPLICIT | {"precision": "float"}),
    ("kidney on a pad", "kidney_on_pad", {}),
    ("kidney on a pad, verlet at 1 kHz", "kidney_on_pad", EXPLICIT),
    ("strip that tears", "strip_tears", {}),
    ("strip that tears, verlet at 1 kHz", "strip_tears", EXPLICIT),
    ("test bench", "test_bench", {}),
    ("test bench, verlet at 1 kHz", "test_bench", EXPLICIT),
]


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        display = Display(folder, 1280, 720)
        environment = dict(os.environ, DISPLAY=display.name, XDG_STATE_HOME=str(folder / "state"))
        print("| 1280 × 720 | frames per second | ticks per second | missed deadlines | wall s per simulated s |\n|---|---|---|---|---|")
        try:
            for title, scene, changes in CASES:
                case = json.loads((SCENES / f"{scene}.json").read_text())
                solver = case["solver"] | changes
                case["solver"] = {key: value for key, value in solver.items() if value is not None}
                file = folder / "scene.json"
                file.write_text(json.dumps(case))
                done = subprocess.run([BINARY, "run", file, "--exit-after", str(seconds), "--size", "1280x720"], env=environment,
                                      capture_output=True, text=True, check=True)
                frames, ticks, missed = map(int, re.match(r"(\d+) frames drawn, (\d+) ticks, (\d+) missed deadlines",
                                                          done.stdout).groups())
                slowdown = case["solver"]["rate"] * seconds / max(1, ticks)  # over the whole run
                print(f"| {title} | {frames / seconds:.0f} | {ticks / seconds:.0f} | "
                      f"{missed / max(1, ticks):.0%} | {slowdown:.2g} |", flush=True)
        finally:
            display.close()


if __name__ == "__main__":
    main()
