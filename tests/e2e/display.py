"""A virtual screen (Xvfb) and pictures of it."""
import mmap
import os
import statistics
import struct
import subprocess


class Display:
    """An Xvfb screen whose pixels are in a file."""

    def __init__(self, folder, width, height):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(folder),
             "-nolisten", "tcp"],
            pass_fds=(write,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()
        self.file = folder / "Xvfb_screen0"

    def close(self):
        self.server.terminate()
        self.server.wait()

    def picture(self):
        """The screen now. The file is an X window dump: 25 big-endian words, a name, colours of 12 bytes, pixels."""
        with open(self.file, "rb") as file, mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ) as dump:
            words = struct.unpack(">25I", dump[:100])
            width, height, stride, start = words[4], words[5], words[12], words[0] + 12 * words[19]
            return Picture(width, height, stride, dump[start:start + stride * height])


class Picture:
    """Rows of 4-byte pixels: blue, green, red, unused."""

    def __init__(self, width, height, stride, data):
        self.width, self.height, self.stride, self.data = width, height, stride, data

    def pixel(self, x, y):
        at = y * self.stride + 4 * x
        blue, green, red = self.data[at:at + 3]
        return red, green, blue

    def places(self, left, right, step=4):
        return [(x, y) for y in range(0, self.height, step) for x in range(left, right, step)]

    def colours(self):
        return len({self.pixel(x, y) for x, y in self.places(0, self.width)})

    def change(self, other, left, right, bottom=None):
        """Mean difference per channel, 0 to 255, between columns `left` and `right`, above row `bottom` if given."""
        places = [place for place in self.places(left, right) if bottom is None or place[1] < bottom]
        return sum(abs(a - b) for p in places for a, b in zip(self.pixel(*p), other.pixel(*p))) / (3 * len(places))

    def red(self, left, right):
        """Places of red pixels: of tissue."""
        def is_red(place):
            red, green, _ = self.pixel(*place)
            return red > 90 and red > 1.7 * green

        return [place for place in self.places(left, right) if is_red(place)]

    def tissue(self, left, right):
        """The red pixel nearest to the median of all red pixels, of those with red 16 pixels about them: a point that
        stays on the tissue though it swings a little."""
        red = self.red(left, right)
        middle = statistics.median(x for x, _ in red), statistics.median(y for _, y in red)
        every, about = set(red), [(x, y) for x in (-16, 0, 16) for y in (-16, 0, 16)]
        inner = [(x, y) for x, y in red if all((x + dx, y + dy) in every for dx, dy in about)]
        return min(inner or red, key=lambda p: (p[0] - middle[0]) ** 2 + (p[1] - middle[1]) ** 2)
