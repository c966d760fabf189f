"""Fit of a planet's parameters to measured radiances, or to the colours of a photograph."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime, time
from pathlib import Path
from time import perf_counter
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.picture_wavelengths import picture_wavelengths
from airlight.planets.planet import Planet
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.nested_tables import Tables
from airlight.planets.reading.overrides import overridden
from airlight.planets.reading.reader import load_planet, nested_tables, planet_text, read_tables
from airlight.solver.solution import Solution
from airlight.studies.fit.free_parameters import FreeParameter, free_parameter
from airlight.studies.fit.least_squares import Data, FitResult, fit
from airlight.studies.fit.measurements import Measurements
from airlight.studies.fit.parameter import FitParameter
from airlight.studies.fit.phase_lobes import with_lobes
from airlight.studies.fit.photograph import Photograph
from airlight.studies.fit.settings import FitSettings, adapted, check_names
from airlight.studies.fit.sky_model import (
    Nuisance,
    ObservedDirections,
    SkyModel,
    smooth,
    smooth_near,
)

FloatArray = NDArray[np.float64]

#: Parameters of the instrument.
SCALE, AZIMUTH, ZENITH = "scale", "pointing.azimuth", "pointing.zenith"
RED, BLUE = "white_balance.red", "white_balance.blue"
#: Largest magnitude of the pointing offset. [deg]
MOST_TURN: Final = 10.0
#: Range of the scale factor of absolute radiances. [1]
_SCALES: Final = (0.2, 5.0)
#: Fraction of the median radiance below which a relative uncertainty becomes absolute. [1]
_DARKEST: Final = 1e-3
#: Number of wavelengths of a photograph's colours.
_COLOUR_WAVELENGTHS: Final = 12


@dataclass(frozen=True, kw_only=True, eq=False)
class SkyFit:
    """Fitted sky.

    Attributes
    ----------
    fitted : FitResult
        Values, error bars and correlations.
    data : Measurements or Photograph
        Fitted data.
    first : array, shape (n,)
        Prediction at the start.
    tables : dict
        Tables of the fitted planet's file.
    planet : Planet
        Fitted planet.
    settings : FitSettings
    name : str
        Name of the initial planet.
    solves, rough_solves : int
        Numbers of computed solutions, at the quality of the settings and coarse ones.
    seconds : float
        Wall time. [s]
    """

    fitted: FitResult
    data: Measurements | Photograph
    first: FloatArray
    tables: Tables
    planet: Planet
    settings: FitSettings
    name: str
    solves: int
    rough_solves: int
    seconds: float


def fit_radiances(
    planet: str | Path,
    data: Measurements,
    settings: FitSettings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> SkyFit:
    """Fit parameters of a planet to measured radiances.

    Parameters
    ----------
    planet : str or Path
        Initial planet, see ``load_planet``.
    data : Measurements
    settings : FitSettings
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ParameterError
        If a name or value of the settings is wrong, a wavelength is outside the planet's range, or
        the data do not constrain a parameter.
    ConvergenceError
        If the fit does not converge.
    Cancelled
        If ``cancel`` returned True.
    """
    base = _Base(planet, settings, progress, cancel)
    _check_wavelengths(base.planet, data)
    directions, row = _directions(data)
    nm = data.wavelengths
    column = np.searchsorted(nm, data.wavelength)
    uncertainty, known = _uncertainty(data, settings)
    observed = Data(data.radiance, uncertainty, known, data.scan)
    light = _light(base.planet, data)

    def radiances(radiance: FloatArray, solution: Solution) -> FloatArray:
        share = light / solution.lights[0].irradiance[column] if given else light
        return np.asarray(share * radiance[row, column])

    given = data.solar_irradiance is not None
    identity = row.tobytes() + column.tobytes() + light.tobytes()
    seen = _Seen(nm, directions, radiances, observed, identity, data.bandwidths)
    return _fitted(base, data, seen, lambda _: _instrument(settings, data.scans, data.scan))


def fit_photograph(
    planet: str | Path,
    data: Photograph,
    settings: FitSettings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> SkyFit:
    """Fit parameters of a planet to the colours of a photograph of unknown exposure.

    The exposure is the free parameter ``scale``.

    Parameters
    ----------
    planet, settings, progress, cancel
        See ``fit_radiances``.
    data : Photograph

    Raises
    ------
    ParameterError, ConvergenceError, Cancelled
        See ``fit_radiances``.
    """
    from airlight.image.spectral import rgb_weights

    base = _Base(planet, settings, progress, cancel)
    count = data.view_zenith.size
    nm = picture_wavelengths(base.planet, _COLOUR_WAVELENGTHS)
    whole = np.zeros(count, np.int64)
    altitude, sun = np.full(count, data.altitude), np.full(count, data.sun_zenith)
    directions = ObservedDirections(altitude, sun, data.view_zenith, data.azimuth, whole)

    def colours(radiance: FloatArray, solution: Solution) -> FloatArray:
        return np.asarray((radiance @ rgb_weights(nm, solution.lights[0].spectrum)).ravel())

    known = settings.uncertainty is not None
    relative = 1.0 if settings.uncertainty is None else settings.uncertainty
    values, group = data.rgb.ravel(), np.repeat(data.part, 3)
    observed = Data(values, relative * data.sizes.ravel(), known, group)
    seen = _Seen(nm, directions, colours, observed, b"colours")
    return _fitted(base, data, seen, lambda first: _camera(settings, first, data))


class _Base:
    """Initial planet: its tables, and the settings."""

    def __init__(
        self,
        planet: str | Path,
        settings: FitSettings,
        progress: Progress | None,
        cancel: Cancel | None,
    ) -> None:
        self.progress, self.cancel = progress, cancel
        self.name = str(planet)
        load_planet(planet, settings.overrides, progress=progress, cancel=cancel)  # its own errors
        text, self.file, self.folder = planet_text(planet)
        changed = overridden(nested_tables(text, self.file), settings.overrides)
        own = spelled_out(changed, self.folder)
        self.settings, self.tables = with_lobes(settings, own, self.read(own))
        self.planet = self.read(self.tables)

    def read(self, tables: Tables, wavelengths: FloatArray | None = None) -> Planet:
        """Planet from tables, validated at some wavelengths."""
        if wavelengths is None:
            return read_tables(tables, self.file, self.folder)
        return read_tables(
            tables, self.file, self.folder, wavelengths=lambda _: wavelengths, cancel=self.cancel
        )

    def free(self, wavelengths: FloatArray) -> list[FreeParameter]:
        """Free parameters of the planet, with the settings' starts, bounds and priors."""
        own = (SCALE, AZIMUTH, ZENITH, RED, BLUE)
        names = [name for name in self.settings.free if name not in own]
        found = [free_parameter(name, self.tables, self.planet, wavelengths) for name in names]
        return [replace(one, parameter=adapted(one.parameter, self.settings)) for one in found]


class _Seen(NamedTuple):
    """Observed values, and how they follow from radiances; see ``SkyModel``."""

    wavelengths: FloatArray
    directions: ObservedDirections
    combine: Callable[[FloatArray, Solution], FloatArray]
    observed: Data
    identity: bytes
    bandwidth: FloatArray | None = None


def _fitted(
    base: _Base,
    data: Measurements | Photograph,
    seen: _Seen,
    instrument: Callable[[FloatArray], list[Nuisance]],
) -> SkyFit:
    """Fit a planet to values of any kind."""
    started, nm, observed = perf_counter(), seen.wavelengths, seen.observed
    check_names(base.settings, [SCALE] if isinstance(data, Photograph) else [])
    free = base.free(nm)
    if not free:
        raise ParameterError("free", ", ".join(base.settings.free), "a parameter of the planet")

    def tables_of(values: FloatArray) -> Tables:
        tables = base.tables
        pairs = sorted(zip(free, values, strict=True), key=lambda one: one[0].order)
        for one, value in pairs:
            tables = one.write(tables, float(value))
        return tables

    names = json.dumps([one.parameter.name for one in free])
    whole = names + json.dumps(base.tables, default=str, sort_keys=True) + str(base.folder)
    model = SkyModel(
        planet_of=lambda values: base.read(tables_of(values), nm),
        parameters=[one.parameter for one in free],
        nuisances=[],
        directions=seen.directions,
        wavelengths=nm,
        combine=seen.combine,
        bandwidth=seen.bandwidth,
        quality=smooth(base.settings.quality),
        identity=(
            hashlib.sha256(whole.encode() + seen.identity).digest() if base.settings.keep else b""
        ),
        progress=base.progress,
        cancel=base.cancel,
        expected=3 * len(free) + 8,
    )
    rough = replace(model, quality=smooth("preview"))
    model.nuisances = instrument(rough(np.array([one.parameter.start for one in free])))
    rough.nuisances, parameters = model.nuisances, model.all_parameters
    begun = fit(rough, observed, parameters, loss=base.settings.loss)
    near = base.read(tables_of(begun.values[: len(free)]), nm)
    model.quality = smooth_near(base.settings.quality, near, nm)
    found = fit(model, observed, parameters, loss=base.settings.loss, start=begun.values)
    first = rough(np.array([one.start for one in parameters]))
    tables = tables_of(found.values[: len(free)])
    return SkyFit(
        fitted=found,
        data=data,
        first=first,
        tables=tables,
        planet=base.read(tables),
        settings=base.settings,
        name=base.name,
        solves=model.solves,
        rough_solves=rough.solves,
        seconds=perf_counter() - started,
    )


# --- the instrument ---------------------------------------------------------------------------


def _instrument(
    settings: FitSettings, scans: Sequence[str], scan: NDArray[np.int64]
) -> list[Nuisance]:
    """Free parameters of the instrument, common or per scan."""
    found = []
    for name in [*settings.free, *settings.per_scan]:
        if name in (RED, BLUE):
            raise ConflictError(name, "requires a photograph")
        if name not in (SCALE, AZIMUTH, ZENITH):
            if name in settings.per_scan:
                allowed = ", ".join((SCALE, AZIMUTH, ZENITH))
                raise ParameterError("per_scan", name, allowed)
            continue
        every = np.ones(len(scans), bool)
        if name not in settings.per_scan:
            found.append(_nuisance(name, name, settings, np.ones(scan.size, bool), every))
            continue
        for number, word in enumerate(scans):
            only = np.arange(len(scans)) == number
            found.append(_nuisance(name, f"{name}, {word}", settings, scan == number, only))
    return found


def _nuisance(
    kind: str, name: str, settings: FitSettings, values: NDArray[np.bool_], scans: NDArray[np.bool_]
) -> Nuisance:
    if kind == SCALE:
        low, high = _SCALES
        plain = FitParameter(name=kind, start=1.0, low=low, high=high, least_step=0.01)
        form: Any = "factor"
    else:
        plain = FitParameter(
            name=kind, unit="deg", start=0.0, low=-MOST_TURN, high=MOST_TURN, least_step=0.1
        )
        form = "zenith" if kind == ZENITH else "azimuth"
    parameter = replace(adapted(plain, settings), name=name)
    return Nuisance(parameter=parameter, kind=form, values=values, scans=scans)


def _camera(settings: FitSettings, first: FloatArray, data: Photograph) -> list[Nuisance]:
    """Exposure and the other free parameters of the camera."""
    if settings.per_scan:
        raise ConflictError("per_scan", "does not apply to a photograph")
    whole, one = np.ones(first.size, bool), np.ones(1, bool)
    ratio = float(np.median(data.rgb.ravel()) / np.median(first))
    exposure = FitParameter(
        name=SCALE, start=ratio, low=1e-3 * ratio, high=1e3 * ratio, least_step=0.01 * ratio
    )
    found = [
        Nuisance(parameter=adapted(exposure, settings), kind="factor", values=whole, scans=one)
    ]
    channel = np.arange(first.size) % 3
    for name in settings.free:
        if name in (AZIMUTH, ZENITH):
            found.append(_nuisance(name, name, settings, whole, one))
        elif name in (RED, BLUE):
            plain = FitParameter(name=name, start=1.0, low=0.1, high=10.0, least_step=0.01)
            chosen = channel == (0 if name == RED else 2)
            parameter = adapted(plain, settings)
            found.append(Nuisance(parameter=parameter, kind="factor", values=chosen, scans=one))
    return found


# --- the data ---------------------------------------------------------------------------------


def _directions(data: Measurements) -> tuple[ObservedDirections, NDArray[np.int64]]:
    """Distinct directions of the data, and the index of each value's."""
    table = np.stack(
        [data.altitude, data.sun_zenith, data.view_zenith, data.azimuth, data.scan], axis=-1
    )
    unique, row = np.unique(table, axis=0, return_inverse=True)
    altitude, sun, view, azimuth, scan = unique.T
    directions = ObservedDirections(altitude, sun, view, azimuth, scan.astype(np.int64))
    return directions, np.asarray(row, dtype=np.int64).reshape(-1)


def _light(planet: Planet, data: Measurements) -> FloatArray:
    """Star's irradiance at each value [W m⁻² nm⁻¹] if given, or over that of the planet's file.

    Over a day the irradiance of the Earth changes by 0.06 % at most.
    """
    if data.solar_irradiance is not None:
        return data.solar_irradiance
    found = np.ones(data.radiance.size)
    own = planet.star.known_distance
    if data.date is None or own is None or planet.body is None:
        return found
    days, which = np.unique(data.date, return_inverse=True)
    for number, day in enumerate(days):
        noon = datetime.combine(day.item(), time(12), tzinfo=UTC)
        there = planet.lit_at(noon).star.known_distance
        assert there is not None
        found[which == number] = (own / there) ** 2
    return found


def _uncertainty(data: Measurements, settings: FitSettings) -> tuple[FloatArray, bool]:
    """Standard deviations, and whether they are absolute."""
    if settings.uncertainty is None and data.uncertainty is not None:
        return data.uncertainty, True
    sizes = np.maximum(data.radiance, _DARKEST * float(np.median(data.radiance)))
    if not sizes.all():
        raise ParameterError(f"radiance in {data.source}", 0.0, "mostly positive values")
    if settings.uncertainty is not None:
        return settings.uncertainty * sizes, True
    return sizes, False


def _check_wavelengths(planet: Planet, data: Measurements) -> None:
    """Raise an error for a wavelength outside the planet's range, with its line."""
    low, high = planet.wavelength_limits
    wrong = np.flatnonzero(~((data.wavelength >= low) & (data.wavelength <= high)))
    if wrong.size:
        first = int(wrong[0])
        try:
            Medium.from_planet(planet, [data.wavelength[first]])
        except ParameterError as error:
            field_name = data.named("wavelength", first)
            raise ParameterError(
                field_name, float(data.wavelength[first]), error.allowed, data.source
            ) from None
