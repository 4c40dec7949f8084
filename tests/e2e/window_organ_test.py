"""A mesh of one's own in the window: it is alive at once, what was guessed is changed beside it, undone and kept, and a
slow body is cured by the button of its banner."""
import json
import unittest

from organ_test import SHAPES, medit
from program import heml
from window_case import WindowCase


def slow_scene():
    """Explicit steps that no machine takes in real time."""
    return {
        "schema_version": 1, "name": "slow",
        "mesh": {"box": {"size": [0.1, 0.1, 0.1], "cells": [9, 9, 9], "origin": [0, 0, 0]}},
        "materials": [{"law": "neo_hookean", "young": 1e8, "poisson": 0.3, "density": 1000}],
        "boundary": [{"box": [[-1, -1, -1], [1, 1e-6, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"rate": 1000, "continuation": True},
    }


class Organs(WindowCase):
    def events(self):
        lines = [json.loads(line) for line in (self.folder / "out.jsonl").read_text().splitlines()[1:]]
        return [line for line in lines if "checkpoint" not in line and "end" not in line]

    def test_a_bare_mesh_is_alive(self):
        self.open_display(1280, 720)
        mesh = self.folder / "organ.mesh"
        mesh.write_text(medit(*SHAPES["millimetres"]))
        self.begin(mesh, "--record", "out.jsonl", "--size", "1280x720")
        self.play(3)
        self.quit()
        scene = json.loads((self.folder / "out.jsonl").read_text().splitlines()[0])
        self.assertEqual(scene["mesh"]["scale"], 0.001)
        self.assertEqual(len(scene["boundary"]), 1)
        self.assertIn("rate", scene["solver"])

    def scene_in(self, file):
        return json.loads((self.folder / file).read_text().splitlines()[0])

    def test_a_choice_opens_the_mesh_again(self):
        self.open_display(1280, 720)
        mesh = self.folder / "organ.mesh"
        mesh.write_text(medit(*SHAPES["millimetres"]))
        self.begin(mesh, "--record", "out.jsonl", "--size", "1280x720")
        # The unit is the first choice of the left column: a click opens its list, one on the first entry takes it.
        self.do("mousemove", 200, 141, "click", 1)
        self.do("mousemove", 180, 170)
        self.do("click", 1)
        self.wait_for("the mesh in another unit", lambda: (self.folder / "out-2.jsonl").exists())
        self.play(3)
        self.do("key", "ctrl+s")
        self.quit()
        before, after = self.scene_in("out.jsonl"), self.scene_in("out-2.jsonl")
        self.assertEqual(before["mesh"]["scale"], 0.001)
        self.assertEqual(after["mesh"]["scale"], 0.01)
        self.assertEqual(before["mesh"]["file"], after["mesh"]["file"])
        saved, = self.folder.glob("heml-organ-*.json")
        self.assertEqual(json.loads(saved.read_text())["mesh"]["scale"], 0.01)

    # In the section "This mesh", from the top.
    LENGTH, TISSUE, FINENESS, KEEP, CLOSE = (190, 167), (190, 245), (190, 271), (60, 336), (150, 336)

    def begin_organ(self, *options):
        self.open_display(1280, 720)
        mesh = self.folder / "organ.mesh"
        mesh.write_text(medit(*SHAPES["millimetres"]))
        self.begin(mesh, "--size", "1280x720", *options)
        return mesh

    def press(self, place):
        self.do("mousemove", *place, "click", 1)

    def wait_for_opening(self, number):
        file = f"out-{number}.jsonl"
        self.wait_for(f"opening {number}", lambda: self.name_in(file) == "organ")
        self.settle()
        return self.scene_in(file)

    def test_a_length_is_typed_undone_redone_and_kept_in_a_complete_scene(self):
        mesh = self.begin_organ("--record", "out.jsonl")
        self.press(self.LENGTH)
        self.do("key", "ctrl+a")
        self.do("type", "30")
        self.do("key", "Return")
        self.assertAlmostEqual(self.wait_for_opening(2)["mesh"]["scale"], 0.002)
        self.do("key", "ctrl+z")
        self.assertEqual(self.wait_for_opening(3)["mesh"]["scale"], 0.001)
        self.do("key", "ctrl+shift+z")
        self.assertAlmostEqual(self.wait_for_opening(4)["mesh"]["scale"], 0.002)
        self.press(self.KEEP)
        self.wait_for("a scene", lambda: list(self.folder.glob("heml-organ-*.json")))
        self.quit()
        kept, = self.folder.glob("heml-organ-*.json")
        scene = json.loads(kept.read_text())
        self.assertAlmostEqual(scene["mesh"]["scale"], 0.002)
        self.assertEqual((self.folder / scene["mesh"]["file"]).resolve(), mesh.resolve())
        done = heml("solve", kept, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_tissue_and_fineness_open_the_mesh_again_and_undo_goes_back_one_by_one(self):
        self.begin_organ("--record", "out.jsonl")
        self.press(self.TISSUE)
        self.press((180, 300))  # the second entry: a preset
        tissue = self.wait_for_opening(2)
        self.press(self.FINENESS)
        self.press((180, 300))
        fine = self.wait_for_opening(3)
        self.do("key", "ctrl+z", "sleep", 0.1)
        back = self.wait_for_opening(4)
        self.do("key", "ctrl+z")
        first = self.wait_for_opening(5)
        self.quit()
        guessed = self.scene_in("out.jsonl")
        self.assertNotEqual(tissue["materials"], guessed["materials"])
        self.assertNotIn("tets", tissue["mesh"])
        self.assertEqual(fine["materials"], tissue["materials"])
        self.assertIn("tets", fine["mesh"])
        self.assertNotEqual(fine["recorded"]["tets"], tissue["recorded"]["tets"])
        for scene, same in ((back, tissue), (first, guessed)):
            self.assertEqual(scene["materials"], same["materials"])
            self.assertEqual(scene["mesh"], same["mesh"])
        self.verify("out-3.jsonl")

    def test_the_section_is_closed_for_this_file_also_at_the_next_start(self):
        mesh = self.begin_organ()
        before = self.display.picture()
        self.press(self.CLOSE)
        self.do("mousemove", 640, 700)
        self.assertGreater(self.display.picture().change(before, 10, 280), 4)
        self.quit()
        folded = self.folder / "state" / "heml" / "folded-meshes"
        self.assertEqual(folded.read_text(), f"{mesh}\n")
        other = self.folder / "other.mesh"
        other.write_text(mesh.read_text())
        for file, opens in ((mesh, False), (other, True)):
            self.begin(file, "--record", f"{file.stem}.jsonl", "--size", "1280x720")
            self.press((200, 141))
            self.press((180, 170))
            self.play(3)
            self.assertEqual((self.folder / f"{file.stem}-2.jsonl").exists(), opens)
            self.quit()

    def test_the_button_of_a_slow_body_s_banner_changes_its_method(self):
        self.open_display(1280, 720)
        scene = self.folder / "slow.json"
        scene.write_text(json.dumps(slow_scene()))
        self.begin(scene, "--record", "out.jsonl", "--size", "1280x720")
        self.do("mousemove", 640, 700, "key", "space")
        before = self.steady()  # of a paused body, which is not late, however long the start took
        self.do("key", "space")
        # The banner comes after a second; it stands in the right column, below the values.
        self.wait_for("the banner", lambda: self.display.picture().change(before, 1030, 1270) > 4)
        self.settle()
        for y in range(480, 716, 7):  # text does nothing; "Dismiss" is below the button
            self.do("mousemove", 1100, y, "click", 1)
            self.play(1)
            if self.events():
                break
        kinds = {key: event[key] for event in self.events() for key in event if key != "step"}
        self.assertEqual(kinds, {"integrator": "backward_euler", "rate": 60, "budget": 1})
        self.quit()


if __name__ == "__main__":
    unittest.main()
