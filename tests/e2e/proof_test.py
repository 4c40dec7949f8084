"""Every scene that comes with heml, each stability case among them, is recorded with one thread and verifies with 1, 2, 3
and 5, for each instruction set that the processor has. HEML_BINARY is the path of the program.

    proof_test.py        all scenes; `proof_test.py 2/4`: the second quarter of them

Scenes are shortened, their events with them; with HEML_LONG in the environment they have their full length, and each is
played with every integrator and precision.
"""
import json
import os
import sys
import unittest

from program import SOURCE, ProgramCase, beam, heml

PART, PARTS = map(int, sys.argv.pop().split("/")) if "/" in sys.argv[-1] else (1, 1)
LONG = "HEML_LONG" in os.environ
SCENES = sorted((SOURCE / "assets" / "scenes").rglob("*.json"))
INTEGRATORS = ["symplectic_euler", "verlet", "backward_euler", "bdf2", "tr_bdf2", "sdirk2", "auto"]
EXPLICIT = INTEGRATORS[:2]
# Ticks where one takes long.
FEW = {"kidney_on_pad": 20, "large_cube": 3, "uterus": 12, "twist": 20, "21_nearly_incompressible": 2}
MANY = 100_000  # of a million


def tick_of(solver):
    default_rate = 30 if solver.get("integrator") == "static" else 1000
    return solver.get("step") or 1 / solver.get("rate", default_rate)


def ticks_of(scene):
    solver = scene["solver"]
    return round(solver.get("duration", 1) / tick_of(solver))


def shortened(scene, ticks):
    """The scene with so many ticks at most; events keep their order, and the last comes before five sixths of them."""
    solver = scene["solver"]
    tick = tick_of(solver)
    ticks = min(ticks, ticks_of(scene))
    solver["duration"] = ticks * tick
    steps = [event.pop("step") if "step" in event else round(event.pop("at") / tick) for event in scene.get("events", [])]
    squeeze = min(1, 5 * ticks / 6 / max(steps, default=1))
    for event, step in zip(scene.get("events", []), steps):
        event["step"] = int(step * squeeze)
    return scene


def computed_with(scene, integrator, precision):
    """The scene with another integrator, whose steps suit it, and precision."""
    solver = scene["solver"]
    if integrator in EXPLICIT + ["auto"] and "step" in solver:
        solver["rate"] = 1 / solver.pop("step")
    solver |= {"integrator": integrator, "precision": precision}
    if precision == "float":
        solver.pop("tolerance", None)
    return scene


class Proofs(ProgramCase):
    def read(self, path):
        """A scene whose files are found from another folder too."""
        scene = json.loads(path.read_text())
        for part, key in ((scene["mesh"], "file"), (scene.get("initial", {}), "positions")):
            if key in part:
                part[key] = str(path.parent / part[key])
        scene["solver"]["threads"] = 1
        return scene

    def variants(self, number, path):
        """Names and scenes: as it stands, and computed otherwise: in one of all ways, or with HEML_LONG in each."""
        yield "as it stands", shortened(self.read(path), MANY if LONG else FEW.get(path.stem, 60))
        solver = self.read(path)["solver"]
        integrators = ["static"] if solver.get("integrator") == "static" else INTEGRATORS
        ways = [(integrator, precision) for integrator in integrators for precision in ("float", "double")
                if (integrator, precision) != (solver.get("integrator", "verlet"), solver.get("precision", "double"))]
        for integrator, precision in ways if LONG else [ways[number % len(ways)]]:
            scene = computed_with(self.read(path), integrator, precision)
            yield f"{integrator} {precision}", shortened(scene, FEW.get(path.stem, 40))

    def prove(self, scene, instructions):
        recording = self.folder / "recording.jsonl"
        done = heml("replay", self.write("scene.json", scene), "--record", recording, "--instructions", instructions)
        self.assertIn(done.returncode, (0, 4), done.stderr)
        self.assertNotIn("parted nothing", done.stderr)
        lines = [json.loads(line) for line in recording.read_text().splitlines()]
        self.assertEqual(lines[0]["recorded"]["instructions"], instructions)
        self.assertEqual("halt" in lines[-1], done.returncode == 4)
        if done.returncode == 0:  # a halt leaves out the events after it
            self.assertEqual(sum("checkpoint" not in line for line in lines), 2 + len(scene.get("events", [])))
        count = lines[-1]["checkpoints"]
        for threads in (1, 2, 3, 5):
            done = heml("replay", recording, "--verify", "--threads", threads)
            self.assertEqual(done.returncode, 0, f"{threads} threads: {done.stdout}{done.stderr}")
            self.assertIn(f"{count} of {count} checkpoints compared", done.stdout)

    def prove_all(self, instructions):
        tried = heml("replay", self.write("b.json", beam()), "--record", self.folder / "b.jsonl", "--instructions", instructions)
        if tried.returncode == 2:
            self.assertIn("this processor has", tried.stderr)
            self.skipTest(f"this processor does not have {instructions}")
        for number, path in enumerate(SCENES):
            if number % PARTS == PART - 1:
                for name, scene in self.variants(number, path):
                    with self.subTest(path.stem, variant=name):
                        self.prove(scene, instructions)

    def test_portable(self):
        self.prove_all("portable")

    def test_avx2(self):
        self.prove_all("avx2")

    def test_avx512(self):
        self.prove_all("avx512")

    def test_every_stability_case_is_among_them(self):
        numbers = {int(path.stem[:2]) for path in SCENES if path.parent.name == "extreme"}
        self.assertEqual(numbers, set(range(1, 34)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
