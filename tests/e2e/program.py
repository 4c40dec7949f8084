"""The program as the tests run it, a scene it takes, and a case with a folder of its own. HEML_BINARY names the program."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = os.environ["HEML_BINARY"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]


def heml(*arguments, env=None, timeout=280, **more):
    """Runs the program without a display; returns what it did. env: added to the environment."""
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")} | (env or {})
    return subprocess.run([BINARY, *map(str, arguments)], env=environment, text=True, timeout=timeout,
                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | more)


def beam(**changes):
    """A soft bar of 10 cm, held at one end, that falls for 50 ms."""
    return {
        "schema_version": 1,
        "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [6, 2, 2], "origin": [0, 0, 0]}},
        "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}],
        "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
        "gravity": [0, -9.81, 0],
        "solver": {"duration": 0.05, "threads": 1},
    } | changes


class ProgramCase(unittest.TestCase):
    """self.folder is empty when a test begins, and gone when it has ended."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def assert_refused(self, done, code, *words, alone=False):
        """One error is told, which holds the words; alone: and nothing else."""
        self.assertEqual(done.returncode, code, done.stderr)
        lines = done.stderr.splitlines()
        errors = lines if alone else [line for line in lines if "error" in line]
        self.assertEqual(len(errors), 1, done.stderr)
        self.assertNotIn("internal", errors[0])
        for word in words:
            self.assertIn(word, errors[0])
