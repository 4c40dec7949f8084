"""Interactive real-time simulation of hyperelastic soft tissue.

    import heml

    world = heml.World("cantilever.json")
    world.step(100)
    print(world.time, world.positions()[:, 1].min())

SI units; arrays are float64 and in the mesh file's node order. `heml.World` is a body in motion, `heml.Batch` many,
`heml.solve` runs a scene to its end, `heml.probe` evaluates a law. All of it is described in docs/python.md.
"""
import importlib as _importlib

from heml._core import Batch, InputError, NotConverged, Scene, Snapshot, Unstable, World, __version__, probe, render, solve

for _name in ("Batch", "Scene", "Snapshot", "World", "probe", "solve"):
    try:
        globals()[_name].__module__ = "heml"
    except AttributeError:
        pass  # of functions it cannot be set

# What needs numpy or other packages is imported when it is asked for. A function has another name than its module:
# importing a module heml.sweep would take the place of the function heml.sweep.
_FUNCTIONS = {"FitResult": "_fit", "fit": "_fit", "sweep": "_sweep"}
_MODULES = ("gym", "show", "interchange")

__all__ = ["Batch", "FitResult", "InputError", "NotConverged", "Scene", "Snapshot", "Unstable", "World", "__version__", "fit",
           "probe", "render", "solve", "sweep"]


def __getattr__(name):
    if name in _FUNCTIONS:
        globals()[name] = getattr(_importlib.import_module(f"heml.{_FUNCTIONS[name]}"), name)
        return globals()[name]
    if name in _MODULES:
        try:
            return _importlib.import_module(f"heml.{name}")
        except ImportError as missing:  # of an optional package: hasattr() and help() go on
            raise AttributeError(str(missing)) from missing
    raise AttributeError(f"module 'heml' has no attribute '{name}'")


def _method(module, name, text):
    def call(self, *args, **kwargs):
        return getattr(_importlib.import_module(f"heml.{module}"), name)(self, *args, **kwargs)

    call.__name__, call.__doc__ = name, f"{text} See heml.{module}.{name}."
    return call


for _class in (World, Scene):
    _class.show = _method("show", "show", "A picture for notebooks, or with interactive=True a view to turn.")
    _class.to_meshio = _method("interchange", "to_meshio", "The body as a meshio.Mesh, with fields.")
    _class.to_pyvista = _method("interchange", "to_pyvista", "The body as a pyvista.UnstructuredGrid, with fields.")


def __dir__():
    return sorted(__all__)
