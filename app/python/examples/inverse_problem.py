"""Three Young's moduli of a kidney from 50 measured points with 0.1 mm of noise.

    python inverse_problem.py [--scene assets/scenes/kidney_grasp.json]

The kidney hangs under gravity and is stretched by 3 N at both ends. Upper half, lower half and vessels have moduli of
their own. "Measured" points are nodes of the equilibrium with known moduli, plus noise; the fit begins at 10 kPa everywhere.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

import heml

true_moduli = {"materials[0].young": 8e3, "materials[1].young": 1.5e4, "materials[2].young": 1.2e4}


def kidney_of_three_regions(scene_file: str, folder: str) -> dict:
    """A static scene of the kidney whose lower half is region 3."""
    scene = heml.Scene(scene_file).to_dict()
    world = heml.World(heml.Scene(scene))
    mesh, regions = world.to_meshio(fields=[]), np.where(world.regions() == 2, 2, 1)
    tets = mesh.cells_dict["tetra"]
    height = mesh.points[tets].mean(axis=1)[:, 1]
    regions[(regions == 1) & (height < np.median(height[regions == 1]))] = 3
    mesh.cell_data["medit:ref"] = [regions]
    mesh.write(Path(folder) / "kidney3.mesh")
    ends = [mesh.points[np.argmin(mesh.points[:, 0])], mesh.points[np.argmax(mesh.points[:, 0])]]
    tissue = {"law": "neo_hookean", "young": 1e4, "poisson": 0.43, "density": 1050}
    return {
        "schema_version": 1,
        "mesh": {"file": str(Path(folder) / "kidney3.mesh")},
        "materials": [tissue, tissue | {"region": 2}, tissue | {"region": 3}],
        "boundary": scene["boundary"],
        "gravity": scene["gravity"],
        "loads": [{"sphere": [end.tolist(), 0.02], "force": force} for end, force in zip(ends, ([-3, 1, 0], [3, -1, 0]))],
        "solver": {"integrator": "static"},
    }


def with_moduli(scene: dict, moduli: dict[str, float]) -> dict:
    materials = [material | {"young": young} for material, young in zip(scene["materials"], moduli.values())]
    return scene | {"materials": materials}


def main() -> float:
    """Returns the greatest relative error of a modulus."""
    parser = argparse.ArgumentParser(description=__doc__)
    scenes = Path(__file__).parents[3] / "assets/scenes"
    parser.add_argument("--scene", default=str(scenes / "kidney_grasp.json"))
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = kidney_of_three_regions(arguments.scene, folder)
        truth, _ = heml.solve(heml.Scene(with_moduli(scene, true_moduli)))
        random = np.random.default_rng(arguments.seed)
        nodes = random.choice(len(truth), 50, replace=False)
        measured = truth[nodes] + random.normal(0, 1e-4, (50, 3))
        start = time.perf_counter()
        observations = {"nodes": nodes, "positions": measured, "sigma": 1e-4}
        result = heml.fit(scene, observations, list(true_moduli))
        seconds = time.perf_counter() - start
    print(result)
    errors = [abs(result.values[path] / true - 1) for path, true in true_moduli.items()]
    print(f"greatest error of a modulus {100 * max(errors):.2f} %, {seconds:.1f} s")
    return max(errors)


if __name__ == "__main__":
    main()
