"""Irradiance of horizontal and tilted planes: global, direct, diffuse, luminous, active on life."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError, warn
from airlight.kernel.threads import Cancel, Progress
from airlight.planets import load_planet
from airlight.scene.scene import Scene
from airlight.solver.band_solution import band_widths
from airlight.solver.named_axes import COORDINATES, WAVELENGTH
from airlight.solver.solution import Solution
from airlight.solver.solve import solve
from airlight.solver.under_rings import ring_shade_at
from airlight.studies.observables.plane_irradiance import Plane, PlaneLight, plane_irradiance
from airlight.studies.observables.spectral_integrals import (
    WEIGHTED,
    SpectralIntegrals,
    irradiance_bands,
)

if TYPE_CHECKING:
    import xarray

    from airlight.planets.reading.reader import PlanetLike

FloatArray = NDArray[np.float64]

#: Long names of irradiances.
_LABELS: Final = {
    "ghi": "global horizontal irradiance",
    "dni": "direct normal irradiance",
    "dhi": "diffuse horizontal irradiance",
    "extraterrestrial": "irradiance of the star outside the atmosphere, on a plane that faces it",
    "poa": "global irradiance of the plane",
    "poa_direct": "direct irradiance of the plane",
    "poa_sky": "irradiance of the plane by the sky",
    "poa_ground": "irradiance of the plane by ground and air below the horizon",
}
#: Estimated error of an integral above which a warning is given. [1]
_LARGE_ERROR: Final = 0.01


def irradiance(
    solution: Solution | PlanetLike,
    scenes: Scene | Sequence[Scene],
    *,
    plane: Plane | None = None,
    spectral: bool = False,
    true_distance: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> xarray.Dataset:
    """Irradiance at an observer, or at a series of times.

    Global and diffuse light of the sky and direct light of the star's disc. Direct light is
    unscattered light alone: a pyrheliometer also receives light scattered by less than 2.5 degrees.
    Under clouds it is the mean of independent columns.

    Parameters
    ----------
    solution : Solution, Planet, str or Path
        Solution by the moments solver; a planet is solved at ``irradiance_bands`` at quality
        ``preview``, within 0.1 % of the ``ghi`` at ``default``.
    scenes : Scene or sequence of Scene
        Observers with their sun, such as ``Scene.at(...)``; their cameras do not matter.
    plane : Plane, optional
        Tilted plane, whose irradiance is added, from the radiance of sky and ground.
    spectral : bool
        Whether to return spectra, instead of integrals over wavelengths.
    true_distance : bool
        Whether scenes with a time are lit from the star's distance then, where it is known.
    progress, cancel : callable, optional
        See ``solve``.

    Returns
    -------
    xarray.Dataset
        Over ``time``, or ``case``; without it for one scene.

        ``ghi``, ``dni``, ``dhi``, ``extraterrestrial``, and for a plane ``poa``, ``poa_direct``,
        ``poa_sky``, ``poa_ground``: integrals over the solution's wavelengths, whose range is in
        the attributes ``wavelength_range`` [W m⁻²]; with ``spectral`` [W m⁻² nm⁻¹].

        ``illuminance`` [lx], ``par`` (400 to 700 nm) [W m⁻²], ``par_photons`` [µmol m⁻² s⁻¹] and
        ``uv_index`` (ISO/CIE 17166:2019) [1] of ``ghi``; ``poa_illuminance``, ``poa_par`` of
        ``poa``. NaN where the wavelengths do not reach.

    Raises
    ------
    ParameterError
        If the solution has one wavelength only and ``spectral`` is not set, an altitude is outside
        the shell, or the solution is of another solver.

    Warns
    -----
    AirlightWarning
        If the wavelengths are too few: an integral of the direct beam errs by more than 1 %.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("earth", range(400, 701, 50), "preview")
    >>> noon = irradiance(solution, airlight.Scene(sun_zenith=0.0, altitude=0.0))
    >>> noon.par.attrs["units"], 400.0 < noon.par.item() < 531.0  # the sun's own
    ('W m-2', True)
    """
    if not isinstance(solution, Solution):
        planet = load_planet(solution)
        nm, widths = irradiance_bands(planet)
        solution = solve(planet, nm, "preview", bandwidth=widths, progress=progress, cancel=cancel)
    several = not isinstance(scenes, Scene)
    listed: list[Scene] = list(scenes) if several else [scenes]  # type: ignore[arg-type, list-item]
    if not listed:
        raise ParameterError("scenes", "none", "one or more")
    if solution.wavelengths.size < 2 and not spectral:
        one = float(solution.wavelengths[0])
        raise ParameterError("wavelengths", one, "two or more, or spectral")
    dark = _ratios(solution, listed, plane, progress)
    factors = np.array([_distance_factor(solution, one) if true_distance else 1 for one in listed])
    data, notes = (_spectra if spectral else _integrals)(solution, dark, factors)
    return _dataset(solution, listed, data, notes, several)


def _ratios(
    solution: Solution, scenes: list[Scene], plane: Plane | None, progress: Progress | None
) -> dict[str, FloatArray]:
    """Irradiances over that of the star, each of shape (n, nl). [1]"""
    altitude = np.array([one.altitude for one in scenes])
    zenith = np.array([one.sun_zenith for one in scenes])
    latitude = np.array([one.latitude for one in scenes])
    bearing = np.array([one.sun_azimuth for one in scenes])
    medium = solution.medium
    place = {"latitude": latitude, "sun_azimuth": bearing} if medium.rings else {}
    found = solution.irradiance(altitude=altitude, sun_zenith=zenith, **place)
    star = solution.lights[0].irradiance
    lit = np.where(star > 0.0, star, 1.0)
    whole = (found["direct"].to_numpy() + found["diffuse"].to_numpy()) / lit
    r = np.minimum(medium.bottom_radius + altitude, medium.top_radius)
    sun = np.radians(zenith)
    flat, normal = solution.relative_beam(r, np.cos(sun))
    if medium.rings:
        left = ring_shade_at(medium, r, sun, np.radians(latitude), np.radians(bearing))[:, None]
        flat, normal = flat * left, normal * left
    flat = np.minimum(flat, whole)
    out = {"ghi": whole, "dni": normal, "dhi": whole - flat}
    out["extraterrestrial"] = np.ones_like(whole)
    if plane is None:
        return out
    parts: list[PlaneLight] = []
    for k, one in enumerate(scenes):
        light = plane_irradiance(
            solution,
            plane,
            altitude=one.altitude,
            sun_zenith=one.sun_zenith,
            sun_azimuth=one.sun_azimuth,
            beam=(flat[k], normal[k]),
            diffuse=out["dhi"][k],
        )
        parts.append(light)
        if progress is not None:
            progress(k + 1, len(scenes), "tilted plane")
    out["poa"] = np.array([sum(one) for one in parts])
    for name in PlaneLight._fields:
        out[f"poa_{name}"] = np.array([getattr(one, name) for one in parts])
    return out


def _distance_factor(solution: Solution, scene: Scene) -> float:
    """Irradiance of the star at the time of a scene over that of the solution. [1]"""
    planet = solution.planet
    if scene.time is None or planet is None or planet.star.irradiance is not None:
        return 1.0
    then, now = planet.lit_at(scene.time).star.known_distance, planet.star.known_distance
    return 1.0 if then is None or now is None else (now / then) ** 2


def _spectra(
    solution: Solution, ratios: dict[str, FloatArray], factors: FloatArray
) -> tuple[dict[str, Any], list[str]]:
    star = solution.lights[0].irradiance * factors[:, None]
    dims = ("case", "wavelength")
    return {
        name: (
            dims,
            ratio * star,
            {"units": "W m-2 nm-1", "long_name": f"spectral {_LABELS[name]}"},
        )
        for name, ratio in ratios.items()
    }, []


def _integrals(
    solution: Solution, ratios: dict[str, FloatArray], factors: FloatArray
) -> tuple[dict[str, Any], list[str]]:
    integrals = SpectralIntegrals(solution)
    errors = integrals.errors()
    data: dict[str, Any] = {}
    for name, ratio in ratios.items():
        words = {"units": "W m-2", "long_name": f"{_LABELS[name]}, {integrals.words}"}
        words["wavelength_range"] = integrals.words
        data[name] = ("case", integrals.broadband(ratio) * factors, words)
    weighted = [(name, "ghi", name) for name in WEIGHTED]
    if "poa" in ratios:
        weighted += [(f"poa_{name}", "poa", name) for name in ("illuminance", "par")]
    missing = []
    for name, of, kind in weighted:
        values = integrals.weighted(WEIGHTED[kind], ratios[of]) * factors
        label = WEIGHTED[kind].label + (" of the plane" if of == "poa" else "")
        data[name] = ("case", values, {"units": WEIGHTED[kind].unit, "long_name": label})
        if np.isnan(values).any():
            missing.append(name)
    notes = [f"irradiances are from {integrals.words}"]
    if missing:
        notes.append(f"wavelengths do not reach for {', '.join(missing)}")
    named = {"ghi" if name == "broadband" else name: error for name, error in errors.items()}
    _warn({name: error for name, error in named.items() if name not in missing})
    return data, notes


def _warn(errors: dict[str, float]) -> None:
    """Warn of integrals over too few wavelengths."""
    large = [f"{name} {100.0 * e:+.2g} %" for name, e in errors.items() if abs(e) > _LARGE_ERROR]
    if large:
        warn(f"too few wavelengths: estimated errors of {', '.join(large)}")


def _dataset(
    solution: Solution, scenes: list[Scene], data: dict[str, Any], notes: list[str], several: bool
) -> xarray.Dataset:
    import xarray

    coordinates: dict[str, Any] = {
        "altitude": ("case", [one.altitude for one in scenes], "m"),
        "sun_zenith": ("case", [one.sun_zenith for one in scenes], "degree"),
        "sun_azimuth": ("case", [one.sun_azimuth for one in scenes], "degree"),
    }
    known = COORDINATES | {"sun_azimuth": {"standard_name": "solar_azimuth_angle"}}
    coordinates = {
        name: (dims, values, {"units": unit, **known[name]})
        for name, (dims, values, unit) in coordinates.items()
    }
    found = xarray.Dataset(data, coordinates)
    if "wavelength" in found.dims:
        found = found.assign_coords(wavelength=("wavelength", solution.wavelengths, WAVELENGTH))
        widths = band_widths(solution)
        if widths is not None:
            words = {"units": "nm", "long_name": "width of the band"}
            found = found.assign_coords(bandwidth=("wavelength", widths, words))
    name = "planet" if solution.planet is None else solution.planet.name
    found.attrs.update(title=f"{name}: irradiance", notes="; ".join(notes), **solution.provenance)
    times = [one.time for one in scenes]
    if all(one is not None for one in times):
        utc = [
            np.datetime64(one.astimezone(UTC).replace(tzinfo=None), "ns")
            for one in times
            if one is not None
        ]
        label = {"standard_name": "time", "long_name": "time in UTC"}
        found = found.assign_coords(time=("case", utc, label))
        found = found.swap_dims(case="time")
    return found if several else found.squeeze()
