"""`heml refine`: that it ends, and is seen to work meanwhile. HEML_BINARY is the path of the program."""
import os
import pty
import unittest

from program import ProgramCase, beam, heml


class Refine(ProgramCase):
    def refined(self, *options, **changes):
        self.write("scene.json", beam(**changes))
        return heml("refine", "scene.json", "--out", "fine", *options, cwd=self.folder)

    def test_a_body_that_hangs_on_one_node_ends_with_a_word_and_a_mesh(self):
        done = self.refined(boundary=[{"nodes": [0], "fix": True}],
                            mesh={"box": {"size": [0.1, 0.02, 0.02], "cells": [10, 4, 4]}},
                            materials=[{"law": "neo_hookean", "young": 1e4, "poisson": 0.45}])
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in ("warning: scene.json: 10 % is not reached", "hardly fallen", "single nodes"):
            self.assertIn(word, done.stderr)
        self.assertLess(done.stdout.count("tetrahedra, estimated error"), 30)
        self.assertEqual(heml("solve", "fine/scene.json", "--out", "out", cwd=self.folder).returncode, 0)

    def test_too_few_tetrahedra_are_told_with_the_option_that_allows_more(self):
        done = self.refined("--error", "1", "--tets", "300")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("warning: scene.json: 1 % would need more than 300 tetrahedra (--tets)", done.stderr)

    def test_progress_is_shown_on_a_terminal_alone(self):
        self.assertEqual(self.refined("--error", "50").stderr, "")
        ours, theirs = pty.openpty()
        done = heml("refine", "scene.json", "--out", "fine", "--error", "50", cwd=self.folder, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 4096):
                shown += part
        except OSError:  # the end of a terminal that has been closed
            pass
        os.close(ours)
        self.assertEqual(done.returncode, 0)
        self.assertIn("heml: refining", shown.decode())
        self.assertIn("solving 120 tetrahedra", shown.decode())
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown)


if __name__ == "__main__":
    unittest.main()
