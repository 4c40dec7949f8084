"""Every example runs and prints what it promises."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

examples = Path(__file__).parents[3] / "app/python/examples"
# sweep.py: test_sweep.py; inverse_problem.py: test_fit.py; ppo_reach.py needs torch and takes minutes
elsewhere = {"sweep", "inverse_problem", "ppo_reach"}
runs = {
    "pull_and_plot": (["--seconds", "0.6", "--out", "OUT.png"], "600 ticks", ["matplotlib"]),
    "compare_laws": (["--out", "OUT.png"], "neo_hookean", ["matplotlib"]),
    "batch": (["--worlds", "3", "--ticks", "50"], "a lone world has the same hash", []),
    "gym_rollout": (["--environment", "heml/Reach-v0", "--out", "OUT.png"], "success: True", ["gymnasium"]),
}


def run(name, tmp_path):
    arguments, _, packages = runs[name]
    for package in packages:
        pytest.importorskip(package)
    out = tmp_path / "out.png"
    arguments = [argument.replace("OUT.png", str(out)) for argument in arguments]
    done = subprocess.run([sys.executable, examples / f"{name}.py", *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert out.exists() == (str(out) in arguments)
    return done.stdout


@pytest.mark.parametrize("name", runs)
def test_runs(name, tmp_path):
    assert runs[name][1] in run(name, tmp_path)


def test_laws_of_equal_stiffness_bend_alike(tmp_path):
    bends = [float(text) for text in re.findall(r"bends by ([\d.]+) mm", run("compare_laws", tmp_path))]
    assert len(bends) == 5
    assert max(bends) < 1.1 * min(bends)


def test_every_example_is_tested():
    assert {path.stem for path in examples.glob("*.py")} == set(runs) | elsewhere
