"""The image of a knee that was never scanned: the parametric one in voxels.

The modules of meshes/ have to be on the path.
"""

import nrrd
import numpy as np

import knee_parametric
from meniscus_wedge import polar


def synthetic_labels(mirrored: bool = False
                     ) -> tuple[np.ndarray, np.ndarray]:
    """The parametric knee in voxels, apart by 0.3 mm, and their affine map.

    The axes of the voxels are turned, by a little also against x, y and z.
    """
    body, _ = knee_parametric.anatomy()
    turn = np.radians(4.0)
    direction = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], dtype=float) \
        @ np.array([[np.cos(turn), 0, -np.sin(turn)], [0, 1, 0],
                    [np.sin(turn), 0, np.cos(turn)]])
    affine = np.eye(4)
    affine[:3, :3] = direction * [0.4, 0.4, 0.7]
    shape = (200, 142, 116)
    affine[:3, 3] = [0, -2, 17] \
        - affine[:3, :3] @ (0.5 * (np.array(shape) - 1))
    index = np.moveaxis(np.indices(shape), 0, -1).reshape(-1, 3)
    x, y, z = (index @ affine[:3, :3].T + affine[:3, 3]).T
    labels = np.zeros(len(x), dtype=np.uint8)

    gap = 0.3
    u, v, h = body.femur.chart.coordinates(np.column_stack([x, y, z - gap]))
    outline = body.femoral_outline
    notch = np.interp(u, *outline.notch.T, left=np.inf, right=np.inf)
    arms = (np.abs(u) > knee_parametric.NOTCH) | (v > notch)
    labels[(h < body.femur.contact(u, v)) & (h > body.femur.bone(u, v))
           & (v > outline.ends[0]) & (v < outline.front) & arms
           & (np.abs(u) < knee_parametric.OUTER)] = 1
    for side, tibia, meniscus in (("medial", 2, 10), ("lateral", 3, 9)):
        layer = body.tibia[side]
        x0, y0, width, length, *_ = knee_parametric.PLATEAUS[side]
        top = layer.contact(x, y)
        labels[(((x - x0) / width)**2 + ((y - y0) / length)**2 < 1)
               & (z < top) & (z > layer.bone(x, y))] = tibia
        wedge = body.menisci[side]
        angle, radius = polar(wedge.center, wedge.angles, x, y)
        order = np.argsort(wedge.angles)
        angles = wedge.angles[order]
        inside = (radius < 30) & (np.abs(z) < 15) \
            & (angle > angles[0]) & (angle < angles[-1]) \
            & (radius < np.interp(angle, angles, wedge.outer[order])) \
            & (radius > np.interp(angle, angles, wedge.inner[order]))
        inside &= z > top
        inside[inside] = z[inside] < gap + knee_parametric.femoral_height(
            x[inside], y[inside])
        labels[inside] = meniscus
    if mirrored:
        affine[0] *= -1
    return labels.reshape(shape), affine


def write_nrrd(file: str, labels: np.ndarray, affine: np.ndarray) -> str:
    """In left-posterior-superior axes, as scanners' images are."""
    flip = np.diag([-1.0, -1.0, 1.0])
    nrrd.write(file, labels, {
        "space": "left-posterior-superior",
        "space directions": (flip @ affine[:3, :3]).T,
        "space origin": flip @ affine[:3, 3]})
    return file
