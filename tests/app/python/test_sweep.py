"""heml.sweep: results, failures, resumption, killed workers."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import heml
from heml._sweep import case_key, source_of

pandas = pytest.importorskip("pandas")
distributed = pytest.importorskip("dask.distributed")


@pytest.fixture(scope="module")
def client():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as made:
            yield made


def half(case):
    if case["x"] == 3:
        raise ValueError("three")
    return {"half": case["x"] / 2, "list": [case["x"]]}


def test_results_in_order_and_failures_as_rows(client, capfd):
    table = heml.sweep(half, [{"x": x} for x in (5, 3, 1)], client)
    assert table["x"].tolist() == [5, 3, 1]
    assert table["half"].tolist()[::2] == [2.5, 0.5]
    assert table["error"].tolist() == ["", "ValueError: three", ""]
    assert table["list"][0] == "[5]"
    assert capfd.readouterr().err.count("sweep: the first that fails: ValueError: three\n") == 1


@pytest.mark.parametrize("name", ["rows.csv", "rows.parquet"])
def test_only_open_cases_are_run_again(client, tmp_path, name):
    calls = tmp_path / "calls"

    def counted(case):
        with open(calls, "a") as file:
            file.write(".")
        if case["x"] == 1 and len(calls.read_text()) < 5:
            raise RuntimeError("not yet")
        return 0.1 * case["x"]

    cases = [{"x": x} for x in range(4)]
    first = heml.sweep(counted, cases, client, tmp_path / name)
    assert (first["error"] != "").sum() == 1
    again = heml.sweep(counted, cases + [{"x": 9}], client, tmp_path / name)
    assert len(calls.read_text()) == 4 + 2
    assert (again["error"] == "").all()
    assert again["result"].tolist() == [0.1 * x for x in (0, 1, 2, 3, 9)]
    third = heml.sweep(counted, cases, client, tmp_path / name)
    assert len(calls.read_text()) == 6
    assert third["result"].tolist() == again["result"].tolist()[:4]


def test_a_line_cut_short_is_run_again(client, tmp_path):
    out = tmp_path / "rows.csv"
    heml.sweep(half, [{"x": 2}, {"x": 4}], client, out)
    text = out.read_text()
    out.write_text(text[:-20])
    table = heml.sweep(half, [{"x": 2}, {"x": 4}], client, out)
    assert table["half"].tolist() == [1, 2]
    assert len(pandas.read_csv(out)) == 2


def test_a_killed_worker_loses_nothing(client, tmp_path):
    def dies_once(case):
        marker = tmp_path / f"died{case['x']}"
        if case["x"] == 2 and not marker.exists():
            marker.write_text("")
            os._exit(1)
        return case["x"]

    table = heml.sweep(dies_once, [{"x": x} for x in range(6)], client, tmp_path / "rows.csv")
    assert (tmp_path / "died2").exists()
    assert table["result"].tolist() == list(range(6))
    assert (table["error"] == "").all()


def test_the_key_follows_source_case_and_enclosed_values():
    def scaled(factor):
        return lambda case: factor * case["x"]

    keys = {case_key(source_of(function), case) for function in (half, scaled(1), scaled(2)) for case in ({"x": 1}, {"x": 2})}
    assert len(keys) == 6
    assert case_key("", {"a": 1, "b": 2}) == case_key("", {"b": 2, "a": 1})


def test_bad_input(client, tmp_path):
    with pytest.raises(heml.InputError, match="twice"):
        heml.sweep(half, [{"x": 1}, {"x": 1}], client)
    with pytest.raises(heml.InputError, match="JSON"):
        heml.sweep(half, [{"x": object()}], client)
    with pytest.raises(heml.InputError, match="endings"):
        heml.sweep(half, [{"x": 1}], client, tmp_path / "rows.txt")
    (tmp_path / "other.csv").write_text("a,b\n1,2\n")
    with pytest.raises(heml.InputError, match="no table of a sweep"):
        heml.sweep(half, [{"x": 1}], client, tmp_path / "other.csv")


def test_worlds_on_workers(client):
    def height(case):
        scene = {
            "schema_version": 1,
            "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [5, 1, 1]}},
            "materials": [{"law": "neo_hookean", "young": case["young"], "poisson": 0.4}],
            "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": True}],
            "gravity": [0, -9.81, 0],
            "solver": {"integrator": "static"},
        }
        positions, report = heml.solve(heml.Scene(scene), threads=1)
        return {"lowest": positions[:, 1].min(), "iterations": report["iterations"]}

    cases = [{"young": young} for young in (1e4, 2e4, -1)]
    table = heml.sweep(height, cases, client)
    assert table["lowest"][0] < table["lowest"][1] < 0
    assert table["lowest"][0] == height(cases[0])["lowest"]
    assert table["error"][2].startswith("InputError")


def test_missing_packages_name_the_extra():
    code = "import sys; sys.modules['pandas'] = None; import heml; heml.sweep(len, [])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pip install 'heml[sweep]'" in done.stderr


def test_progress_and_a_cluster_of_its_own(tmp_path):
    script = Path(__file__).parents[3] / "app/python/examples/sweep.py"
    done = subprocess.run(
        [sys.executable, script, "--quick", "--out", tmp_path / "rows.csv"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert "sweep: 4/4, 0 failed" in done.stderr
    assert len(pandas.read_csv(tmp_path / "rows.csv")) == 4
