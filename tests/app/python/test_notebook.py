"""World.show() in a notebook that a kernel runs, as Jupyter does."""

import base64

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

made = """
import heml
world = heml.World(heml.Scene({
    "schema_version": 1,
    "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [5, 1, 1]}},
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.4, "density": 1000}],
}))
"""


def outputs_of(*cells):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in (made, *cells)])
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    return [output for cell in notebook.cells for output in cell.outputs if output.output_type != "stream"]


def test_a_cell_that_ends_with_show_has_a_picture():
    (output,) = outputs_of("world.show(size=(160, 120))")
    assert base64.b64decode(output.data["image/png"]).startswith(b"\x89PNG")


def test_an_interactive_view_is_a_widget():
    for library in ("pyvista", "trame", "trame_vtk", "ipywidgets"):
        pytest.importorskip(library)
    outputs = outputs_of("world.show(interactive=True, field='von_mises')")
    assert any({"text/html", "application/vnd.jupyter.widget-view+json"} & set(output.data) for output in outputs)
