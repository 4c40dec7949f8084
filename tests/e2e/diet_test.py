"""Features that a scene does not use load no library, take no memory and change no bit. HEML_BINARY is the path of the
program."""
import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import unittest

BINARY = os.environ["HEML_BINARY"]
DRAWING = ("libGL", "libEGL", "libGLX", "libOSMesa", "libglfw", "libX11", "libxcb", "libLLVM")
SURFACES = ("libassimp", "libtet")
SCENE = {
    "schema_version": 1,
    "name": "block",
    "mesh": {"box": {"size": [0.1, 0.04, 0.04], "cells": [10, 4, 4]}},
    "materials": [{"law": "neo_hookean_iso", "K1": 1500, "kappa": 2e4}],
    "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
    "gravity": [0, -9.81, 0],
    "solver": {"duration": 0.2},
}


def run(*arguments):
    """Exit code and the names of all loaded libraries, from the dynamic linker's log."""
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, LD_DEBUG="libs", LD_DEBUG_OUTPUT=folder + "/linker")
        done = subprocess.run([BINARY, *map(str, arguments)], env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
        told = "".join(file.read_text() for file in pathlib.Path(folder).iterdir())
    return done.returncode, set(re.findall(r"calling init: \S*/(lib[^/\s]*\.so[.\d]*)$", told, re.MULTILINE))


def greatest_memory(*arguments):
    """Exit code and peak memory, bytes; by a forked child, since RUSAGE_CHILDREN is the maximum over all children."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        done = subprocess.run([BINARY, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        peak = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        os.write(write, f"{done.returncode} {peak}".encode())
        os._exit(0)
    os.waitpid(child, 0)
    code, peak = os.read(read, 100).decode().split()
    os.close(read), os.close(write)
    return int(code), int(peak)


class Diet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, **changes):
        path = self.folder / name
        path.write_text(json.dumps({**SCENE, **changes}))
        return path

    def solved(self, name, **changes):
        done = subprocess.run([BINARY, "solve", self.write(name + ".json", **changes), "--out", self.folder / name],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / name / "report.json").read_text())

    def test_solving_a_tetrahedral_mesh_loads_no_drawing_and_no_reader_of_surfaces(self):
        scene = self.write("scene.json")
        for command in (["solve", scene, "--out", self.folder / "out"], ["explain", scene], ["materials"]):
            code, libraries = run(*command)
            self.assertEqual(code, 0)
            self.assertTrue(any(name.startswith("libstdc++") for name in libraries), "the watch sees libraries")
            for unneeded in DRAWING + SURFACES:
                self.assertFalse([name for name in libraries if name.startswith(unneeded)], f"{command[0]}: {unneeded}")

    def test_a_capture_loads_the_renderer_and_no_window(self):
        code, libraries = run("capture", self.write("scene.json"), "--out", self.folder / "f", "--frames", 3)
        self.assertEqual(code, 0)
        self.assertTrue(any(name.startswith("libOSMesa") for name in libraries), "so the test above can fail")
        for unneeded in ("libglfw", "libX11") + SURFACES:
            self.assertFalse([name for name in libraries if name.startswith(unneeded)], unneeded)

    def test_what_draws_takes_memory_that_solving_does_not(self):
        scene = self.write("scene.json", solver={"duration": 0.01})
        code, solving = greatest_memory("solve", scene, "--out", self.folder / "out")
        self.assertEqual(code, 0)
        code, drawing = greatest_memory("capture", scene, "--out", self.folder / "f", "--frames", 1)
        self.assertEqual(code, 0)
        self.assertLess(solving, 40e6, "the program, a small body and its results")
        self.assertLess(2 * solving, drawing)

    def test_what_is_off_or_never_acts_changes_no_bit(self):
        plain = self.solved("plain")["state_hash"]
        off = {
            "viscosity": {"materials": [{**SCENE["materials"][0], "viscosity": 0}]},
            "a region without elements": {"materials": [*SCENE["materials"], {"region": 7, "law": "stvk", "young": 1e4,
                                                                             "poisson": 0.3, "viscosity": 10}]},
            "continuation that is not reached": {"solver": {"duration": 0.2, "continuation": True}},
            "recovery that is not needed": {"solver": {"duration": 0.2, "continuation": True, "recovery": True}},
            "damping": {"solver": {"duration": 0.2, "damping": 0}},
            "threads": {"solver": {"duration": 0.2, "threads": 1}},
            "a load of nothing": {"loads": [{"box": [[0.0999, -1, -1], [1, 1, 1]], "force": [0, 0, 0]}]},
            "a view": {"view": {"field": "von_mises"}},
        }
        for name, changes in off.items():
            self.assertEqual(self.solved("off", **changes)["state_hash"], plain, name)
        on = {"viscosity": {"materials": [{**SCENE["materials"][0], "viscosity": 10}]},
              "damping": {"solver": {"duration": 0.2, "damping": 1}}}
        for name, changes in on.items():
            self.assertNotEqual(self.solved("on", **changes)["state_hash"], plain, name)


if __name__ == "__main__":
    unittest.main()
