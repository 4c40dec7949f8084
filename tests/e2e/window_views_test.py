"""Looking around and inside in the window: standard views, the axes, turning about the tissue under the mouse, regions,
measuring, fixed colours."""
import math
import subprocess
import unittest

from window_case import WindowCase, light_scene


def still_scene():
    return dict(light_scene(), gravity=[0, 0, 0])


def two_blocks():
    """A mesh of two named blocks of 5 cm side by side along x, as Gmsh writes it."""
    places = [(x, y, z) for x in range(3) for y in range(2) for z in range(2)]
    number = {place: k + 1 for k, place in enumerate(places)}
    corners = [(0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7)]  # of a cube: zyx bits
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '3 1 "left"', '3 2 "right"',
             "$EndPhysicalNames", "$Nodes", str(len(places))]
    lines += [f"{number[p]} {0.05 * p[0]} {0.05 * p[1]} {0.05 * p[2]}" for p in places]
    lines += ["$EndNodes", "$Elements", "12"]
    for cube in (0, 1):
        for tet in corners:
            at = [(cube + (c & 1), c >> 1 & 1, c >> 2 & 1) for c in tet]
            lines.append(f"{len(lines)} 4 2 {cube + 1} {cube + 1} " + " ".join(str(number[p]) for p in at))
    return "\n".join(lines + ["$EndElements", ""])


class Views(WindowCase):
    def start_still(self, scene=None, size="1280x720", **keys):
        width, height = map(int, size.split("x"))
        self.open_display(width, height)
        self.begin_light(*keys.get("arguments", ()), scene=scene or still_scene(), size=size)
        self.xdo("mousemove", width - 4, height - 4, "key", "space")
        return self.steady()

    def tissue(self, picture):  # below the axes in the corner
        return [place for place in picture.red(300, 1010) if place[1] > 120]

    def assert_same_tissue(self, before, after, message):
        changed = set(self.tissue(before)) ^ set(self.tissue(after))
        self.assertLess(len(changed), 0.01 * len(self.tissue(before)), message)

    def test_a_saved_view_is_there_at_the_next_start(self):
        self.start_still()
        self.do("key", "KP_7")
        self.do("key", "ctrl+F6")
        top = self.steady()
        self.do("key", "KP_1")
        self.quit()
        self.log.unlink()
        self.begin(self.folder / "light.json", "--size", "1280x720")
        self.xdo("mousemove", 1276, 716, "key", "space")
        other = self.steady()
        self.do("key", "F6")
        again = self.steady()
        self.assertGreater(len(set(self.tissue(other)) ^ set(self.tissue(top))), 0.1 * len(self.tissue(top)))
        self.assert_same_tissue(top, again, "the view saved before")

    def window_size(self):
        """Width and height of the program's window."""
        found = subprocess.run(["xdotool", "search", "--class", "heml"], env=self.environment, capture_output=True,
                               text=True, check=True).stdout.split()
        told = subprocess.run(["xdotool", "getwindowgeometry", "--shell", found[-1]], env=self.environment,
                              capture_output=True, text=True, check=True).stdout
        numbers = dict(line.split("=") for line in told.split())
        return int(numbers["WIDTH"]), int(numbers["HEIGHT"])

    def test_the_window_opens_as_large_as_it_was_left_but_no_larger_than_the_screen(self):
        self.open_display(1280, 720)
        file = self.write_light()
        self.begin(file)
        self.assertEqual(self.window_size(), (1280, 720))
        self.xdo("search", "--class", "heml", "windowsize", 900, 600)
        self.wait_for("a smaller window", lambda: self.window_size() == (900, 600))
        kept = self.folder / "state" / "heml" / "panel"  # not there while all is as at first
        self.wait_for("its size on file", lambda: kept.exists() and "window 900 600" in kept.read_text())
        self.quit()
        for arguments, size in (((), (900, 600)), (("--size", "800x500"), (800, 500)), ((), (900, 600))):
            self.log.unlink()
            self.begin(file, *arguments)
            self.assertEqual(self.window_size(), size)
            self.quit()
        kept.write_text("window 5000 3000\n")
        self.log.unlink()
        self.begin(file)
        self.assertEqual(self.window_size(), (1280, 720))
        self.quit()

    def test_numpad_turns_to_standard_views_and_to_an_orthographic_camera(self):
        first = self.start_still()
        self.do("key", "KP_1")
        front = self.steady()
        self.assertGreater(front.change(first, 300, 1010), 1)

        def width(picture):
            return max(self.tissue(picture))[0] - min(self.tissue(picture))[0]

        self.do("key", "KP_5")
        flat = self.steady()
        self.assertGreater(flat.change(front, 300, 1010), 0.2)
        # The face is 5 cm before the middle of the cube of 10 cm, which the eye sees from 1.22 radii / sin 15 degrees.
        distance = 1.22 * 0.05 * 3 ** 0.5 / math.sin(math.radians(15))
        self.assertAlmostEqual(width(flat) / width(front), 1 - 0.05 / distance, delta=0.02)
        self.do("key", "KP_5")
        self.assertLess(self.steady().change(front, 300, 1010), 0.1)
        for key in ("KP_3", "KP_7", "ctrl+KP_1"):
            self.do("key", key)
            self.steady()
        self.do("key", "KP_1")
        self.assertLess(self.steady().change(front, 300, 1010), 0.1, "the front is not what it was")
        self.quit()

    def test_the_axes_in_the_corner_turn_the_camera(self):
        self.start_still()
        self.do("key", "KP_1")
        front = self.steady()
        # The window of the axes is in the upper right corner of the free area: +y above its middle.
        coloured = [(x, y) for x, y in front.places(900, 1030, 2) if y < 110
                    and front.pixel(x, y)[1] > 1.25 * max(front.pixel(x, y)[0], front.pixel(x, y)[2]) > 80]
        self.assertTrue(coloured, "no green axis")
        top = min(coloured, key=lambda place: place[1])
        self.do("mousemove", top[0], top[1] + 6, "click", 1)
        self.do("mousemove", 1276, 716)
        clicked = self.steady()
        self.do("key", "KP_7")
        self.assertLess(self.steady().change(clicked, 300, 900), 0.1, "the end of y does not look from the top")
        self.assertGreater(clicked.change(front, 300, 900), 1)
        self.quit()

    def test_a_right_drag_turns_about_the_tissue_under_the_mouse(self):
        def beads(picture):  # of constrained nodes: the corners and edges of the top
            grey = [picture.pixel(x, y) for x, y in picture.places(330, 930, 2)]
            return [place for place, (r, g, b) in zip(picture.places(330, 930, 2), grey)
                    if 120 < place[1] < 600 and min(r, g, b) > 110 and max(r, g, b) < 1.35 * min(r, g, b)]

        bead = min(beads(self.start_still()))
        at = bead[0] + 14, bead[1] + 12  # on the tissue beside the leftmost bead
        self.do("mousemove", *at)
        before = self.steady()
        self.do("mousedown", 3)
        self.assert_same_tissue(before, self.steady(), "the picture jumps at the beginning")
        for k in range(1, 9):
            self.do("mousemove", at[0] + 12 * k, at[1] + 2 * k)
        self.do("mouseup", 3)
        self.do("mousemove", 1276, 716)
        turned = self.steady()
        self.assertGreater(turned.change(before, 300, 1010), 1)
        moved = min(math.dist(bead, place) for place in beads(turned))
        self.assertLess(moved, 10, "the tissue about which the body turns has left its place")
        self.quit()

    def test_a_hidden_region_is_not_drawn_nor_grasped_and_its_neighbour_is_closed(self):
        (self.folder / "blocks.msh").write_text(two_blocks())
        scene = dict(still_scene(), mesh={"file": "blocks.msh"}, view={"side": "front"},
                     boundary=[{"box": [[-1, 0.0499, -1], [1, 1, 1]], "fix": True}])
        whole = self.start_still(scene=scene, arguments=("--record", "out.jsonl"))
        spread = self.tissue(whole)
        left, right = min(spread)[0], max(spread)[0]
        middle = (left + right) // 2
        height = sorted(y for _, y in spread)[len(spread) // 2]
        beside = (left + middle) // 2, height
        self.do("mousemove", 60, 526, "click", 1)  # opens the section Regions, above View
        eye = 33, 554  # its first row
        self.do("mousemove", *eye, "click", 1)
        self.do("mousemove", 1276, 716)
        hidden = self.steady()
        shown = self.tissue(hidden)
        self.assertLess(len([p for p in shown if p[0] < middle - 24]), 4, "the hidden region is drawn")
        self.assertGreater(len([p for p in shown if p[0] > middle + 24]), 50)
        self.do("key", "space")
        self.drag(beside, (-10, 0))
        self.assertEqual(self.seen("grasp"), [])
        self.do("key", "space", "key", "ctrl+KP_3")  # onto the interface, from the left, where the lamp is
        closed = self.tissue(self.steady())
        self.assertGreater(len(closed), 100, "nothing closes the body where the hidden region was")
        self.do("key", "space")
        self.drag(closed[len(closed) // 2], (10, 4))
        self.wait_for_event("grasp")
        self.assertEqual(self.seen("grasp")[0]["hidden"], [1])
        self.do("key", "space", "key", "KP_1")
        self.do("mousemove", *eye, "click", 1)
        self.do("mousemove", 1276, 716)
        self.assertGreater(len([p for p in self.tissue(self.steady()) if p[0] < middle - 24]), 50)
        self.quit()
        self.verify()

    def test_a_distance_is_measured_followed_and_saved(self):
        picture = self.start_still()
        self.do("key", "KP_1")
        spread = self.tissue(self.steady())
        columns = sorted({x for x, _ in spread})
        left, right = columns[len(columns) // 4], columns[-len(columns) // 4]
        height = sorted(y for _, y in spread)[len(spread) // 2]
        self.do("key", "m")
        plain = self.steady()
        self.do("mousemove", left, height, "click", 1)
        self.do("mousemove", right, height, "click", 1)
        self.do("mousemove", 1276, 716)
        measured = self.steady()
        self.assertGreater(measured.change(plain, left, right), 0.3, "no line is drawn")
        self.do("key", "space")
        self.play(20)
        self.do("key", "space")
        self.steady()
        self.click_save()
        self.wait_for("a table", lambda: list(self.folder.glob("heml-*-measured-*.csv")))
        head, *rows = next(self.folder.glob("heml-*-measured-*.csv")).read_text().splitlines()
        self.assertGreater(len(rows), 2)
        values = dict(zip(head.split(","), rows[-1].split(",")))
        ends = [[float(values[f"{axis}{k}_m"]) for axis in "xyz"] for k in (1, 2)]
        self.assertAlmostEqual(ends[0][1], ends[1][1], delta=0.002)
        self.assertAlmostEqual(float(values["distance_1_2_m"]), ends[1][0] - ends[0][0], delta=0.002)
        self.assertAlmostEqual(float(values["piece_volume_m3"]), 1e-3, delta=1e-6)  # a cube of 10 cm
        self.assertAlmostEqual(float(values["piece_area_m2"]), 0.06, delta=1e-4)
        self.quit()

    def click_save(self):
        for y in range(150, 420, 14):  # the button stands below the plot in the section Measure
            self.do("mousemove", 80, y, "click", 1)
            if list(self.folder.glob("heml-*-measured-*.csv")):
                return


if __name__ == "__main__":
    unittest.main(verbosity=2)
