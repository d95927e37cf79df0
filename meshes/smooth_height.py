"""The smooth surface h(u, v) that comes closest to scattered heights.

It minimizes the mean squared distance to the samples plus a penalty on second
derivatives, which acts as a low-pass filter 1/(1 + (c/wavelength)^4): waves
shorter than the cutoff c vanish, and the surface goes on with little curvature
where there are no samples. Bicubic between the points of a grid, so that its
normals are continuous, and their derivatives too.
"""

from __future__ import annotations

import numpy as np
from scipy import interpolate, sparse
from scipy.sparse.linalg import splu


def _second_difference(n: int) -> sparse.spmatrix:
    return sparse.diags([np.ones(n - 2), -2 * np.ones(n - 2), np.ones(n - 2)],
                        [0, 1, 2], shape=(n - 2, n))


def _first_difference(n: int) -> sparse.spmatrix:
    return sparse.diags([-np.ones(n - 1), np.ones(n - 1)], [0, 1],
                        shape=(n - 1, n))


class SmoothHeight:
    """u, v and h in mm; the box is (u min, u max, v min, v max)."""

    def __init__(self, u: np.ndarray, v: np.ndarray, h: np.ndarray,
                 cutoff: float, box: tuple[float, float, float, float],
                 spacing: float = 0.75):
        nu = max(8, int(np.ceil((box[1] - box[0]) / spacing)) + 1)
        nv = max(8, int(np.ceil((box[3] - box[2]) / spacing)) + 1)
        self.u = np.linspace(box[0], box[1], nu)
        self.v = np.linspace(box[2], box[3], nv)
        du, dv = self.u[1] - self.u[0], self.v[1] - self.v[0]
        sample = self._bilinear(u, v, du, dv)
        # Each grid point speaks for du dv of the surface, each sample for the
        # same share of the area where there are samples.
        count = np.asarray(sample.sum(axis=0)).ravel()
        typical = np.median(count[count > 0.5])
        one_u, one_v = sparse.identity(nu), sparse.identity(nv)
        bending = [sparse.kron(_second_difference(nu), one_v) / du**2,
                   sparse.kron(one_u, _second_difference(nv)) / dv**2,
                   sparse.kron(_first_difference(nu), _first_difference(nv))
                   * (np.sqrt(2) / (du * dv))]
        stiffness = sum(term.T @ term for term in bending)
        system = sample.T @ sample / typical \
            + (cutoff / (2 * np.pi))**4 * stiffness
        grid = splu(system.tocsc()).solve(sample.T @ h / typical)
        self._spline = interpolate.RectBivariateSpline(
            self.u, self.v, grid.reshape(nu, nv), s=0)
        self.residual = float(np.sqrt(np.mean((self(u, v) - h)**2)))

    def _bilinear(self, u: np.ndarray, v: np.ndarray, du: float, dv: float
                  ) -> sparse.csr_matrix:
        nu, nv = len(self.u), len(self.v)
        s = np.clip((u - self.u[0]) / du, 0, nu - 1 - 1e-9)
        t = np.clip((v - self.v[0]) / dv, 0, nv - 1 - 1e-9)
        i, j = s.astype(int), t.astype(int)
        s, t = s - i, t - j
        rows = np.arange(len(u))
        parts = [(rows, (i + a) * nv + j + b,
                  (s if a else 1 - s) * (t if b else 1 - t))
                 for a in (0, 1) for b in (0, 1)]
        row, column, weight = (np.concatenate(x) for x in zip(*parts))
        return sparse.csr_matrix((weight, (row, column)),
                                 shape=(len(u), nu * nv))

    def __call__(self, u: np.ndarray, v: np.ndarray, du: int = 0, dv: int = 0
                 ) -> np.ndarray:
        """The height, or a derivative of it, constant beyond the box."""
        u = np.clip(u, self.u[0], self.u[-1])
        v = np.clip(v, self.v[0], self.v[-1])
        return self._spline.ev(u, v, dx=du, dy=dv)
