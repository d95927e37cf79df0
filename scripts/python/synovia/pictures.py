"""Static pictures of fields, in notebooks and files."""

from __future__ import annotations

import dataclasses
import io
import os
import pathlib
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from synovia.errors import suggestion
from synovia.output import OutputError

if TYPE_CHECKING:
    import pyvista

SIZE = (900, 650)   # pixels


@dataclasses.dataclass(frozen=True)
class Picture:
    """Pixels, shape (height, width, 3); notebooks show them."""

    pixels: np.ndarray

    def _repr_png_(self) -> bytes:
        from matplotlib.image import imsave
        stream = io.BytesIO()
        imsave(stream, self.pixels, format="png")
        return stream.getvalue()

    def save(self, file: str | os.PathLike[str]) -> None:
        """As PNG."""
        pathlib.Path(file).write_bytes(self._repr_png_())


def draw(grid: pyvista.UnstructuredGrid, field: str,
         look: dict[str, Any]) -> Picture:
    """The surface of a mesh in the colors of one of its fields."""
    # Without a screen, and without VTK's complaint that there is none.
    if not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW",
                              "vtkEGLRenderWindow")
    import pyvista
    if field not in grid.array_names:
        raise OutputError(f"there is no field '{field}'"
                          + suggestion(field, grid.array_names))
    component = look.pop("component", None)
    values = np.asarray(grid[field])
    title = field
    if values.ndim > 1:
        title += "" if component is None else f" [{component}]"
        values = (np.linalg.norm(values, axis=1) if component is None
                  else values[:, component])
    grid = grid.copy(deep=False)
    grid[title] = values
    plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE))
    # The types of pyvista's decorators take the first argument for the plotter.
    plotter.set_background("white")  # type: ignore[arg-type]
    bar = {"color": "black", "vertical": True, "title": "",
           "position_x": 0.8}
    shown: dict[str, Any] = {"cmap": "viridis", "ambient": 0.45,
                             "diffuse": 0.6, "scalar_bar_args": bar, **look}
    # Edges of the parts into which curved faces are split are nobody's.
    with warnings.catch_warnings():
        # Newer versions ask for an argument that older ones don't know.
        warnings.filterwarnings("ignore", message=".*value of `algorithm`")
        surface = grid.extract_surface(
            nonlinear_subdivision=0 if shown.get("show_edges") else 2)
    plotter.add_mesh(surface, scalars=title, **shown)
    plotter.add_text(title, position="upper_right", font_size=12,
                     color="black")
    plotter.view_vector((-1.0, -1.4, 0.7),  # type: ignore[arg-type]
                        viewup=(0, 0, 1))
    plotter.enable_anti_aliasing("ssaa")
    pixels = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return Picture(without_margins(pixels))


def without_margins(pixels: np.ndarray) -> np.ndarray:
    """Rows and columns from the first to the last that are not white."""
    drawn = (pixels < 255).any(axis=2)
    if not drawn.any():
        raise OutputError("VTK drew an empty picture: can it draw on this "
                          "machine?")
    rows, columns = np.nonzero(drawn)
    return pixels[rows.min():rows.max() + 1, columns.min():columns.max() + 1]
