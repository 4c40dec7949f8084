"""`python -m heml.study KIND`: spreads the cases of `heml study stability` or `accuracy` over Dask workers (extra `sweep`).

Each case is one run of the program with `--case N` on a worker. Its results come back as text, so workers need no common
file system. They are gathered in the `results.jsonl` of `--out`; the program then finds every case measured and writes
the report of the whole study. Workers must have the same build of the program: it ignores results of others.

Errors are the same wherever they are measured; run times are those of the worker, so for `accuracy` all should be alike.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from heml._optional import require

case_counts = {("stability", False): 33, ("stability", True): 33, ("accuracy", False): 34, ("accuracy", True): 4}
"""By kind of study and whether it is quick."""
_checked_or_done = (0, 1)  # exit codes of a study that was measured: all promises kept, or some not


def run_case(case: dict[str, Any]) -> dict[str, Any]:
    """Measures one case in a temporary folder; returns the lines of its results.jsonl (column `lines`)."""
    with tempfile.TemporaryDirectory(prefix="heml-study-") as folder:
        command = [case["program"], "study", case["kind"], "--case", str(case["number"]), "--out", folder]
        done = subprocess.run(command + ["--quick"] * case["quick"], capture_output=True, text=True, check=False)
        if done.returncode not in _checked_or_done:
            raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()[-2000:]}")
        return {"lines": (Path(folder) / "results.jsonl").read_text()}


def gather(out: Path, texts: Sequence[str]) -> None:
    """Adds lines to the results of `out` that are not there yet."""
    file = out / "results.jsonl"
    present = file.read_text().splitlines() if file.exists() else []
    lines = dict.fromkeys(present + [line for text in texts for line in text.splitlines()])
    beside = out / "results.jsonl.part"
    beside.write_text("".join(line + "\n" for line in lines))
    beside.replace(file)


def _arguments(given: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m heml.study", description="Spreads a study over Dask workers.")
    parser.add_argument("kind", choices=sorted({kind for kind, _ in case_counts}))
    parser.add_argument("--out", type=Path, required=True, help="folder for the report; an interrupted study goes on there")
    parser.add_argument("--scheduler", help="tcp://host:8786; without: the cases one after another on this machine")
    parser.add_argument("--quick", action="store_true", help="fewer and smaller cases")
    parser.add_argument("--case", type=int, action="append", metavar="N", help="these cases alone (may be given often)")
    parser.add_argument(
        "--program",
        default=os.environ.get("HEML_PROGRAM") or shutil.which("heml"),
        help="the program heml, on every machine; else $HEML_PROGRAM, or that of the PATH",
    )
    arguments = parser.parse_args(given)
    if not arguments.program:
        parser.error("the program heml is not in the PATH: give --program or set HEML_PROGRAM")
    return arguments


def main(given: Sequence[str] | None = None) -> int:
    """Returns the exit code of the study; 4 if cases could not be measured."""
    from heml._sweep import sweep

    distributed = require("dask.distributed", "sweep")
    arguments = _arguments(given)
    arguments.out.mkdir(parents=True, exist_ok=True)
    numbers = arguments.case or range(1, case_counts[arguments.kind, arguments.quick] + 1)
    build = hashlib.sha256(Path(arguments.program).read_bytes()).hexdigest()[:16]  # other builds measure again
    fixed = {"kind": arguments.kind, "quick": arguments.quick, "program": arguments.program, "build": build}
    cases = [fixed | {"number": number} for number in numbers]
    cluster = None
    if not arguments.scheduler:  # one worker: a case uses all cores itself
        cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)
    try:
        rows = sweep(run_case, cases, arguments.scheduler or cluster.scheduler_address, arguments.out / "cases.parquet")
    finally:
        if cluster:
            cluster.close()
    failed = rows[rows["error"] != ""]
    for _, row in failed.iterrows():
        print(f"case {row['number']}: {row['error']}", file=sys.stderr)
    if len(failed):
        return 4
    gather(arguments.out, list(rows["lines"]))
    chosen = [word for number in arguments.case or () for word in ("--case", str(number))]
    command = [arguments.program, "study", arguments.kind, "--out", str(arguments.out), *chosen]
    return subprocess.run(command + ["--quick"] * arguments.quick, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
