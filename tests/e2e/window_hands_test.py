"""A SpaceMouse as a second hand: a daemon that speaks spacenavd's protocol on a socket moves the instrument, grasps,
pulls, leaves clamps and goes, beside the mouse. Its events are recorded and replay to the same bits."""
import socket
import struct
import threading
import time
import unittest

from window_case import WindowCase, light_scene

MOTION, PRESS, RELEASE = range(3)
HAND = 15
FULL = 350  # of an axis


class Daemon:
    """Answers one client with protocol 0, then sends events of eight 32-bit words."""

    def __init__(self, path):
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(str(path))
        self.server.listen(1)
        self.client = None
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        client, _ = self.server.accept()
        request, = struct.unpack("i", client.recv(4))
        client.sendall(struct.pack("i", request & ~0xff))
        self.client = client

    def send(self, *words):
        self.client.sendall(struct.pack("8i", *words, *[0] * (8 - len(words))))

    def deflect(self, right=0, up=0, away=0, turn=0):
        self.send(MOTION, int(FULL * right), int(FULL * up), int(FULL * away), 0, int(FULL * turn), 0, 16)

    def close(self):
        for each in (self.client, self.server):
            if each:
                each.close()


class Hands(WindowCase):
    def begin_with_daemon(self):
        self.open_display(640, 360)
        path = self.folder / "spnav.sock"
        self.daemon = Daemon(path)
        self.addCleanup(self.daemon.close)
        self.environment["SPNAV_SOCKET"] = str(path)
        scene = light_scene()
        scene["mesh"]["box"]["cells"] = [4, 4, 4]
        self.begin_light("--record", "out.jsonl", scene=scene)
        self.wait_for("the window at the daemon's socket", lambda: self.daemon.client)

    def press(self, button):
        """Ends when the window has drawn what the button did, and the engine has recorded it."""
        self.daemon.send(PRESS, button)
        self.daemon.send(RELEASE, button)
        drawn = self.status().frame
        self.wait_for("pictures", lambda: self.status().frame > drawn + 2)
        self.settle()
        self.play(3)

    def move(self, seconds, **deflection):
        self.daemon.deflect(**deflection)
        time.sleep(seconds)
        self.daemon.deflect()
        self.settle()

    def of(self, key, hand=HAND):
        events = self.seen(key)
        return [e for e in events if (e.get("hand", 0) if isinstance(e, dict) else 0) == hand]

    def approach_and_grasp(self):
        for _ in range(30):
            self.move(0.1, away=0.5)
            self.press(0)
            if self.of("grasp"):
                return
        self.fail("no tissue was met")

    def pull(self, **deflection):
        before = len(self.of("move"))
        self.daemon.deflect(**deflection)
        self.wait_for("moves", lambda: len(self.of("move")) >= before + 5)
        self.daemon.deflect()
        self.settle()

    def test_a_session_with_two_hands(self):
        self.begin_with_daemon()
        self.assertEqual(self.commands("out.jsonl"), [])
        self.approach_and_grasp()
        grasp = self.of("grasp")[0]
        before = self.display.picture()
        self.pull(right=0.5, away=-0.5)
        self.wait_for("a picture that follows the pull", lambda: self.display.picture().change(before, 220, 640) > 1)
        first, last = self.of("move")[0]["to"], self.of("move")[-1]["to"]
        self.assertGreater(last[2], first[2])  # towards the eye, which looks along −z and a little down and aside

        # The mouse pulls at the same time.
        picture = self.display.picture()
        left = min(x for x, _ in picture.red(220, 640))
        place = picture.tissue(left, left + 60)  # beside what the other hand holds
        self.do("mousemove", *place)
        self.do("mousedown", 1)
        self.play(3)
        self.assertEqual(len(self.of("grasp", 0)), 1)
        self.do("mousemove", place[0] - 40, place[1])
        self.pull(up=-0.5)
        self.do("mousemove", place[0] - 60, place[1])
        self.wait_for("moves of the mouse", lambda: len(self.of("move", 0)) >= 2)
        self.do("mouseup", 1)
        self.assertEqual(self.of("release"), [])

        self.press(1)  # a clamp
        left = self.seen("grasp")[-1]
        self.assertEqual(dict(left, hand=HAND), grasp)
        self.assertEqual(left["hand"], 1)
        self.press(0)  # taken up again
        self.assertEqual(self.seen("grasp")[-1], grasp)
        self.press(0)  # and let go
        self.wait_for("a release", lambda: self.of("release"))
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.quit()
        self.verify()

    def test_undo_takes_a_grasp_back_with_its_moves_and_release(self):
        self.begin_with_daemon()
        self.approach_and_grasp()
        self.pull(right=0.5)
        self.press(0)
        self.wait_for("a release", lambda: self.of("release"))
        self.do("key", "ctrl+z")
        self.wait_for_event("history")
        self.do("key", "ctrl+z")  # there is nothing left to undo
        self.play(3)
        self.assertEqual(self.seen("history"), [-1])
        self.quit()
        self.verify()

    def test_a_device_that_goes_leaves_a_clamp(self):
        self.begin_with_daemon()
        self.approach_and_grasp()
        self.daemon.close()
        self.wait_for_event("grasp", 2)
        self.assertEqual(self.seen("grasp")[-1], dict(self.of("grasp")[0], hand=1))
        self.settle()
        self.play(3)
        self.quit()
        self.verify()

    def test_its_translation_moves_the_view_where_it_is_set_to(self):
        (self.folder / "state" / "heml").mkdir(parents=True)
        (self.folder / "state" / "heml" / "panel").write_text("device moves view\n")
        self.begin_with_daemon()
        self.xdo("key", "space")
        self.xdo("mousemove", 320, 180, "windowfocus", 1)  # keys go to where the mouse is, not to a window
        before = self.steady()
        self.move(0.3, right=1)
        self.assertEqual(self.steady().change(before, 220, 640), 0)
        self.xdo("search", "--class", "heml", "windowfocus", "--sync")
        self.move(0.3, right=1)
        self.wait_for("another view", lambda: self.display.picture().change(before, 220, 640) > 3)
        self.assertEqual(self.commands("out.jsonl"), [])
        self.quit()

    def test_a_daemon_that_hangs_up_does_no_harm(self):
        self.open_display(640, 360)
        path = self.folder / "spnav.sock"
        server = socket.socket(socket.AF_UNIX)
        self.addCleanup(server.close)
        server.bind(str(path))
        server.listen(1)
        hung_up = threading.Event()

        def hang_up():
            client, _ = server.accept()
            client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            client.close()
            hung_up.set()

        threading.Thread(target=hang_up, daemon=True).start()
        self.environment["SPNAV_SOCKET"] = str(path)
        self.begin_light()
        self.assertTrue(hung_up.wait(60))
        self.settle()
        self.quit()

    def test_a_daemon_that_answers_nobody_delays_nothing(self):
        self.open_display(640, 360)
        path = self.folder / "spnav.sock"
        server = socket.socket(socket.AF_UNIX)
        self.addCleanup(server.close)
        server.bind(str(path))
        server.listen(0)
        waiting = socket.socket(socket.AF_UNIX)  # the queue is full: whoever comes next waits in connect()
        self.addCleanup(waiting.close)
        waiting.connect(str(path))
        self.environment["SPNAV_SOCKET"] = str(path)
        self.begin_light()
        self.quit()


if __name__ == "__main__":
    unittest.main()
