"""Pictures of worlds in notebooks."""

from __future__ import annotations

import struct
import zlib
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

import heml
from heml.interchange import to_pyvista, world_of


class Picture:
    """A picture that notebooks draw. `pixels`: (h, w, 3) uint8."""

    def __init__(self, pixels: NDArray[np.uint8]) -> None:
        self.pixels = pixels

    def _repr_png_(self) -> bytes:
        return png(self.pixels)

    def save(self, path: str) -> None:
        """Writes a PNG file."""
        with open(path, "wb") as file:
            file.write(png(self.pixels))


def show(thing: Union[heml.World, heml.Scene], size: tuple[int, int] = (640, 480), interactive: bool = False, **view: Any) -> Any:
    """Draws a world, or the body of a scene at time 0.

    Args:
        thing: World or Scene.
        size: width, height, pixels.
        interactive: a view to turn and zoom, by pyvista (extra `notebook`), coloured by the `field` of `view`.
        view: as of `heml.render`: azimuth, elevation, zoom, field, wireframe.

    Returns:
        Picture, which Jupyter draws; with `interactive` what pyvista's `plot` returns.
    """
    world = world_of(thing)
    if not interactive:
        return Picture(np.asarray(heml.render(world, size, **view)))
    grid = to_pyvista(world)
    field = view.get("field", "none")
    if field != "none" and field not in grid.array_names:
        raise heml.InputError(f"show: no field {field!r}; the fields are {', '.join(grid.array_names)}")
    return grid.plot(
        scalars=None if field == "none" else field, show_edges=view.get("wireframe", False), window_size=list(size)
    )


def png(pixels: NDArray[np.uint8]) -> bytes:
    """A PNG file of (h, w, 3) uint8."""
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), dtype=np.uint8)  # each row begins with its filter: 0, none
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b"")
