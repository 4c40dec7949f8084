"""Scenes for the tests of the Python module."""
import os
import pathlib
import subprocess

import pytest

TOP = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("HEML_BINARY", str(TOP / "build/release/app/heml"))


@pytest.fixture
def box():
    """A function that makes the dict of a scene: a soft box of 80 elements, fixed at its left."""

    def make(**changes):
        scene = {
            "schema_version": 1,
            "mesh": {"box": {"size": [0.1, 0.04, 0.04], "cells": [4, 2, 2], "origin": [0, 0, 0]}},
            "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.45, "density": 1000}],
            "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
            "gravity": [0, -9.81, 0],
        }
        scene.update(changes)
        return scene

    return make


@pytest.fixture
def sweep():
    """Of a blade through the box."""
    return [[[0.06, -1, -1], [0.06, -1, 1]], [[0.06, 1, -1], [0.06, 1, 1]]]


@pytest.fixture
def program():
    """Runs the command line; returns what it printed, with `returncode`."""
    if not pathlib.Path(PROGRAM).exists():
        pytest.skip(f"needs the program {PROGRAM}")
    return lambda *arguments: subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
