"""Tibial cartilage from a labeled image: a layer and its outline."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from cartilage_layer import Layer, Vertical
from label_image import ImageError, Tissue
from label_surfaces import largest, sample


def tibial_layer(tissue: Tissue, cutoff: float, thinnest: float
                 ) -> tuple[Layer, np.ndarray]:
    """The layer, and its outline, counter-clockwise."""
    samples = sample(tissue, Vertical())
    thick = samples.thickness() > thinnest
    bone, contact = samples.fit(thick, cutoff)
    return (Layer(Vertical(), bone, contact, thinnest),
            star_outline(samples.u, samples.v, thick, tissue.name))


def star_outline(u: np.ndarray, v: np.ndarray, mask: np.ndarray, name: str,
                 harmonics: int = 9) -> np.ndarray:
    """The smoothed outline of a mask that its center sees all of, 360 points.

    Smoothed by leaving off the higher harmonics of the radius over the angle,
    after the mask was scaled to be as long as it is wide.
    """
    whole = largest(ndimage.binary_fill_holes(
        ndimage.binary_opening(mask, iterations=2)))
    i, j = np.nonzero(whole)
    if len(i) < 50:
        raise ImageError(f"{name} is too small or too thin to be meshed")
    points = np.column_stack([u[i], v[j]])
    low, high = points.min(axis=0), points.max(axis=0)
    center, half = 0.5 * (low + high), 0.5 * (high - low)
    angle = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    ray = np.column_stack([np.cos(angle), np.sin(angle)])
    t = np.arange(0, 1.6, 0.01)
    places = center + half * ray[:, None] * t[None, :, None]
    value = ndimage.map_coordinates(
        whole.astype(float), [(places[..., 0] - u[0]) / (u[1] - u[0]),
                              (places[..., 1] - v[0]) / (v[1] - v[0])],
        order=1)
    radius = t[len(t) - 1 - np.argmax(value[:, ::-1] > 0.5, axis=1)]
    wave = np.fft.rfft(radius)
    wave[harmonics + 1:] = 0
    radius = np.fft.irfft(wave, len(radius))
    return center + half * ray * radius[:, None]
