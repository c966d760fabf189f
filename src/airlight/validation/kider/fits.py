"""Two fits to measured skies: the aerosol's load, and the true pointing of each scan."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.fit.scans import Scans
from airlight.validation.kider.planets import Load

FloatArray = NDArray[np.float64]

#: Steps of the derivatives: of ln β and α [1], and of rotations [deg].
_LOAD_STEP: Final = 0.05
_TURN_STEP: Final = 0.3
#: Largest rotation in one iteration. [deg]
_LARGEST_TURN: Final = 1.5


def fit_load(
    model: Callable[[Load], FloatArray],
    measured: FloatArray,
    start: Load,
    there: FloatArray,
    iterations: int = 2,
) -> tuple[Load, FloatArray]:
    """Ångström's coefficients that minimise a model's mean square error.

    Gauss-Newton steps in (ln β, α); the derivatives hardly change and are kept from the start.

    Parameters
    ----------
    model : callable
        Function that gives the radiance for a load, shape (...).
    measured : array, shape (...)
        Measured radiance, in the same unit.
    start : Load
    there : array, shape (...)
        Radiance of the model at the start.
    iterations : int
        Number of iterations; each costs one call of the model, the derivatives cost two in all.

    Returns
    -------
    Load, array of shape (...)
        Best load found, and the model's radiance for it.
    """

    def at(x: FloatArray) -> FloatArray:
        return model(Load(beta=float(np.exp(x[0])), alpha=float(x[1])))

    x = np.array([np.log(start.beta), start.alpha])
    got = there
    slopes = np.stack([(at(x + d) - got).ravel() for d in _LOAD_STEP * np.eye(2)], axis=-1)
    slopes /= _LOAD_STEP
    best = (float(np.square(got - measured).sum()), x, got)
    for _ in range(iterations):
        x = x + np.linalg.lstsq(slopes, (measured - got).ravel(), rcond=None)[0]
        got = at(x)
        error = float(np.square(got - measured).sum())
        if error < best[0]:
            best = (error, x, got)
    _, x, got = best
    return Load(beta=float(np.exp(x[0])), alpha=float(x[1])), got


def fit_pointing(
    model: Callable[[FloatArray, FloatArray], FloatArray], scans: Scans, iterations: int = 4
) -> tuple[FloatArray, FloatArray]:
    """Small rotations of the instrument, one per scan, that minimise a model's error.

    This is a diagnosis, not a score: three angles per scan are fitted to find how much of a model's
    error could be the instrument's pointing.

    Parameters
    ----------
    model : callable
        Radiance for view zenith and azimuth [deg], each of shape (ns, nd); shape (ns, nd, nl).
    scans : Scans
    iterations : int
        Number of iterations; each costs four calls of the model.

    Returns
    -------
    turns : array, shape (ns, 3)
        Rotation vectors about the horizontal towards the sun, the horizontal perpendicular to it,
        and the vertical. [deg]
    got : array, shape (ns, nd, nl)
        Radiance of the model in the rotated directions.
    """
    turns = np.zeros((len(scans.time), 3))
    got = model(*_turned(scans, turns))
    best = (np.square(got - scans.radiance).sum(axis=(1, 2)), turns, got)
    for _ in range(iterations):
        moved = [model(*_turned(scans, turns + d)) for d in _TURN_STEP * np.eye(3)]
        slopes = np.stack([(m - got) / _TURN_STEP for m in moved], axis=-1)
        step = np.empty_like(turns)
        for scan in range(len(turns)):
            rest = (scans.radiance[scan] - got[scan]).ravel()
            step[scan] = np.linalg.lstsq(slopes[scan].reshape(-1, 3), rest, rcond=None)[0]
        turns = turns + np.clip(step, -_LARGEST_TURN, _LARGEST_TURN)
        got = model(*_turned(scans, turns))
        error = np.square(got - scans.radiance).sum(axis=(1, 2))
        nearer = error < best[0]
        best = (
            np.where(nearer, error, best[0]),
            np.where(nearer[:, None], turns, best[1]),
            np.where(nearer[:, None, None], got, best[2]),
        )
    return best[1], best[2]


def _turned(scans: Scans, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """View zenith and azimuth after small rotations, each (ns, nd). [deg]"""
    zenith, azimuth = np.radians(scans.view_zenith), np.radians(scans.azimuth)
    view = np.stack(
        [np.sin(zenith) * np.cos(azimuth), np.sin(zenith) * np.sin(azimuth), np.cos(zenith)], -1
    )
    vector = np.radians(turns)[:, None, :]
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    axis = np.divide(vector, angle, out=np.zeros_like(vector), where=angle > 0.0)
    along = (view * axis).sum(axis=-1, keepdims=True)
    # Rodrigues' rotation formula.
    turned = (
        np.cos(angle) * view
        + np.sin(angle) * np.cross(np.broadcast_to(axis, view.shape), view)
        + (1.0 - np.cos(angle)) * along * axis
    )
    return (
        np.degrees(np.arccos(np.clip(turned[..., 2], -1.0, 1.0))),
        np.degrees(np.arctan2(turned[..., 1], turned[..., 0])),
    )
