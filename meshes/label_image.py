"""Labeled images: tissue numbers in voxels, and where those are in space.

Coordinates are millimeters, x to the right, y to the front (anterior), z up
(superior): NIfTI's axes. NRRD images name theirs.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from scipy import ndimage


class ImageError(ValueError):
    """An image that can't be used, and why, in one line."""


@dataclass
class LabelImage:
    """Labels by voxel; the affine map takes voxel numbers to mm."""

    labels: np.ndarray   # three-dimensional, whole numbers
    affine: np.ndarray   # 4 x 4

    def voxel(self) -> np.ndarray:
        """Lengths of a voxel's edges (mm)."""
        return np.linalg.norm(self.affine[:3, :3], axis=0)


def _read_nrrd(path: str) -> LabelImage:
    import nrrd

    data, header = nrrd.read(path)
    if data.ndim != 3:
        raise ImageError(f"'{path}' has {data.ndim} dimensions, not 3")
    directions = header.get("space directions")
    if directions is None and "spacings" in header:
        directions = np.diag(header["spacings"])
    if directions is None:
        raise ImageError(f"'{path}' does not say how large its voxels are "
                         "(space directions, or spacings)")
    space = header.get("space", "right-anterior-superior")
    words = {"left": (0, -1), "right": (0, 1), "posterior": (1, -1),
             "anterior": (1, 1), "inferior": (2, -1), "superior": (2, 1)}
    short = {"LPS": "left-posterior-superior", "RAS": "right-anterior-superior",
             "LAS": "left-anterior-superior"}
    turn = np.zeros((3, 3))
    parts = short.get(space, space).split("-")
    if len(parts) != 3 or not all(part in words for part in parts):
        raise ImageError(f"'{path}': space '{space}' is none of right-anterior-"
                         "superior, left-posterior-superior and the like")
    for column, part in enumerate(parts):
        row, sign = words[part]
        turn[row, column] = sign
    affine = np.eye(4)
    affine[:3, :3] = turn @ np.asarray(directions, dtype=float).T
    affine[:3, 3] = turn @ np.asarray(header.get("space origin", (0, 0, 0)),
                                      dtype=float)
    return LabelImage(data, affine)


def _read_nifti(path: str) -> LabelImage:
    import nibabel

    image = nibabel.load(path)
    data = np.asanyarray(image.dataobj)
    if data.ndim == 4 and data.shape[3] == 1:
        data = data[..., 0]
    if data.ndim != 3:
        raise ImageError(f"'{path}' has {data.ndim} dimensions, not 3")
    return LabelImage(data, np.asarray(image.affine, dtype=float))


READERS = {".nrrd": _read_nrrd, ".nii": _read_nifti, ".nii.gz": _read_nifti}


def read(path: str) -> LabelImage:
    """Reads NRRD (.nrrd) and NIfTI (.nii, .nii.gz).

    Raises ImageError, whatever is wrong with the file.
    """
    if not os.path.isfile(path):
        raise ImageError(f"there is no file '{path}'")
    reader = next((read for ending, read in READERS.items()
                   if path.lower().endswith(ending)), None)
    if reader is None:
        raise ImageError(f"'{path}' ends in none of {', '.join(READERS)}")
    try:
        image = reader(path)
    except ImageError:
        raise
    except Exception as error:   # the readers raise all kinds
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ImageError(f"cannot read '{path}': {reason}") from error
    if not np.isfinite(image.affine).all() or \
            abs(np.linalg.det(image.affine)) < 1e-9:
        raise ImageError(f"'{path}': the voxels have no volume")
    if image.labels.dtype.kind not in "iu":
        whole = np.rint(image.labels)
        if not np.array_equal(whole, image.labels):
            raise ImageError(f"'{path}' holds numbers that are not whole: it "
                             "is no labeled image")
        image.labels = whole.astype(np.int32)
    return image


class Tissue:
    """The largest connected part of a label, as a field that is 1 inside."""

    def __init__(self, image: LabelImage, label: int, name: str):
        chosen = image.labels == label
        if not chosen.any():
            there = ", ".join(map(str, np.unique(image.labels)))
            raise ImageError(f"no voxel has the label {label} ({name}); there "
                             f"are {there}")
        lowest = np.argwhere(chosen).min(axis=0)
        box = tuple(slice(a, b + 1) for a, b in
                    zip(lowest, np.argwhere(chosen).max(axis=0)))
        parts, count = ndimage.label(chosen[box])
        sizes = np.bincount(parts.ravel())[1:]
        kept = parts == 1 + int(np.argmax(sizes))
        self.name = name
        self.voxels = int(kept.sum())
        self.dropped = int(sizes.sum()) - self.voxels
        self.volume = self.voxels * abs(np.linalg.det(image.affine[:3, :3]))
        self._field = np.pad(kept.astype(np.float32), 1)
        self._affine = image.affine
        self._corner = lowest - 1
        self.points = (np.argwhere(kept) + lowest) @ image.affine[:3, :3].T \
            + image.affine[:3, 3]

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Trilinear, 0.5 on the surface; points (mm) are ... x 3."""
        flat = points.reshape(-1, 3) - self._affine[:3, 3]
        index = np.linalg.solve(self._affine[:3, :3], flat.T) \
            - self._corner[:, None]
        value = ndimage.map_coordinates(self._field, index, order=1)
        return value.reshape(points.shape[:-1])


def crossings(value: np.ndarray, steps: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray]:
    """Where rays enter and leave for the first and the last time.

    value is 1 inside, n x len(steps); NaN for rays that stay outside.
    """
    inside = value > 0.5
    hit = inside.any(axis=1)
    first = np.argmax(inside, axis=1)
    last = len(steps) - 1 - np.argmax(inside[:, ::-1], axis=1)
    rows = np.arange(len(value))

    def between(outer: np.ndarray, inner: np.ndarray) -> np.ndarray:
        outer = np.clip(outer, 0, len(steps) - 1)
        a, b = value[rows, outer], value[rows, inner]
        share = np.where(b > a, (0.5 - a) / np.where(b > a, b - a, 1), 1)
        place = steps[outer] + share * (steps[inner] - steps[outer])
        return np.where(hit, place, np.nan)

    return between(first - 1, first), between(last + 1, last)
