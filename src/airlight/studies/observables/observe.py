"""Catalogue of observables: description, settings and spectrum of each."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ConflictError, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.units import Measure, values_in
from airlight.planets.rings import warn_of_rings
from airlight.solver.named_axes import WAVELENGTH
from airlight.solver.solution import Solution
from airlight.solver.solve import solution_of
from airlight.studies.observables.disc import disc_reflectance, disc_stokes, spherical_albedo
from airlight.studies.observables.limb import limb_radiance
from airlight.studies.observables.transit import transit

if TYPE_CHECKING:
    import xarray

    from airlight.physics.units import Measures
    from airlight.planets.reading.reader import PlanetLike

FloatArray = NDArray[np.float64]
#: Named values with their dimensions, values, unit and long name.
_Variables = dict[str, tuple[tuple[str, ...], ArrayLike, str, str]]

#: Phase angles of a phase curve. [deg]
PHASES: Final = tuple(float(angle) for angle in range(0, 181, 5))
#: Number of tangent heights of a limb.
HEIGHTS: Final = 60


@dataclass(frozen=True)
class Geometry:
    """Settings of an observable; None stands for the default of the observable.

    Numbers, texts with a unit or quantities, see ``airlight.physics.units.values_in``.

    Attributes
    ----------
    radius : float, optional
        Radius of the reference disc; that of the ground by default. [m]
    phase_angles : array, shape (n,), optional
        Phase angles of ``disc`` (0) and ``phase-curve`` (0 to 180 by 5). [deg]
    tangent_heights : array, shape (n,), optional
        Tangent heights of ``limb``; 60 from 0 to the top of the shell by default. [m]
    sun_zenith, azimuth : float, optional
        Sun at the tangent point of ``limb``: zenith angle (60), and azimuth from the line of sight
        (90). [deg]
    """

    radius: Measure | None = None
    phase_angles: Measures | None = None
    tangent_heights: Measures | None = None
    sun_zenith: Measure | None = None
    azimuth: Measure | None = None


@dataclass(frozen=True)
class Observable:
    """Observable.

    Attributes
    ----------
    sentence : str
        Description.
    takes : tuple of str
        Names of its settings in ``Geometry``.
    of : callable
        Function of solution, geometry, progress and cancel that returns variables and notes.
    """

    sentence: str
    takes: tuple[str, ...]
    of: Callable[[Solution, Geometry, Progress | None, Cancel | None], tuple[_Variables, list[str]]]


def observe(
    solution: Solution | PlanetLike,
    of: str,
    *,
    radius: Measure | None = None,
    phase_angles: Measures | None = None,
    tangent_heights: Measures | None = None,
    sun_zenith: Measure | None = None,
    azimuth: Measure | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> xarray.Dataset:
    """Spectrum of an observable of a planet.

    Parameters
    ----------
    solution : Solution, Planet, str or Path
        Solution at the wavelengths of the spectrum; a planet, the name of a preset or a path is
        solved at the planet's wavelengths.
    of : str
        ``"geometric-albedo"``, ``"bond-albedo"``, ``"phase-curve"``, ``"transmission"``,
        ``"limb"`` or ``"disc"``.
    radius, phase_angles, tangent_heights, sun_zenith, azimuth
        See ``Geometry``.
    progress, cancel : callable, optional
        See ``solve``.

    Returns
    -------
    xarray.Dataset
        Variables over ``wavelength`` with units, quadrature errors of integrals, and the attribute
        ``notes``.

    Raises
    ------
    ParameterError
        If the observable is unknown or does not take a setting, or a value is out of its range.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("earth-bruneton", [550.0], "preview")
    >>> albedo = observe(solution, "geometric-albedo")["geometric_albedo"]
    >>> albedo.dims, bool(0.1 < albedo.item() < 0.3)
    (('wavelength',), True)
    """
    if of not in KINDS:
        raise ParameterError("of", of, ", ".join(KINDS))
    kind = KINDS[of]
    geometry = Geometry(radius, phase_angles, tangent_heights, sun_zenith, azimuth)
    for name, value in vars(geometry).items():
        if value is not None and name not in kind.takes:
            takers = ", ".join(name_of for name_of, one in KINDS.items() if name in one.takes)
            raise ConflictError(name, f"requires {takers}")
    solution = solution_of(solution, progress=progress, cancel=cancel)
    warn_of_rings(solution.medium.rings, of)
    variables, notes = kind.of(solution, geometry, progress, cancel)
    return _dataset(solution, of, variables, notes)


def _dataset(
    solution: Solution, of: str, variables: _Variables, notes: list[str]
) -> xarray.Dataset:
    import xarray

    data = xarray.Dataset(
        {
            name: xarray.DataArray(
                np.asarray(values), dims=dims, attrs={"units": unit, "long_name": label}
            )
            for name, (dims, values, unit, label) in variables.items()
        }
    )
    nm = ("wavelength", solution.wavelengths, WAVELENGTH)
    known = [name for name in ("phase_angle", "tangent_height") if name in data]
    data = data.set_coords(known).assign_coords(wavelength=nm)
    name = solution.planet.name if solution.planet is not None else "planet"
    title = f"{name}: {KINDS[of].sentence}"
    data.attrs.update(title=title, observable=of, notes="; ".join(notes), **solution.provenance)
    return data


def _inside(field: str, value: Measures, low: float, high: float, unit: str) -> FloatArray:
    allowed = f"numbers from {low:g} to {high:g} {unit}"
    array = np.atleast_1d(values_in(value, unit, field, allowed=allowed))
    wrong = ~((array >= low) & (array <= high))
    if wrong.any() or array.ndim != 1 or not array.size:
        shown = float(array[wrong].flat[0]) if wrong.any() else value
        raise ParameterError(field, shown, f"{low:g} to {high:g} {unit}")
    return array


def _radius(solution: Solution, geometry: Geometry) -> tuple[float, str]:
    """Radius of the reference disc [m], and a note that names it."""
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    if geometry.radius is None:
        return bottom, f"per disc of the ground's radius, {bottom * 1e-3:.6g} km"
    radius = float(_inside("radius", geometry.radius, 0.1 * bottom, 10.0 * top, "m")[0])
    return radius, f"per disc of radius {radius * 1e-3:.6g} km"


def _distance(solution: Solution) -> float | None:
    """Distance of the star, or None if unknown. [m]"""
    return None if solution.planet is None else solution.planet.star.known_distance


_UNSEEN: Final = "distance of the star unknown: contrast omitted"


def _geometric_albedo(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    radius, line = _radius(solution, geometry)
    values, errors = disc_reflectance(
        solution, np.zeros(1), radius, progress=progress, cancel=cancel
    )
    return {
        "geometric_albedo": (("wavelength",), values[0], "1", "geometric albedo"),
        "error": (("wavelength",), errors[0], "1", "error of the integral over the disc"),
    }, [line]


def _bond_albedo(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    radius, line = _radius(solution, geometry)
    values, errors = spherical_albedo(solution, radius, progress=progress, cancel=cancel)
    nm, sun = solution.wavelengths, solution.lights[0].irradiance
    order = np.argsort(nm)
    if nm.size > 1 and np.trapezoid(sun[order], nm[order]) > 0.0:
        whole = np.trapezoid((sun * values)[order], nm[order])
        mean = float(whole / np.trapezoid(sun[order], nm[order]))
        over = f"the star's light from {nm.min():g} to {nm.max():g} nm"
    else:
        mean, over = float(values.mean()), f"{nm[0]:g} nm alone"
    notes = [line, f"bond_albedo is the mean over {over}; other wavelengths are not included"]
    return {
        "spherical_albedo": (("wavelength",), values, "1", "spherical albedo"),
        "error": (("wavelength",), errors, "1", "error of the integrals over the disc"),
        "bond_albedo": ((), mean, "1", f"mean over {over}"),
    }, notes


def _phase_curve(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    radius, line = _radius(solution, geometry)
    asked = PHASES if geometry.phase_angles is None else geometry.phase_angles
    angles = _inside("phase_angles", asked, 0.0, 180.0, "deg")
    stokes, both_errors = disc_stokes(
        solution, np.append(angles, 0.0), radius, progress=progress, cancel=cancel
    )
    values, errors = stokes[:, 0], both_errors[:, 0]
    full = values[-1]
    curve = np.divide(values[:-1], full, out=np.zeros_like(values[:-1]), where=full > 0.0)
    both = ("phase_angle", "wavelength")
    return {
        "phase_angle": (("phase_angle",), angles, "degree", "phase angle"),
        "reflectance": (both, values[:-1], "1", "geometric albedo times phase function"),
        "error": (both, errors[:-1], "1", "error of the integral over the disc"),
        "phase_function": (both, curve, "1", "brightness relative to full phase"),
        **_polarisation(solution, stokes[:-1], both_errors[:-1]),
    }, [line, *_plane(solution)]


def _disc(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    radius, line = _radius(solution, geometry)
    asked = 0.0 if geometry.phase_angles is None else geometry.phase_angles
    angles = _inside("phase_angles", asked, 0.0, 180.0, "deg")
    stokes, both_errors = disc_stokes(solution, angles, radius, progress=progress, cancel=cancel)
    values, errors = stokes[:, 0], both_errors[:, 0]
    both = ("phase_angle", "wavelength")
    sun = solution.lights[0].irradiance
    radiance = values * sun / math.pi
    variables: _Variables = {
        "phase_angle": (("phase_angle",), angles, "degree", "phase angle"),
        "reflectance": (both, values, "1", "reflectance relative to a white disc at full phase"),
        "error": (both, errors, "1", "error of the integral over the disc"),
        "radiance": (both, radiance, "W m-2 sr-1 nm-1", "mean radiance of the reference disc"),
        "intensity": (both, values * sun * radius**2, "W sr-1 nm-1", "radiant intensity"),
        **_polarisation(solution, stokes, both_errors),
    }
    notes = [line, *_plane(solution)]
    distance = _distance(solution)
    if distance is None:
        return variables, [*notes, _UNSEEN]
    contrast = values * (radius / distance) ** 2
    variables["contrast"] = (both, contrast, "1", "planet-to-star contrast")
    return variables, [*notes, f"star at {distance:.4g} m"]


def _polarisation(solution: Solution, stokes: FloatArray, errors: FloatArray) -> _Variables:
    """Signed degree of linear polarisation of the disc; empty in scalar transfer."""
    if not solution.polarised:
        return {}
    i, q = np.moveaxis(stokes, 1, 0)
    both = ("phase_angle", "wavelength")
    nothing = np.zeros_like(i)
    degree = np.divide(q, i, out=nothing.copy(), where=i > 0.0)
    error = errors[:, 1] + np.abs(degree) * errors[:, 0]
    error = np.divide(error, i, out=nothing, where=i > 0.0)
    return {
        "polarisation": (both, degree, "1", "degree of linear polarisation, Q/I"),
        "polarisation_error": (both, error, "1", "error of the integrals over the disc"),
    }


def _plane(solution: Solution) -> list[str]:
    """Note on the sign of the polarisation."""
    if not solution.polarised:
        return []
    return [
        "polarisation is positive perpendicular to the plane of star, planet and observer; U is 0"
    ]


def _transmission(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    found = transit(solution)
    bottom = solution.medium.bottom_radius
    ends = "refraction (lower rays miss the star)" if found.limited_by_refraction else "the ground"
    notes = [
        f"rays end {(found.lowest - bottom) * 1e-3:.3g} km above the ground, by {ends}",
        "direct light of a uniform star; forward scattering is neglected",
    ]
    line = ("wavelength",)
    variables: _Variables = {
        "effective_radius": (line, found.radius, "m", "radius of an opaque disc"),
        "error": (line, found.error, "m", "error of the integral over the limb"),
        "effective_height": (line, found.radius - bottom, "m", "effective radius above the ground"),
    }
    star = _star_radius(solution)
    if star is None:
        return variables, [*notes, "radius of the star unknown: transit depth omitted"]
    depth = (found.radius / star) ** 2
    variables["transit_depth"] = (line, depth, "1", "blocked fraction of the star's irradiance")
    return variables, [*notes, f"star of radius {star:.4g} m"]


def _star_radius(solution: Solution) -> float | None:
    """Radius of the star, or None if unknown. [m]"""
    if solution.planet is None or solution.planet.star.known_radius is not None:
        return None if solution.planet is None else solution.planet.star.known_radius
    distance = _distance(solution)
    return None if distance is None else distance * math.sin(solution.lights[0].angular_radius)


def _limb(
    solution: Solution, geometry: Geometry, progress: Progress | None, cancel: Cancel | None
) -> tuple[_Variables, list[str]]:
    top = solution.medium.thickness
    asked = geometry.tangent_heights
    if asked is None:
        asked = np.linspace(0.0, top, HEIGHTS, endpoint=False)
    heights = _inside("tangent_heights", asked, -solution.medium.bottom_radius, top, "m")
    zenith = 60.0 if geometry.sun_zenith is None else geometry.sun_zenith
    azimuth = 90.0 if geometry.azimuth is None else geometry.azimuth
    sun = float(_inside("sun_zenith", zenith, 0.0, 180.0, "deg")[0])
    around = float(_inside("azimuth", azimuth, -360.0, 360.0, "deg")[0])
    notes = [
        f"sun at the tangent point: zenith angle {sun:g} deg, {around:g} deg from the line of sight"
    ]
    if (heights < 0.0).any():
        notes.append("below tangent height 0 the radiance includes the ground")
    both, radiance = ("tangent_height", "wavelength"), limb_radiance(solution, heights, sun, around)
    return {
        "tangent_height": (("tangent_height",), heights, "m", "tangent height"),
        "radiance": (both, radiance, "W m-2 sr-1 nm-1", "radiance"),
    }, notes


#: Every observable by name.
KINDS: Final[dict[str, Observable]] = {
    "geometric-albedo": Observable(
        "brightness at full phase relative to a white disc", ("radius",), _geometric_albedo
    ),
    "bond-albedo": Observable(
        "scattered and reflected fraction of the star's irradiance", ("radius",), _bond_albedo
    ),
    "phase-curve": Observable(
        "brightness of the disc over the phase angle", ("radius", "phase_angles"), _phase_curve
    ),
    "transmission": Observable("effective radius in transit", (), _transmission),
    "limb": Observable(
        "limb radiance by tangent height",
        ("tangent_heights", "sun_zenith", "azimuth"),
        _limb,
    ),
    "disc": Observable(
        "disc-integrated radiance at a phase angle, and contrast to the star",
        ("radius", "phase_angles"),
        _disc,
    ),
}
