"""Runs a function over many cases on Dask, with a table that grows as results come (extra `sweep`)."""

from __future__ import annotations

import csv
import hashlib
import inspect
import json
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

import heml
from heml._optional import require

if TYPE_CHECKING:
    import pandas
    from dask.distributed import Client

Case = Mapping[str, Any]
Row = dict[str, Any]


def sweep(
    function: Callable[[dict[str, Any]], Any],
    cases: Iterable[Case],
    client: Union[None, str, Client] = None,
    out: Union[None, str, os.PathLike[str]] = None,
) -> pandas.DataFrame:
    """Calls `function(case)` for every case on Dask workers and gathers the results in a table.

    A row has the columns of its case, those of the result, `error` (text; empty where the call succeeded), `seconds`
    (of the call) and `key`. The key is a hash of the function's source, the case and heml's version. Rows of `out` with the
    key of a case and without error are taken as they are, so an interrupted sweep continues where it stopped.
    Dask repeats cases of workers that die.

    Args:
        function: takes a dict; returns a dict of numbers and text, or one number (column `result`). Arrays and lists
            are kept as JSON text. A script that defines it starts its work under `if __name__ == "__main__":`.
        cases: dicts of JSON values, each different from all others.
        client: a dask.distributed.Client, the address of a scheduler (tcp://host:8786), or None: a cluster on this
            machine with a process for each core.
        out: `.csv`: a file to which each row is appended when it comes (text that reads as a number becomes one when a
            sweep continues); `.parquet`: a folder with one file a row, which keeps types.

    Returns:
        pandas.DataFrame with a row for each case, in the order of `cases`.

    Raises:
        InputError: cases that are no dicts of JSON values or come twice; another ending of `out`.
    """
    pandas = require("pandas", "sweep")
    distributed = require("dask.distributed", "sweep")
    source = source_of(function)
    wanted: dict[str, dict[str, Any]] = {}
    for case in cases:
        key = case_key(source, case)
        if key in wanted:
            raise heml.InputError(f"sweep: the case {json.dumps(dict(case))} is given twice")
        wanted[key] = dict(case)
    table = open_table(out)
    rows = {key: {**row, **wanted[key]} for key, row in table.read().items() if key in wanted and not row["error"]}
    progress = _Progress(len(wanted), len(rows))
    with _connected(client) as cluster:
        futures = {
            cluster.submit(run_case, function, case, key=f"heml-{key}-{time.time_ns()}", pure=False): key
            for key, case in wanted.items()
            if key not in rows
        }
        for future in distributed.as_completed(futures):
            key = futures[future]
            rows[key] = {**wanted[key], **_outcome(future), "key": key}
            table.add(rows[key])
            progress.show(rows[key]["error"])
            future.release()
    return pandas.DataFrame([rows[key] for key in wanted])


def run_case(function: Callable[[dict[str, Any]], Any], case: dict[str, Any]) -> Row:
    """The part of a row that a worker computes. A failure is a row with `error`."""
    start = time.perf_counter()
    try:
        result = function(dict(case))
        values = dict(result) if isinstance(result, Mapping) else {"result": result}
        row = {str(name): _plain(value) for name, value in values.items()} | {"error": ""}
    except Exception as failure:  # noqa: BLE001: any failure of a case is a row
        row = {"error": f"{type(failure).__name__}: {failure}"}
    return row | {"seconds": time.perf_counter() - start}


def source_of(function: Callable[..., Any]) -> str:
    """What the key of a case contains of its function: source, default values, and values it encloses."""
    target = inspect.unwrap(function)
    try:
        source = inspect.getsource(target)
    except (OSError, TypeError):
        raise heml.InputError(
            f"sweep: the source of {function!r} cannot be read; define it by `def` in a file or a notebook"
        ) from None
    closure = inspect.getclosurevars(target).nonlocals if inspect.isfunction(target) else {}
    defaults = getattr(target, "__defaults__", None)
    return "\n".join((source, repr(defaults), repr(sorted(closure.items()))))


def case_key(source: str, case: Case) -> str:
    """32 hexadecimal digits."""
    try:
        text = json.dumps(dict(case), sort_keys=True)
    except (TypeError, ValueError) as wrong:
        raise heml.InputError(f"sweep: a case is a dict of JSON values, not {case!r}: {wrong}") from None
    return hashlib.sha256("\0".join((heml.__version__, source, text)).encode()).hexdigest()[:32]


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return json.dumps(value) if isinstance(value, (list, tuple, dict)) else value


def _outcome(future: Any) -> Row:
    if future.status == "finished":
        return dict(future.result())
    failure = future.exception()  # of Dask: its workers died, or the case was cancelled
    return {"error": f"{type(failure).__name__}: {failure}", "seconds": float("nan")}


@contextmanager
def _connected(client: Union[None, str, Client]) -> Iterator[Client]:
    """A client; one that is made here is closed again, with its cluster."""
    distributed = require("dask.distributed", "sweep")
    if client is None:
        with distributed.LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster:
            with distributed.Client(cluster) as made:
                yield made
    elif isinstance(client, str):
        with distributed.Client(client) as made:
            yield made
    else:
        yield client


class _Progress:
    """A line on stderr: rewritten on a terminal, else at every tenth of the cases."""

    def __init__(self, total: int, found: int) -> None:
        self.total, self.done, self.found, self.failed, self.start = total, found, found, 0, time.monotonic()

    def show(self, error: str) -> None:
        self.done += 1
        self.failed += error != ""
        terminal = sys.stderr.isatty()
        if error and self.failed == 1:
            sys.stderr.write(("\r\x1b[K" if terminal else "") + f"sweep: the first that fails: {error}\n")
        tenth = max(self.total // 10, 1)
        if not terminal and self.done % tenth and self.done != self.total:
            return
        elapsed = time.monotonic() - self.start
        left = elapsed / (self.done - self.found) * (self.total - self.done)
        text = f"sweep: {self.done}/{self.total}, {self.failed} failed, {elapsed:.0f} s, {left:.0f} s left"
        ending = "\n" if not terminal or self.done == self.total else ""
        sys.stderr.write(("\r\x1b[K" if terminal else "") + text + ending)
        sys.stderr.flush()


def _value(column: str, text: str) -> Any:
    """A cell of a CSV file: number, True or False, None where it is empty, or text."""
    if column in ("key", "error"):
        return text
    if text in ("", "True", "False"):
        return {"True": True, "False": False}.get(text)
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


class NoTable:
    """Rows that are not kept on disk."""

    def read(self) -> dict[str, Row]:
        """Rows by key."""
        return {}

    def add(self, row: Row) -> None:
        """Keeps a row; one with the same key is replaced when the table is read."""


class CsvTable(NoTable):
    """A CSV file. A row with new columns has the file written anew, by way of a file beside it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows = self._load()
        self.columns = list(next(iter(self.rows.values()), {}))
        self._write()

    def _load(self) -> dict[str, Row]:
        if not self.path.exists() or self.path.stat().st_size == 0:
            return {}
        with open(self.path, newline="") as file:
            reader = csv.DictReader(file)
            if not {"key", "error"} <= set(reader.fieldnames or ()):
                raise heml.InputError(f"{self.path}: no table of a sweep (columns key and error); give another `out`")
            rows = [{name: _value(name, text) for name, text in row.items() if text is not None} for row in reader]
        return {row["key"]: row for row in rows if len(str(row.get("key"))) == 32}  # others: cut short by a crash

    def _write(self) -> None:
        if not self.columns:
            return
        beside = self.path.with_suffix(".csv.part")
        with open(beside, "w", newline="") as file:
            writer = csv.DictWriter(file, self.columns)
            writer.writeheader()
            writer.writerows(self.rows.values())
        beside.replace(self.path)

    def read(self) -> dict[str, Row]:
        return self.rows

    def add(self, row: Row) -> None:
        again = row["key"] in self.rows
        self.rows[row["key"]] = row
        added = [name for name in row if name not in self.columns]
        self.columns += added
        if added or again:
            self._write()
            return
        with open(self.path, "a", newline="") as file:
            csv.DictWriter(file, self.columns).writerow(row)


class ParquetTable(NoTable):
    """A folder with a Parquet file a row, named after its key. pandas.read_parquet reads the folder."""

    def __init__(self, path: Path) -> None:
        require("pyarrow", "sweep")
        if path.exists() and not path.is_dir():
            raise heml.InputError(f"{path}: is a file; a sweep writes a folder there")
        path.mkdir(parents=True, exist_ok=True)
        self.path = path

    def read(self) -> dict[str, Row]:
        pandas = require("pandas", "sweep")
        found = (pandas.read_parquet(file).to_dict("records")[0] for file in sorted(self.path.glob("*.parquet")))
        return {row["key"]: row for row in found}

    def add(self, row: Row) -> None:
        pandas = require("pandas", "sweep")
        beside = self.path / f"{row['key']}.part"
        pandas.DataFrame([row]).to_parquet(beside, index=False)
        beside.replace(self.path / f"{row['key']}.parquet")


def open_table(out: Union[None, str, os.PathLike[str]]) -> NoTable:
    """The table of an `out` of `sweep`."""
    if out is None:
        return NoTable()
    path = Path(out)
    if path.suffix not in (".csv", ".parquet"):
        raise heml.InputError(f"sweep: out={str(path)!r}; the endings are .csv and .parquet")
    path.parent.mkdir(parents=True, exist_ok=True)
    return CsvTable(path) if path.suffix == ".csv" else ParquetTable(path)
