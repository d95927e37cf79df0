"""The compression of a knee as an animation."""

from __future__ import annotations

import io
import pathlib

import numpy as np
from PIL import Image

import knee_run
import knee_views
import section
import solid_view
from figure_style import plt
from knee_run import Knee
from solid_view import Extent, Picture

WIDTH = 1000            # of the view, pixels
INCHES, DPI = 8.0, 110   # the width of a frame
BESIDE, REST = 0.65, 1.35   # labels beside and above and below, inches
BELOW, ABOVE = 0.5, 2.0     # what is shown around the joint's space, mm
SECONDS = 0.3           # of a frame
PAUSE = 5               # frames that the last one lasts
TITLE = "Frontal section, seen from behind"
MAP = 112               # of a palette of 256, for the colors of the pressure
BEHIND = {"ambient": 0.35, "diffuse": 0.65, "specular": 0.0}
EDGE = {"color": "black", "line_width": 2, "lighting": False}
# Nearer than what is behind the cut, which would hide parts of it, mm
CUT, EDGES = -0.05, -0.1


def write(knee: Knee, file: pathlib.Path) -> None:
    """One frame for each saved time.

    The pressure in the frontal plane through the middle of the menisci, and
    the bodies before it in the colors of their tissues.
    """
    at = knee_views.middle_y(knee.bodies)
    halves, cuts = [], []
    for time in knee.times:
        bodies = knee.bodies_at(time)
        halves.append({
            name: knee_run.deformed(half.extract_surface(
                nonlinear_subdivision=1))
            for name, half in knee_views.front_half(bodies).items()})
        cuts.append(section.cut(list(bodies.values()), normal=1, at=at))
    every = [part for parts in cuts for part in parts]
    values = [part["fluid_pressure"] for part in every]
    colors = knee_run.load_colors(every, values, 1)
    extent = extent_of(halves, every)
    frames = [draw_frame(half, parts, colors, extent)
              for half, parts in zip(halves, cuts)]
    save(knee.times, frames, colors, section.extent(values, colors), file)


def extent_of(halves: list[knee_views.Bodies], cuts: list) -> Extent:
    """All of the joint's width, and the height of what is cut or a meniscus."""
    solids = [solid for half in halves for solid in half.values()]
    menisci = [solid for half in halves for solid in knee_views.menisci(half)]
    left, right, bottom, top = knee_views.POSTERIOR.extent(solids)
    highest = max(solid.bounds[5] for solid in [*menisci, *cuts])
    return left, right, bottom - BELOW, min(top, highest + ABOVE)


def draw_frame(half: knee_views.Bodies, parts: list, colors: dict,
               extent: Extent) -> Picture:
    face = {"scalars": "fluid_pressure", "lighting": False,
            "cmap": colors["cmap"],
            "clim": (colors["vmin"], colors["vmax"])}
    solids = [(body, BEHIND | {"color": knee_views.color_of(name)})
              for name, body in half.items()]
    for part in parts:
        edges = part.extract_feature_edges(
            boundary_edges=True, feature_edges=False, manifold_edges=False,
            non_manifold_edges=False)
        for solid, look, nearer in ((part, face, CUT), (edges, EDGE, EDGES)):
            solids.append((knee_run.deformed(solid).translate((0, nearer, 0)),
                           look))
    return solid_view.draw(solids, knee_views.POSTERIOR, WIDTH, extent)


def save(times: list[float], frames: list[Picture], colors: dict,
         extend: str, file: pathlib.Path) -> None:
    height, width = frames[0].pixels.shape[:2]
    figure, axes = plt.subplots(dpi=DPI, figsize=(
        INCHES, REST + (INCHES - BESIDE) * height / width))
    shown = axes.imshow(frames[0].pixels, extent=frames[0].extent)
    axes.set(xlabel="$x$ (mm)", ylabel="$z$ (mm)")
    title = axes.set_title(TITLE)
    figure.colorbar(
        plt.cm.ScalarMappable(
            plt.Normalize(colors["vmin"], colors["vmax"]), colors["cmap"]),
        ax=axes, orientation="horizontal", aspect=50, pad=0.03,
        extend=extend, label="fluid pressure $p$ (MPa)")
    figure.draw_without_rendering()
    figure.set_layout_engine("none")    # lest the axes move with the title
    images = []
    for time, frame in zip(times, frames):
        shown.set_data(frame.pixels)
        title.set_text(f"{TITLE}, {time:g} s")
        images.append(rendered(figure))
    plt.close(figure)
    palette = palette_of([images[0], images[-1]], colors["cmap"])
    images = [image.quantize(palette=palette, dither=Image.Dither.NONE)
              for image in images]
    durations = [int(1000 * SECONDS)] * len(images)
    durations[-1] *= PAUSE
    images[0].save(file, save_all=True, append_images=images[1:], loop=0,
                   duration=durations, optimize=True)


def palette_of(images: list[Image.Image], cmap: str) -> Image.Image:
    """One for all frames, lest a color changes its meaning."""
    pressures = plt.get_cmap(cmap)(np.linspace(0, 1, MAP))[:, :3]
    others = np.reshape(Image.fromarray(np.vstack(images))
                        .quantize(256 - MAP).getpalette(), (-1, 3))
    # Paper is white: what is nearly so would be taken for it.
    others[others.min(axis=1) > 245] = 255
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.vstack(
        [np.rint(255 * pressures).astype(int), others]).ravel().tolist())
    return palette


def rendered(figure: plt.Figure) -> Image.Image:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI)
    return Image.open(buffer).convert("RGB")
