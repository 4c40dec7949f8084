"""FEBio's own test models, solved by heml, against the displacements that FEBio records for them.

    git clone https://github.com/febiosoftware/TestSuite
    HEML_BINARY=build/release/app/heml python3 tests/bench/febio.py TestSuite [SECONDS]

The suite records of each model the Euclidean norm of the displacements of all coordinates that are neither held nor moved
(code/linuxGoldStandards.py). Models with anything that heml does not compute as FEBio does are refused, and counted.
"""
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

BINARY = os.environ["HEML_BINARY"]
REFUSED = 3


def recorded(suite):
    text = (suite / "code" / "linuxGoldStandards.py").read_text()
    return {name: float(norm) for name, norm in re.findall(r"'(\w+)': \['Normal', [^\]]*, '([^']+)'\]", text)}


def norm_of_displacements(root, scene, positions):
    at_rest = [[float(x) for x in node.text.split(",")] for nodes in root.iter("Nodes") for node in nodes]
    bound = {(node, axis) for entry in scene["boundary"] for node in entry["nodes"] for axis in entry.get("axes", "xyz")}
    return math.sqrt(sum((float(positions[n][1 + i]) - X[i]) ** 2 for n, X in enumerate(at_rest)
                         for i in range(3) if (n, "xyz"[i]) not in bound))


def solve(model, folder, seconds):
    """What heml says, or the norm and the number of elements of each kind."""
    root = ElementTree.parse(model).getroot()
    try:
        run = subprocess.run([BINARY, "solve", str(model), "--out", str(folder)], capture_output=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return f"not within {seconds:g} s"
    if run.returncode:
        return "refused" if run.returncode == REFUSED else run.stderr.decode().strip().splitlines()[-1]
    subprocess.run([BINARY, "explain", str(model), "--save", str(folder / "scene.json")], capture_output=True, check=True)
    rows = list(csv.reader((folder / "positions.csv").open()))[1:]
    kinds = {part.get("type"): 0 for part in root.iter("Elements")}
    for part in root.iter("Elements"):
        kinds[part.get("type")] += len(part)
    return norm_of_displacements(root, json.loads((folder / "scene.json").read_text()), rows), kinds, root.find("Contact")


def main():
    suite, seconds = pathlib.Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 60
    counts, gold = {}, recorded(suite)
    print("| model | elements | norm of displacements, FEBio | heml, of it | |\n|---|---|---|---|---|")
    for model in sorted((suite / "Verify").glob("*.feb")):
        if not gold.get(model.stem):
            continue
        with tempfile.TemporaryDirectory() as folder:
            try:
                found = solve(model, pathlib.Path(folder), seconds)
            except ElementTree.ParseError:
                found = "is no XML"
        counts[found if isinstance(found, str) else "solved"] = counts.get(found if isinstance(found, str) else "solved", 0) + 1
        if isinstance(found, str):
            continue
        norm, kinds, contact = found
        elements = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
        print(f"| {model.stem} | {elements} | {gold[model.stem]:.6g} | {norm / gold[model.stem]:.9f} | "
              f"{'contact' if contact is not None and len(contact) else ''} |")
    print("\n" + "; ".join(f"{count} {what}" for what, count in sorted(counts.items())))


main()
