"""What is chosen for bare meshes, and how fast they run headless and in the window, on this machine: the table of
app/docs/your-own-organ.md.

    HEML_BINARY=build/release/app/heml python3 tests/bench/organ.py [MESH ...] [--window SECONDS]

Without meshes: those that this file makes, and the assets.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[1] / "e2e"))
from display import Display  # noqa: E402
from organ_test import SHAPES, box, medit  # noqa: E402

BINARY = os.environ["HEML_BINARY"]
ASSETS = sorted((HERE.parents[2] / "assets" / "meshes").glob("*.mesh"))
MORE_SHAPES = {
    "large": box((26, 18, 18), (0.2, 0.15, 0.15)),
    "rod": box((60, 3, 3), (0.4, 0.02, 0.02)),
    "z_up": box((6, 6, 9), (0.1, 0.1, 0.15), lambda x: [x[0], x[1] + 0.3 * (0.05 - abs(x[0] - 0.05)), x[2]]),
}


def chosen_for(mesh):
    done = subprocess.run([BINARY, "explain", mesh, "--json"], capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip().splitlines()[-1]
    return json.loads(done.stdout), ""


def headless(mesh, folder, cores):
    """Wall seconds a simulated second on so many cores, and the report."""
    taskset = ["taskset", "-c", ",".join(map(str, range(cores)))] if shutil.which("taskset") else []
    subprocess.run([*taskset, BINARY, "solve", mesh, "--out", folder / "out"], capture_output=True)
    report = json.loads((folder / "out" / "report.json").read_text())
    return report["wall_seconds"] / max(report["time"], 1e-9), report


def window(mesh, folder, seconds):
    """Seconds until the body moves, and wall seconds a simulated second after that."""
    display = Display(folder, 1280, 720)
    environment = dict(os.environ, DISPLAY=display.name, XDG_STATE_HOME=str(folder / "state"))
    try:
        began = time.monotonic()
        program = subprocess.Popen([BINARY, "run", mesh, "--log-pictures", "--exit-after", str(seconds)],
                                   env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        alive = None
        for line in program.stderr:
            if alive is None and re.match(r"frame \d+, tick [1-9]", line):
                alive = time.monotonic() - began
        told = program.stdout.read()
        program.wait()
    finally:
        display.close()
    pace = re.search(r"(\S+) wall seconds per simulated second", told)
    return alive, float(pace[1]) if pace else None


def row(mesh, folder, seconds):
    explained, refused = chosen_for(mesh)
    if not explained:
        return f"| {mesh.name} | refused: {refused[-120:]} |"
    chosen, body = explained["chosen"], explained["body"]
    one, report = headless(mesh, folder, 1)
    two, _ = headless(mesh, folder, 2)
    method = chosen["integrator"].replace("_", " ")
    if chosen["budget_iterations"]:
        method += f", {chosen['rate']:.0f} Hz, {chosen['budget_iterations']} it."
    cells = [mesh.name, f"{body['tets']}", f"{body['slivers']}", chosen["unit"] or "none: scaled", chosen["up"],
             chosen["supports"], f"{chosen['young'] / 1e3:.0f}", f"{chosen['stretch']:.2f}", method,
             f"{one:.2f}", f"{two:.2f}", f"{report['min_J']:.2f} to {report['max_J']:.2f}"]
    if seconds:
        alive, pace = window(mesh, folder, seconds)
        cells += [f"{alive:.1f}" if alive else "-", f"{pace:.2f}" if pace else "-"]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="*", type=pathlib.Path)
    parser.add_argument("--window", type=float, default=0)
    arguments = parser.parse_args()
    head = ["mesh", "tets", "slivers", "unit", "up", "held at", "kPa", "stretch", "method", "1 core", "2 cores", "J"]
    if arguments.window:
        head += ["s until alive", "window"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head), flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        meshes = arguments.meshes
        if not meshes:
            meshes = list(ASSETS)
            for shape, mesh in (SHAPES | MORE_SHAPES).items():
                meshes.append(folder / f"{shape}.mesh")
                meshes[-1].write_text(medit(*mesh))
        for mesh in meshes:
            print(row(mesh, folder, arguments.window), flush=True)


if __name__ == "__main__":
    main()
