"""Fits to measured skies: aerosol load and phase function, and pointing of each scan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.planets.planet import Planet
from airlight.studies.fit.least_squares import Data, FitResult, fit
from airlight.studies.fit.parameter import FitParameter
from airlight.studies.fit.phase_lobes import LOBES
from airlight.studies.fit.scans import Scans
from airlight.studies.fit.sky_model import (
    Nuisance,
    ObservedDirections,
    SkyModel,
    smooth,
    smooth_near,
)
from airlight.validation.kider.planets import AngstromLaw, Inputs
from airlight.validation.suite import SuiteRun

FloatArray = NDArray[np.float64]

#: Step of the derivatives by rotations. [deg]
_TURN_STEP: Final = 0.3
#: Largest rotation in one iteration. [deg]
_LARGEST_TURN: Final = 1.5


@dataclass(frozen=True, eq=False)
class AerosolFit:
    """Aerosol fitted to measured scans.

    Attributes
    ----------
    inputs : Inputs
        Inputs of the planet, with the fitted aerosol.
    scale : float
        Factor of the model's radiances; 1 unless it was fitted. [1]
    fitted : FitResult
        Values, error bars and correlations.
    predicted : array, shape (ns, nd, nl)
        Radiance of the model. [W m⁻² sr⁻¹ nm⁻¹]
    """

    inputs: Inputs
    scale: float
    fitted: FitResult
    predicted: FloatArray

    @property
    def load(self) -> AngstromLaw:
        """Ångström law of the aerosol."""
        return self.inputs.load


class AerosolModel:
    """Model of scans by the aerosol's optical depth at 550 nm and its Ångström exponent.

    All radiances have the same uncertainty, estimated from the residuals, as the score is the
    absolute error.

    Parameters
    ----------
    run : SuiteRun
        With the quality of the solver.
    planet_of : callable
        Function from inputs to a planet.
    start : Inputs
        Starting values; with lobes of the phase function, these are fitted too.
    with_scale : bool
        Whether the instrument's scale is fitted too.
    """

    def __init__(
        self,
        run: SuiteRun,
        planet_of: Callable[[Inputs], Planet],
        scans: Scans,
        start: Inputs,
        *,
        with_scale: bool = False,
    ) -> None:
        self.scans, self.quality, self.start = scans, run.quality, start
        shape = scans.radiance.shape
        pairs = np.broadcast_to(scans.sun_zenith[:, None], shape[:2])
        directions = ObservedDirections(
            altitude=np.zeros(pairs.size),
            sun_zenith=pairs.ravel(),
            view_zenith=scans.view_zenith.ravel(),
            azimuth=scans.azimuth.ravel(),
            scan=np.repeat(np.arange(shape[0]), shape[1]),
        )
        every, all_scans = np.ones(scans.radiance.size, bool), np.ones(shape[0], bool)
        scale = FitParameter(name="scale", start=1.0, low=0.2, high=5.0, least_step=0.01)
        nuisances = [Nuisance(parameter=scale, kind="factor", values=every, scans=all_scans)]
        depth, exponent = "aerosol.optical_depth", "aerosol.angstrom"
        at_550, alpha = float(start.load.optical_depth(550.0)), start.load.alpha
        lobes = zip(LOBES.items(), start.lobes or (), strict=False)
        self.model = SkyModel(
            planet_of=lambda values: planet_of(self._inputs(values)),
            parameters=(
                FitParameter(name=depth, start=at_550, low=0.0, high=5.0, least_step=0.002),
                FitParameter(name=exponent, start=alpha, low=-2.0, high=4.5, least_step=0.05),
                *(
                    FitParameter(name=name, start=value, low=low, high=high, least_step=0.01)
                    for (name, (low, high)), value in lobes
                ),
            ),
            nuisances=nuisances if with_scale else [],
            directions=directions,
            wavelengths=scans.wavelengths,
            combine=lambda radiance, _: radiance.ravel(),
            quality=smooth(run.quality),
            cancel=run.cancel,
        )
        self.rough = replace(self.model, quality=smooth("preview"))

    def _inputs(self, values: FloatArray) -> Inputs:
        """Inputs with an optical depth at 550 nm, an exponent, and lobes if these are fitted."""
        load = AngstromLaw(beta=float(values[0] * 0.55 ** values[1]), alpha=float(values[1]))
        if self.start.lobes is None:
            return replace(self.start, load=load)
        first, second, weight = map(float, values[2:5])
        return replace(self.start, load=load, lobes=(first, second, weight))

    def fitted(
        self, kept: NDArray[np.bool_] | None = None, begin: AerosolFit | None = None
    ) -> AerosolFit:
        """Fit to all scans, or to some.

        Parameters
        ----------
        kept : array of bool, shape (ns,), optional
            Mask of fitted scans; default: all.
        begin : AerosolFit, optional
            Initial fit.
        """
        shape = self.scans.radiance.shape
        chosen = np.ones(shape[0], bool) if kept is None else kept
        values = np.repeat(chosen, shape[1] * shape[2])
        group = np.repeat(np.arange(int(chosen.sum())), shape[1] * shape[2])
        data = Data(
            values=self.scans.radiance.ravel()[values],
            uncertainty=np.ones(group.size),
            known=False,
            group=group,
        )
        parameters = self.model.all_parameters
        start = None if begin is None else begin.fitted.values
        if start is None:
            start = fit(_Part(self.rough, values), data, parameters).values
            near = self.model.planet_of(start[: len(self.model.parameters)])
            self.model.quality = smooth_near(self.quality, near, self.scans.wavelengths)
        found = fit(_Part(self.model, values), data, parameters, start=start)
        return AerosolFit(
            inputs=self._inputs(found.values),
            scale=float(found.values[-1]) if self.model.nuisances else 1.0,
            fitted=found,
            predicted=self.model(found.values).reshape(shape),
        )

    def left_out(
        self, whole: AerosolFit, progress: Callable[[int], None] | None = None
    ) -> FloatArray:
        """Leave-one-out radiance of each scan by the fit to the others, shape (ns, nd, nl).

        Parameters
        ----------
        whole : AerosolFit
            Fit to all scans, the initial value.
        progress : callable, optional
            Called with the number of each scan.
        """
        count = self.scans.radiance.shape[0]
        out = np.empty_like(self.scans.radiance)
        for scan in range(count):
            if progress is not None:
                progress(scan)
            out[scan] = self.fitted(np.arange(count) != scan, whole).predicted[scan]
        return out


@dataclass(frozen=True)
class _Part:
    """Subset of the values of a model."""

    model: SkyModel
    values: NDArray[np.bool_]

    def __call__(self, values: FloatArray) -> FloatArray:
        return self.model(values)[self.values]

    def derivative(self, values: FloatArray, index: int, *, central: bool) -> FloatArray:
        return self.model.derivative(values, index, central=central)[self.values]


def fit_pointing(
    model: Callable[[FloatArray, FloatArray], FloatArray], scans: Scans, iterations: int = 4
) -> tuple[FloatArray, FloatArray]:
    """Small rotations of the instrument, one per scan, that minimise a model's error.

    A diagnosis of the part of a model's error that could be due to pointing: three angles per scan
    are fitted.

    Parameters
    ----------
    model : callable
        Radiance for view zenith and azimuth [deg], each of shape (ns, nd); shape (ns, nd, nl).
    iterations : int
        Number of iterations, of four calls of the model each.

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
