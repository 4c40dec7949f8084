#!/usr/bin/env python3
"""Writes assets/meshes/kidney_adapted.mesh and assets/scenes/kidney_adapted.json: the pulled kidney of quadratic elements, on
a mesh that is coarse where it may be and fine where its estimated error is.

    python3 assets/make/kidney_adapted.py build/release/app/heml build/release/assets/make/heml-make-assets

The coarse mesh has edges of 10 mm at the surface instead of 5.75; `heml refine` bisects its elements at the vessels.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import extreme
from extreme import ASSETS

MOST_TETS = 1000
TAKEN_AT = 641  # node of the kidney's own mesh, at its lower pole


def nodes_of(path):
    lines = path.read_text().splitlines()
    first = lines.index("Vertices") + 2
    return [[float(word) for word in line.split()[:3]] for line in lines[first:first + int(lines[first - 1])]]


def turned(X, rotate):
    angle = math.radians(rotate["degrees"])
    assert rotate["axis"] == [0, 0, 1] and rotate["origin"] == [0, 0, 0]
    return [math.cos(angle) * X[0] - math.sin(angle) * X[1], math.sin(angle) * X[0] + math.cos(angle) * X[1], X[2]]


def main(heml, make_assets):
    scene = json.loads((ASSETS / "scenes/kidney_pull.json").read_text())
    rotate = scene["mesh"]["rotate"]
    taken = turned(nodes_of(ASSETS / "meshes/kidney.mesh")[TAKEN_AT], rotate)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([make_assets, name, "kidney_coarse"], check=True)
        scene["mesh"] = {"file": "kidney_coarse.mesh", "rotate": rotate}
        scene["solver"] |= {"element": "p2", "precision": "float"}
        scene["events"][0]["grasp"] = {"point": [round(x, 4) for x in taken], "radius": scene["events"][0]["grasp"]["radius"]}
        # Of corners alone: spheres would take middles of edges that reach out of them too.
        places = [turned(X, rotate) for X in nodes_of(folder / "kidney_coarse.mesh")]
        for entry in scene["boundary"]:
            centre, radius = entry.pop("sphere")
            entry["nodes"] = [n for n, X in enumerate(places) if math.dist(X, centre) <= radius]
        (folder / "coarse.json").write_text(json.dumps(scene))
        subprocess.run([heml, "refine", folder / "coarse.json", "--out", folder, "--error", "1", "--tets", str(MOST_TETS)])
        subprocess.run([heml, "mesh", folder / "mesh.vtu", "--out", ASSETS / "meshes/kidney_adapted.mesh"], check=True)
        held = [entry["nodes"] for entry in json.loads((folder / "scene.json").read_text())["boundary"]]
    extreme.OUT = ASSETS / "scenes"
    extreme.scene("kidney_adapted", "Kidney of quadratic elements, pulled and let go", "The pulled kidney with a fifth of its "
                  "error in the time that a frame has: quadratic elements on a mesh that is coarse inside and fine where the "
                  "vessels are held.", {"asset": "kidney_adapted"}, [{"nodes": nodes, "fix": True} for nodes in held],
                  scene["solver"], materials=scene["materials"], gravity=scene["gravity"], view=scene["view"],
                  events=scene["events"])


if __name__ == "__main__":
    main(*sys.argv[1:])
