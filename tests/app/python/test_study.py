"""python -m heml.study: the same results as the program alone."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from heml import study

root = Path(__file__).parents[3]
program = os.environ.get("HEML_BINARY", str(root / "build/release/app/heml"))


needs_program = pytest.mark.skipif(not Path(program).exists(), reason=f"needs the program {program}")


@needs_program
@pytest.mark.parametrize("kind, quick", study.case_counts)
def test_the_number_of_cases_is_that_of_the_command(kind, quick, tmp_path):
    beyond = str(study.case_counts[kind, quick] + 1)
    command = [program, "study", kind, "--out", tmp_path, "--case", beyond, *["--quick"] * quick]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.endswith(f"--case is {beyond}, the cases are 1 to {study.case_counts[kind, quick]}\n")


def test_results_are_gathered_once(tmp_path):
    (tmp_path / "results.jsonl").write_text('{"key":"a"}\n')
    study.gather(tmp_path, ['{"key":"b"}\n', '{"key":"a"}\n{"key":"c"}\n'])
    study.gather(tmp_path, ['{"key":"b"}\n'])
    assert (tmp_path / "results.jsonl").read_text() == '{"key":"a"}\n{"key":"b"}\n{"key":"c"}\n'


def results(folder):
    """Outcomes by key, without the time that measuring took."""
    lines = map(json.loads, (folder / "results.jsonl").read_text().splitlines())
    return {line["key"]: {k: v for k, v in line["result"].items() if k != "seconds"} for line in lines}


@needs_program
def test_the_same_results_as_on_one_machine(tmp_path):
    pytest.importorskip("dask.distributed")
    pytest.importorskip("pandas")
    chosen = ["stability", "--quick", "--case", "1", "--case", "2"]
    alone = subprocess.run([program, "study", *chosen, "--out", tmp_path / "alone"], capture_output=True)
    chosen += ["--program", program, "--out", tmp_path / "spread"]
    spread = subprocess.run([sys.executable, "-m", "heml.study", *chosen], capture_output=True, text=True)
    assert spread.returncode == alone.returncode, spread.stderr
    assert results(tmp_path / "spread") == results(tmp_path / "alone")
    assert (tmp_path / "spread/cells.csv").read_text() == (tmp_path / "alone/cells.csv").read_text()


@needs_program
def test_cases_of_accuracy_find_the_errors_of_the_whole_study(tmp_path):
    pytest.importorskip("dask.distributed")
    pytest.importorskip("pandas")
    whole = [program, "study", "accuracy", "--quick", "--out", tmp_path / "alone"]
    assert subprocess.run(whole, capture_output=True).returncode == 0
    spread = [sys.executable, "-m", "heml.study", "accuracy", "--quick", "--program", program]
    done = subprocess.run([*spread, "--out", tmp_path / "spread"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    figures = [json.loads((tmp_path / folder / "figures.json").read_text()) for folder in ("alone", "spread")]
    assert figures[0] == figures[1]
