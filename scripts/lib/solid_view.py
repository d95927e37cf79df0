"""Pictures of solids from a direction, to scale and without a screen."""

from __future__ import annotations

import dataclasses
import os

import numpy as np

# Draw without a screen, and without VTK's complaint that there is none.
if not os.environ.get("DISPLAY"):
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
import pyvista as pv  # noqa: E402

from synovia_output import OutputError  # noqa: E402

MARGIN = 0.01   # around what is drawn, of its width

Extent = tuple[float, float, float, float]   # left, right, bottom, top


@dataclasses.dataclass(frozen=True)
class View:
    """From where it is seen, and what is up then."""

    towards: tuple[float, float, float]
    up: tuple[float, float, float]

    def axes(self) -> np.ndarray:
        """Unit vectors to the right, up, and towards who sees it."""
        towards = np.array(self.towards) / np.linalg.norm(self.towards)
        right = np.cross(self.up, towards)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(towards, right), towards])

    def extent(self, solids: list[pv.DataSet]) -> Extent:
        """What the picture must cover to show all of the solids."""
        points = np.vstack([solid.points for solid in solids])
        flat = points @ self.axes()[:2].T
        (left, bottom), (right, top) = flat.min(axis=0), flat.max(axis=0)
        margin = MARGIN * (right - left)
        return left - margin, right + margin, bottom - margin, top + margin


@dataclasses.dataclass(frozen=True)
class Picture:
    """Pixels, and which lengths to the right and up they show."""

    pixels: np.ndarray
    extent: Extent


def draw(solids: list[tuple[pv.DataSet, dict]], view: View, width: int,
         extent: Extent | None = None) -> Picture:
    """Solids, each with arguments of pyvista's add_mesh; width in pixels.

    The light comes from where it is seen, so that a face turned there has the
    very color it was given.
    """
    extent = extent or view.extent([solid for solid, _ in solids])
    left, right, bottom, top = extent
    height = round(width * (top - bottom) / (right - left))
    plotter = pv.Plotter(off_screen=True, window_size=(width, height),
                         lighting="none")
    plotter.add_light(pv.Light(light_type="headlight"))
    plotter.background_color = "white"
    for solid, look in solids:
        plotter.add_mesh(solid, show_scalar_bar=False, **look)
    axes = view.axes()
    middle = (0.5 * (left + right) * axes[0] + 0.5 * (bottom + top) * axes[1]
              + np.mean([solid.center for solid, _ in solids], axis=0)
              @ axes[2] * axes[2])
    plotter.enable_parallel_projection()
    plotter.enable_anti_aliasing("ssaa")
    plotter.camera.focal_point = middle
    plotter.camera.position = middle + (right - left) * axes[2]
    plotter.camera.up = axes[1]
    plotter.camera.parallel_scale = 0.5 * (top - bottom)
    plotter.reset_camera_clipping_range()
    pixels = plotter.screenshot(return_img=True)
    plotter.close()
    require_drawn(pixels)
    return Picture(pixels, extent)


def require_drawn(pixels: np.ndarray) -> None:
    if not (pixels < 255).any():
        raise OutputError("VTK drew an empty picture: does scripts/setup find "
                          "that it can draw on this machine?")
