import json

import numpy as np
import pytest

import heml


def test_a_static_solve_gives_what_the_command_line_does(box, program, tmp_path):
    scene = box(solver={"integrator": "static", "tolerance": 1e-10}, outputs={"times": [0.5]})
    (tmp_path / "s.json").write_text(json.dumps(scene))
    assert program("solve", tmp_path / "s.json", "--out", tmp_path / "out").returncode == 0
    positions, report = heml.solve(tmp_path / "s.json")
    written = np.loadtxt(tmp_path / "out/positions.csv", delimiter=",", skiprows=1)[:, 1:]
    assert (positions == written).all()
    expected = json.loads((tmp_path / "out/report.json").read_text())
    for each in (report, expected):
        del each["wall_seconds"]
    assert report == expected


def test_times_of_outputs_shorten_steps_as_on_the_command_line(box, program, tmp_path):
    scene = box(solver={"duration": 0.02}, outputs={"times": [0.00543]})
    (tmp_path / "s.json").write_text(json.dumps(scene))
    assert program("solve", tmp_path / "s.json", "--out", tmp_path / "out").returncode == 0
    _, report = heml.solve(scene, threads=1)
    assert report["state_hash"] == json.loads((tmp_path / "out/report.json").read_text())["state_hash"]


def test_no_equilibrium_raises_with_what_was_reached(box):
    scene = box(solver={"integrator": "static"}, materials=[{"law": "stvk", "young": 1e4, "poisson": 0.3}],
                gravity=[-1e6, 0, 0])
    with pytest.raises(heml.NotConverged) as error:
        heml.solve(scene)
    assert error.value.positions.shape == (45, 3)
    assert error.value.report["converged"] is False and error.value.report["load"] < 1


def test_an_unstable_step_raises(box):
    with pytest.raises(heml.Unstable) as error:
        heml.solve(box(solver={"step": 0.02}))
    assert error.value.report["halt"]["message"] == str(error.value)


def test_probe_gives_the_formula_and_its_derivative():
    rng = np.random.default_rng(1)
    F = np.eye(3) + 0.2 * rng.standard_normal((20, 3, 3))
    dF = rng.standard_normal((20, 3, 3))
    lam, mu = 3e3, 2e3
    material = {"law": "stvk", "lambda": lam, "mu": mu}
    got = heml.probe(material, F, dF)
    E = (F.transpose(0, 2, 1) @ F - np.eye(3)) / 2
    trace = np.trace(E, axis1=1, axis2=2)
    assert got["W"] == pytest.approx(lam / 2 * trace**2 + mu * np.einsum("nij,nji->n", E, E), rel=1e-12)
    S = lam * trace[:, None, None] * np.eye(3) + 2 * mu * E
    assert np.allclose(got["P"], F @ S, rtol=1e-11)
    h = 1e-6
    difference = (heml.probe(material, F + h * dF)["P"] - heml.probe(material, F - h * dF)["P"]) / (2 * h)
    assert np.allclose(got["dP"], difference, rtol=1e-5, atol=1e-2)
    assert "dP" not in heml.probe(material, F)


@pytest.mark.parametrize(
    "term", [{"active_stress": 5e4, "fibre": [1, 0, 0]}, {"viscosity": 3}, {"plasticity": {"yield": 1}}]
)
def test_probe_tells_that_terms_beside_the_law_are_left_out(term):
    law = {"law": "neo_hookean_iso", "K1": 2e3, "kappa": 1e4}
    F = [np.diag([1.2, 0.9, 1]).tolist()]
    with pytest.warns(UserWarning, match="the law alone is evaluated, without active stress"):
        got = heml.probe(law | term, F)
    assert np.array_equal(got["P"], heml.probe(law, F)["P"])


def test_probe_gives_nan_outside_the_range():
    got = heml.probe({"law": "neo_hookean", "young": 1e4, "poisson": 0.3}, [np.diag([-1.0, 1, 1]).tolist(), np.eye(3).tolist()])
    assert np.isnan(got["W"][0]) and np.isnan(got["P"][0]).all()
    assert got["W"][1] == 0 and (got["P"][1] == 0).all()


@pytest.mark.parametrize("material, F, words", [
    ({"law": "stvk", "young": 1e4, "poisson": 0.3}, np.eye(3), "(n, 3, 3)"),
    ({"law": "stvk", "young": 1e4, "poisson": 0.3}, np.ones((2, 3, 3), np.float32), "float64"),
    ({"law": "stvk", "young": 1e4, "poisson": 0.3}, np.full((2, 3, 3), np.nan), "F[0]"),
    ({"law": "stvk", "young": 1e4, "poisson": 0.3}, np.ones((3, 3, 4)).transpose(2, 1, 0), "contiguous"),
    ({"law": "stvk", "yung": 1e4, "poisson": 0.3}, np.ones((1, 3, 3)), "young"),
    ({"law": "mass_spring", "stiffness": 10}, np.ones((1, 3, 3)), "mass_spring"),
])
def test_probe_refuses(material, F, words):
    with pytest.raises(heml.InputError) as error:
        heml.probe(material, F)
    assert words in str(error.value)
