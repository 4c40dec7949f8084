"""python -m heml.study: the same results as the program alone."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from heml import study

root = Path(__file__).parents[3]
program = os.environ.get("HEML_BINARY", str(root / "build/release/app/heml"))


def test_the_number_of_cases_is_that_of_the_command():
    commands = (root / "app/docs/commands.md").read_text()
    assert re.search(r"`--case N` .*1 to (\d+)", commands)[1] == str(study.stability_cases)


def test_results_are_gathered_once(tmp_path):
    (tmp_path / "results.jsonl").write_text('{"key":"a"}\n')
    study.gather(tmp_path, ['{"key":"b"}\n', '{"key":"a"}\n{"key":"c"}\n'])
    study.gather(tmp_path, ['{"key":"b"}\n'])
    assert (tmp_path / "results.jsonl").read_text() == '{"key":"a"}\n{"key":"b"}\n{"key":"c"}\n'


def results(folder):
    """Outcomes by key, without the time that measuring took."""
    lines = map(json.loads, (folder / "results.jsonl").read_text().splitlines())
    return {line["key"]: {k: v for k, v in line["result"].items() if k != "seconds"} for line in lines}


@pytest.mark.skipif(not Path(program).exists(), reason=f"needs the program {program}")
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
