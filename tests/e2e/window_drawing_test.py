"""Drawing in the window: the same as without a display, field values under the mouse, no delay of the engine, nothing
drawn while paused."""
import json
import os
import pathlib
import shutil
import subprocess
import time
import unittest

from program import beam
from skin_test import GREEN, count_parts, png, tube
from window_case import BINARY, WindowCase, light_scene


class Drawing(WindowCase):
    def test_colours_are_read_under_the_mouse(self):
        self.open_display(640, 360)
        self.begin_light()
        self.xdo("mousemove", 638, 300, "key", "space")
        x, y = self.steady().tissue(220, 640)

        def light_pixels_beside():  # where the field value is shown, right of the mouse
            picture = self.display.picture()
            return sum(min(picture.pixel(a, b)) > 170 for a in range(x + 12, x + 90) for b in range(y - 8, y + 8))

        self.xdo("mousemove", x, y)
        self.steady()
        self.assertLess(light_pixels_beside(), 5, "something is read of tissue without colours")
        self.do("key", "2")
        self.wait_for("a reading beside the mouse", lambda: light_pixels_beside() > 25)
        self.quit()

    def test_slow_drawing_does_not_hold_up_the_engine(self):
        self.open_display(640, 360)
        self.begin_light("--draw-stall", 1000)
        first = self.status()
        self.wait_for("pictures", lambda: self.status().frame >= first.frame + 5)
        last = self.status()
        ticks = (last.tick - first.tick) / (last.frame - first.frame)
        self.assertGreater(ticks, 10, "an engine that waits for pictures makes one tick for each, and 60 a second alone")
        self.quit()

    @unittest.skipUnless(shutil.which("compare"), "imagemagick is needed")
    def test_the_window_shows_what_is_captured_without_a_display(self):
        self.open_display(640, 360)
        self.begin_light(scene=dict(light_scene(), gravity=[0, 0, 0]))
        self.do("mousemove", 638, 358)
        self.do("key", "Tab")
        self.do("key", "p")
        self.wait_for("a screenshot", lambda: list(self.folder.glob("heml-*.png")))
        self.quit()
        subprocess.run([BINARY, "capture", "light.json", "--out", "frames", "--frames", "1", "--size", "640x360"],
                       cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        shot = next(self.folder.glob("heml-*.png"))
        done = subprocess.run(["compare", "-metric", "RMSE", shot, self.folder / "frames/frame_00000.png", "null:"],
                              stderr=subprocess.PIPE, text=True)
        normalised = float(done.stderr.split("(")[1].split(")")[0])
        self.assertLess(normalised * 255, 3.0)  # the same limit as for committed frames

    def test_a_section_opens_the_body_and_what_it_leaves_out_is_not_grasped(self):
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl", scene=dict(light_scene(), gravity=[0, 0, 0]))
        self.xdo("mousemove", 638, 358, "key", "space")
        whole = self.steady()
        self.do("key", "k")
        opened = self.steady()
        self.assertGreater(opened.change(whole, 220, 640), 1)
        red = [set(picture.red(220, 640)) for picture in (whole, opened)]
        left_out = sorted(red[0] - red[1])
        self.assertGreater(len(left_out), len(red[0]) / 10, "nothing is left out")
        self.do("key", "k")
        self.assertLess(self.steady().change(whole, 220, 640), 0.1, "the whole body does not come back")
        self.do("key", "k")
        self.do("key", "space")
        self.drag(left_out[len(left_out) // 2], (-10, 0))  # turns the view, if anything
        self.assertEqual(self.seen("grasp"), [])
        self.drag(self.display.picture().tissue(220, 640), (-10, 0))
        self.wait_for_event("grasp")
        self.quit()

    def test_a_fine_skin_goes_where_tissue_is_removed_and_comes_back_after_undo(self):
        (self.folder / "tube.obj").write_text(tube())
        (self.folder / "tube.mtl").write_text("newmtl skin\nKd 1 1 1\nmap_Kd paint.png\n")
        (self.folder / "paint.png").write_bytes(png(8, 8, lambda x, y: (30, 200, 40)))
        gap = {"box": [[0.03, -1, -1], [0.07, 1, 1]]}
        bar = beam(name="bar", skin={"file": "tube.obj"}, gravity=[0, 0, 0], solver={"rate": 100},
                   events=[{"step": 600, "remove": gap}])

        def green():
            picture = self.display.picture()
            return [place for place in picture.places(220, 640) if GREEN(*picture.pixel(*place))]

        parts = lambda: count_parts(green(), 4)
        self.open_display(640, 360)
        self.begin_light("--record", "out.jsonl", scene=bar)
        self.do("key", "space")  # well before the removal, on a busy machine too
        self.wait_for("the skin", lambda: parts() == 1)
        whole = len(green())
        self.do("key", "space")
        self.wait_for("the parts of the skin", lambda: parts() == 2)
        for _ in range(3):  # and so it stays
            self.play(40)
            self.assertEqual(parts(), 2)
            self.assertLess(len(green()), 0.9 * whole)
        self.do("key", "ctrl+z")
        self.wait_for("the whole skin again", lambda: parts() == 1)
        self.quit()

    def test_the_help_is_searched_by_typing_without_the_letter_that_opened_it(self):
        self.open_display(1280, 720)
        self.begin_light(size="1280x720")
        self.xdo("key", "space")

        def lines_found(words):
            """Bright pixels below the search field."""
            self.do("key", "h")
            self.do("type", words)
            picture = self.steady()
            self.do("key", "Escape")
            self.steady()
            return sum(min(picture.pixel(x, y)) > 90 for y in range(90, 600, 2) for x in range(90, 700, 2))

        nothing, colours = lines_found("zzz"), lines_found("colours")
        self.assertGreater(colours, nothing + 500)
        self.quit()

    def test_a_paused_window_draws_nothing(self):
        self.open_display(640, 360)
        self.begin_light()
        self.xdo("mousemove", 600, 350, "key", "space")
        self.steady()
        stat = pathlib.Path(f"/proc/{self.program.pid}/stat")

        def processor_time():
            fields = stat.read_text().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

        before, drawn = processor_time(), self.status().frame
        time.sleep(3)  # the period in which nothing must be drawn
        self.assertLess(processor_time() - before, 0.15)
        self.assertEqual(self.status().frame, drawn)
        self.quit()


if __name__ == "__main__":
    unittest.main(verbosity=2)
