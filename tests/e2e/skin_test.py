"""A fine skin over a coarse body, in pictures without a display: drawn with its texture, cut with the body."""
import math
import struct
import unittest
import zlib

from program import ProgramCase, beam, heml


def png(width, height, pixel):
    """pixel(x, y): red, green, blue; rows from the top."""
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def pixels(path):
    """The pixels of a picture that heml wrote: 8 bits, RGB, filters none and sub."""
    data = path.read_bytes()
    at, size, packed = 8, None, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            size = struct.unpack(">II", data[at + 8:at + 16])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, width, result = zlib.decompress(packed), size[0], []
    for y in range(size[1]):
        row = bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        if raw[y * (3 * width + 1)] == 1:
            for i in range(3, len(row)):
                row[i] = (row[i] + row[i - 3]) & 255
        result += [tuple(row[3 * x:3 * x + 3]) for x in range(width)]
    return result


def tube(around=48, along=60):
    """A round bar within the bar of the scene, closed at its ends; u goes round it, v along."""
    lines = ["mtllib tube.mtl", "usemtl skin"]
    for k in range(along + 1):
        for i in range(around + 1):
            angle = 2 * math.pi * i / around
            lines.append("v %.9g %.9g %.9g" % (0.001 + 0.098 * k / along, 0.01 + 0.012 * math.cos(angle), 0.01 + 0.012 * math.sin(angle)))
            lines.append("vt %.9g %.9g" % (i / around, k / along))
    lines += ["v 0.001 0.01 0.01", "vt 0.5 0", "v 0.099 0.01 0.01", "vt 0.5 1"]
    number = lambda i, k: k * (around + 1) + i + 1
    first, last = (along + 1) * (around + 1) + 1, (along + 1) * (around + 1) + 2
    face = lambda *n: lines.append("f " + " ".join("%d/%d" % (v, v) for v in n))
    for i in range(around):
        for k in range(along):
            face(number(i, k), number(i + 1, k), number(i + 1, k + 1), number(i, k + 1))
        face(first, number(i + 1, 0), number(i, 0))
        face(last, number(i, along), number(i + 1, along))
    return "\n".join(lines) + "\n"


GREEN = lambda r, g, b: g > 60 and g > 1.6 * r and g > 1.6 * b


def count_parts(places, step=1, least=20):
    """Parts of a set of pixels that do not touch, of so many pixels at least."""
    left, parts = set(places), 0
    while left:
        part = [left.pop()]
        for a, b in part:
            beside = {(a + step * i, b + step * k) for i in (-1, 0, 1) for k in (-1, 0, 1)} & left
            left -= beside
            part += beside
        parts += len(part) >= least
    return parts


class Skins(ProgramCase):
    def setUp(self):
        super().setUp()
        self.write("tube.obj", tube())
        self.write("tube.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd paint.png\n")
        (self.folder / "paint.png").write_bytes(png(32, 32, lambda x, y: (30, 200, 40)))

    def captured(self, scene, frames=2):
        done = heml("capture", self.write("scene.json", scene), "--out", self.folder / "out", "--frames", frames,
                    "--size", "320x180")
        return done, sorted((self.folder / "out").glob("*.png"))

    def green(self, picture):
        return sum(GREEN(*p) for p in pixels(picture))

    def test_the_skin_is_drawn_with_its_texture_and_bends_with_the_body(self):
        done, frames = self.captured(beam(skin={"file": "tube.obj"}, solver={"duration": 0.2, "threads": 1}), 5)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("warning"), 0, done.stderr)
        counts = [self.green(frame) for frame in frames]
        self.assertGreater(min(counts), 1000)
        # The tip falls: the lowest green row comes down.
        lowest = [max(i // 320 for i, p in enumerate(pixels(frame)) if GREEN(*p)) for frame in (frames[0], frames[-1])]
        self.assertGreater(lowest[1], lowest[0])

    def test_a_picture_without_a_skin_stays_the_same(self):
        _, frames = self.captured(beam())
        before = [frame.read_bytes() for frame in frames]
        self.assertLess(self.green(frames[0]), 20)
        _, frames = self.captured(beam(skin={"file": "tube.obj"}))
        self.assertNotEqual(before[0], frames[0].read_bytes())
        _, frames = self.captured(beam())
        self.assertEqual(before, [frame.read_bytes() for frame in frames])

    CUT = {"at": 0.02, "cut": {"sweep": [[[0.05, -0.01, -0.01], [0.05, -0.01, 0.03]], [[0.05, 0.03, -0.01], [0.05, 0.03, 0.03]]]}}

    def test_the_skin_is_cut_with_the_body_and_falls_apart_with_it(self):
        scene = beam(skin={"file": "tube.obj"}, events=[self.CUT], solver={"duration": 0.12, "threads": 1})
        done, frames = self.captured(scene, 4)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("warning"), 0, done.stderr)
        green = [{divmod(i, 320) for i, p in enumerate(pixels(frame)) if GREEN(*p)} for frame in (frames[0], frames[-1])]
        self.assertEqual([count_parts(places) for places in green], [1, 2])  # nothing spans the gap
        self.assertGreater(len(green[1]), 1000)
        self.assertLess(len(green[1]), 1.2 * len(green[0]))

    def test_undo_of_the_cut_brings_the_skin_back(self):
        events = [self.CUT, {"at": 0.05, "undo": True}]
        scene = beam(skin={"file": "tube.obj"}, events=events, gravity=[0, 0, 0])
        done, frames = self.captured(scene, 5)  # in the last one the blade is gone too
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotEqual(frames[1].read_bytes(), frames[0].read_bytes())
        self.assertEqual(frames[4].read_bytes(), frames[0].read_bytes())

    def test_missing_files_are_refused_by_name(self):
        for skin, words in (({"file": "gone.obj"}, ["skin.file", "gone.obj"]),
                            ({"file": "tube.obj", "texture": "gone.png"}, ["skin.texture", "gone.png"]),
                            ({"file": "tube.obj", "texture": "tube.mtl"}, ["tube.mtl", "is no PNG"]),
                            ({"file": "tube.obj", "colour": 1}, ["skin", "colour"])):
            with self.subTest(skin=skin):
                done, _ = self.captured(beam(skin=skin))
                self.assert_refused(done, 3, *words)
        (self.folder / "paint.png").write_bytes(png(32, 32, lambda x, y: (30, 200, 40))[:60])
        self.assert_refused(self.captured(beam(skin={"file": "tube.obj"}))[0], 3, "paint.png")
        (self.folder / "paint.png").unlink()
        self.assert_refused(self.captured(beam(skin={"file": "tube.obj"}))[0], 3, "names the texture 'paint.png'")

    def test_a_skin_changes_no_state(self):
        hashes = []
        for more in ({}, {"skin": {"file": "tube.obj"}}):
            done = heml("solve", self.write("s.json", beam(**more)), "--out", self.folder / "r")
            self.assertEqual(done.returncode, 0, done.stderr)
            hashes.append((self.folder / "r" / "positions.csv").read_bytes())
        self.assertEqual(*hashes)


if __name__ == "__main__":
    unittest.main()
