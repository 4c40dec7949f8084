"""Opening scenes, saving scenes and recording films in the window."""
import json
import shutil
import struct
import subprocess
import unittest

from window_case import BINARY, WindowCase, light_scene


class Scenes(WindowCase):
    def open_by_name(self, name):
        before = self.display.picture()
        self.do("key", "ctrl+o")
        self.wait_for("pictures of scenes", lambda: self.display.picture().change(before, 100, 800) > 8)
        self.do("type", name)
        self.do("key", "Return")

    def test_a_scene_is_found_by_typing_and_what_was_opened_is_remembered(self):
        self.open_display(1280, 720)
        scene = self.folder / "my_block.json"
        scene.write_text(json.dumps(light_scene()))
        self.begin(scene, "--record", "out.jsonl", "--size", "1280x720")
        self.do("mousemove", 1270, 715)
        self.open_by_name("cantilever")
        self.wait_for_scene("cantilever", "out-2.jsonl")
        self.do("key", "ctrl+o")
        self.do("key", "Escape")  # closes the dialog, so that the window gets the next key
        self.quit()

        self.begin("--record", "again.jsonl", "--size", "1280x720")
        self.open_by_name("my_block")
        self.wait_for_scene("light", "again-2.jsonl")
        self.quit()

    def test_a_scene_that_was_saved_opens_the_same(self):
        self.open_display(640, 360)
        scene = self.folder / "light.json"
        scene.write_text(json.dumps(light_scene()))
        saved = []

        def save(file):
            self.begin(file, "--size", "640x360")
            if not saved:
                self.drag((125, 174), (24, 0), steps=4)
                self.do("key", "t", "key", "w", "key", "4")
                self.play(3)  # the table must take effect before it is saved
            self.do("key", "ctrl+s")
            self.wait_for("a file", lambda: len(list(self.folder.glob("heml-*.json"))) > len(saved))
            self.quit()
            saved.append(max(self.folder.glob("heml-*.json"), key=lambda path: path.stat().st_mtime_ns))
            return json.loads(saved[-1].read_text())

        first = save(scene)
        self.assertEqual(first["view"]["field"], "von_mises")
        self.assertTrue(first["view"]["wireframe"])
        self.assertEqual(len(first["tables"]), 1)
        subprocess.run([BINARY, "replay", scene, "--record", "plain.jsonl"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        plain = json.loads((self.folder / "plain.jsonl").read_text().split("\n")[0])
        changed = [key for key in ("materials", "gravity", "mesh", "boundary", "loads") if first[key] != plain[key]]
        self.assertIn(changed, (["materials"], ["gravity"]), "what was dragged, and nothing else, is in the file")
        self.assertEqual(save(saved[0]), first)

    def films(self):
        return sorted(path for path in self.folder.glob("heml-*") if path.is_dir())

    def frames(self, film):
        return sorted(film.glob("frame_*.png"))

    def test_a_film_becomes_pictures_and_a_video_where_ffmpeg_is(self):
        self.open_display(640, 360)
        tools = self.folder / "tools"
        tools.mkdir()
        if not shutil.which("ffmpeg"):  # a stub that only writes a file
            (tools / "ffmpeg").write_text('#!/bin/sh\nfor last; do :; done\necho video > "$last"\n')
            (tools / "ffmpeg").chmod(0o755)
        self.environment["PATH"] = f"{tools}:{self.environment['PATH']}"
        self.begin_light()
        self.do("mousemove", 638, 300, "key", "v")
        self.wait_for("pictures", lambda: self.films() and len(self.frames(self.films()[0])) > 20)
        self.do("key", "v")  # returns when the video is finished
        videos = list(self.folder.glob("heml-*.mp4")) + list(self.folder.glob("heml-*.webm"))
        self.assertEqual(len(videos), 1)
        self.do("key", "v")
        self.wait_for("another film", lambda: len(self.films()) == 2 and self.frames(self.films()[1]))
        self.quit()  # while it is recording
        for film in self.films():
            numbers = [int(path.stem[6:]) for path in self.frames(film)]
            self.assertEqual(numbers, list(range(len(numbers))))
            for path in self.frames(film):
                self.assertEqual(struct.unpack(">2I", path.read_bytes()[16:24]), (640, 360))


if __name__ == "__main__":
    unittest.main(verbosity=2)
