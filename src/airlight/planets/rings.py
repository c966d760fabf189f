"""Rings of a planet: tables ``[[rings]]`` of its file."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError, warn
from airlight.physics.optics.ring_profile import RingProfile, read_ring_profile
from airlight.planets.parameters import MISSING, ascending, parameters
from airlight.planets.schema.field import Field, Wavelengths, always, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import Limits, PerWavelength, Spectral, spectral_at, spectral_limits

FloatArray = npt.NDArray[np.float64]

#: Largest number of rings of a planet, and of rows of a profile.
MAX_RINGS: Final = 16
MOST_ROWS: Final = 1000
#: Fraction of an edge's radius by which a table of radii may end before it. [1]
_NEAR: Final = 1e-3
#: Largest normal optical depth, which transmits nothing. [1]
DENSEST: Final = 100.0
#: Exponent of the phase function of Callisto, which fits the A ring: Dones, Cuzzi & Showalter
#: (1993), Icarus 105, 184. [1]
CALLISTO: Final = 3.092

_RADIUS: Final = Field(
    help="-",
    unit="m",
    range=(1e3, 1e13),
    example="92000 km",
    shown="km",
    slider=(1e3, 3e5),
    offered=always,
)


def _read_profile(table: TomlTable, name: str, wavelengths: Wavelengths) -> str | None:
    """Name of a table of the package, or path of a file beside the planet's."""
    if name not in table:
        return None
    given = table.text(name, "the name of a profile, or the path of a CSV file")
    return str(table.beside(given)) if given.endswith(".csv") else given


@parameters
class Ring(TomlModel):
    """Flat ring in the plane of the equator, one of the tables ``[[rings]]``.

    Parameters
    ----------
    name : str, optional
        Name of 1 to 60 letters.
    inner_radius, outer_radius : float
        Radii of its edges, from the centre of the planet. [m]
    optical_depth : float, optional
        Normal optical depth, if it is the same everywhere, 0 to 100. [1]
    radii, optical_depths : tuple of float, optional
        Normal optical depth [1] by radius [m], linear in between; radii within the edges.
    profile : str, optional
        Name or path of a table of the normal optical depth by radius, and of relative albedos, of
        which the ring takes the part between its edges; see ``physics.optics.ring_profile``.
    single_scattering_albedo : float or PerWavelength
        Fraction of the intercepted light that the particles scatter, 0 to 1. [1]
    exponent : float
        Exponent n of the phase function of large particles, (π - α)ⁿ with the phase angle α; 0 is
        isotropic. [1]
    dust : float
        Fraction of scattering by dust, 0 to 1. [1]
    asymmetry : float
        Asymmetry of the Henyey-Greenstein phase function of dust. [1]

    Examples
    --------
    >>> ring = Ring(inner_radius=9e7, outer_radius=1e8, optical_depth=1.5)
    >>> ring.depths([8e7, 9.5e7]).tolist()
    [0.0, 1.5]
    """

    has_wavelengths = True

    name: str | None = key(
        help="Name of the ring.",
        note="1 to 60 letters.",
        range=(1.0, 60.0),
        example="a name of its own",
        default=None,
    )
    inner_radius: float = key(_RADIUS, help="Radius of the inner edge, above the air.")
    outer_radius: float = key(_RADIUS, help="Radius of the outer edge.")
    optical_depth: float | None = key(
        help="Normal optical depth, the same everywhere.",
        note="Alternative to radii and optical_depths, and to profile.",
        range=(0.0, DENSEST),
        example="0.5",
        slider=(0.001, 10.0),
        scale="log",
        synonyms=("opacity",),
        default=None,
    )
    radii: tuple[float, ...] | None = key(
        label="radius",
        help="Radii of a profile of the normal optical depth, in increasing order.",
        note="2 to 1000 within the edges; the first and last value hold up to the edges.",
        unit="m",
        range=(1e3, 1e13),
        example="92000, 99000 km",
        shown="km",
        slider=(1e3, 3e5),
        default=None,
    )
    optical_depths: tuple[float, ...] | None = key(
        label="optical depth",
        help="Normal optical depth at each of `radii`, linear in between.",
        range=(0.0, DENSEST),
        example="1.1, 1.5",
        slider=(0.001, 10.0),
        scale="log",
        per="radii",
        per_unit="km",
        default=None,
    )
    profile: str | None = key(
        help="Table of the normal optical depth by radius.",
        note="`saturn`, or the path of a CSV file with columns `radius_km` and `optical_depth`,"
        " linear in between; in `brightness` it may have relative albedos, whose mean in the ring"
        " is `single_scattering_albedo`. The ring takes the part between its edges.",
        range=(1.0, 1000.0),
        example="the name of a profile, or the path of a CSV file",
        read=_read_profile,
        default=None,
    )
    single_scattering_albedo: Spectral = key(
        help="Fraction of the intercepted light that the particles scatter.",
        range=(0.0, 1.0),
        example="0.5",
        offered=always,
        synonyms=("brightness", "colour"),
        default=0.5,
    )
    exponent: float = key(
        help="Exponent n of the phase function of large particles.",
        note="(π - α)ⁿ, α the phase angle; 3.092 is Callisto's, 0 isotropic.",
        range=(0.0, 20.0),
        example="3.3",
        mode="advanced",
        default=CALLISTO,
    )
    dust: float = key(
        help="Fraction of the scattering that is done by dust.",
        note="Dust scatters forward: bright against the sun.",
        range=(0.0, 1.0),
        example="0.1",
        mode="advanced",
        default=0.0,
    )
    asymmetry: float = key(
        help="Asymmetry of the phase function of dust, Henyey-Greenstein.",
        range=(-0.99, 0.99),
        example="0.8",
        mode="advanced",
        default=0.8,
    )

    def __post_init__(self) -> None:
        if not self.inner_radius < self.outer_radius:
            allowed = f"more than inner_radius, {self.inner_radius:.10g} m"
            raise ParameterError("outer_radius", self.outer_radius, allowed)
        listed = self.radii is not None or self.optical_depths is not None
        if self.profile is not None:
            if listed or self.optical_depth is not None:
                raise ConflictError("profile", "cannot be combined with optical_depth or radii")
            self._check_profile(read_ring_profile(self.profile))
            return
        if self.optical_depth is not None:
            if listed:
                raise ConflictError("optical_depth", "cannot be combined with a profile")
            return
        if self.radii is None or self.optical_depths is None:
            name = "optical_depths" if self.radii is not None else "optical_depth"
            name = "radii" if self.optical_depths is not None else name
            allowed = "optical_depth, or radii and optical_depths, or profile"
            raise ParameterError(name, MISSING, allowed)
        if not 2 <= len(self.radii) <= MOST_ROWS:
            raise ParameterError("radii", self.radii, f"2 to {MOST_ROWS} radii")
        if len(self.optical_depths) != len(self.radii):
            allowed = f"one for each of {len(self.radii)} radii"
            raise ParameterError("optical_depths", self.optical_depths, allowed)
        ascending(self.radii, "radii", "m")
        if not self.inner_radius <= self.radii[0] <= self.radii[-1] <= self.outer_radius:
            allowed = f"{self.inner_radius:.10g} to {self.outer_radius:.10g} m, the edges"
            raise ParameterError("radii", self.radii, allowed)

    def _check_profile(self, table: RingProfile) -> None:
        """Refuse a table that ends within the ring, and one with which albedos exceed 1."""
        low, high = table.radii[0] * (1.0 - _NEAR), table.radii[-1] * (1.0 + _NEAR)
        if not low <= self.inner_radius < self.outer_radius <= high:
            allowed = f"a table from {self.inner_radius:.10g} to {self.outer_radius:.10g} m"
            raise ParameterError("profile", self.profile, allowed)
        own = table.radii[(table.radii >= self.inner_radius) & (table.radii <= self.outer_radius)]
        given = self.single_scattering_albedo
        mean = max(given.values) if isinstance(given, PerWavelength) else given
        relative = self.relative_albedo(own).max(initial=1.0)
        if mean * relative > 1.0:
            allowed = f"at most {1.0 / relative:.3g}: brightness of the profile is up to "
            allowed += f"{relative:.3g} times its mean"
            raise ParameterError("single_scattering_albedo", float(mean), allowed)

    @property
    def limits(self) -> Limits:
        """Wavelength range of its albedo. [nm]"""
        return spectral_limits(self.single_scattering_albedo)

    def depths(self, radii: npt.ArrayLike) -> FloatArray:
        """Normal optical depth at radii [m], 0 beyond the edges, shape (n,). [1]"""
        at = np.asarray(radii, float)
        inside = (at >= self.inner_radius) & (at <= self.outer_radius)
        if self.optical_depth is not None:
            return np.where(inside, self.optical_depth, 0.0)
        if self.profile is not None:
            table = read_ring_profile(self.profile)
            return np.where(inside, np.interp(at, table.radii, table.depths), 0.0)
        assert self.radii is not None
        assert self.optical_depths is not None
        return np.where(inside, np.interp(at, self.radii, self.optical_depths), 0.0)

    def albedos(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Single-scattering albedo at wavelengths [nm], the mean of the ring, shape (nl,). [1]"""
        return spectral_at(self.single_scattering_albedo, wavelengths)

    def relative_albedo(self, radii: npt.ArrayLike) -> FloatArray:
        """Albedo at radii [m] over the mean, weighted by what the ring intercepts, (n,). [1]"""
        at = np.asarray(radii, float)
        if self.profile is None:
            return np.ones_like(at)
        table = read_ring_profile(self.profile)
        own = (table.radii >= self.inner_radius) & (table.radii <= self.outer_radius)
        stopped = -np.expm1(-table.depths[own]) * table.radii[own]
        if not stopped.sum() > 0.0:
            return np.ones_like(at)
        mean = np.average(table.brightness[own], weights=stopped)
        return np.asarray(np.interp(at, table.radii, table.brightness) / mean)


def check_rings(rings: tuple[Ring, ...], top_radius: float) -> None:
    """Raise an error for rings that overlap each other or the air.

    Parameters
    ----------
    rings : tuple of Ring
        Rings of a planet, in any order.
    top_radius : float
        Radius of the top of its air. [m]
    """
    if len(rings) > MAX_RINGS:
        raise ParameterError("rings", len(rings), f"at most {MAX_RINGS} of them")
    order = sorted(range(len(rings)), key=lambda k: rings[k].inner_radius)
    below, what = top_radius, "the top of the air"
    for k in order:
        if rings[k].inner_radius < below:
            raise ParameterError(
                f"rings[{k}].inner_radius",
                rings[k].inner_radius,
                f"at least {below:.10g} m, {what}",
            )
        below, what = rings[k].outer_radius, "the outer edge of the ring below"


def warn_of_rings(rings: tuple[Ring, ...], consumer: str, *, placed: bool | None = None) -> None:
    """Issue a warning where rings, their shadow and their light are left out.

    Parameters
    ----------
    rings : tuple of Ring
        Rings of the planet.
    consumer : str
        What is computed without them.
    placed : bool, optional
        Whether latitude and the star's bearing are known, and with them the shadow, if they could
        be.
    """
    if not rings:
        return
    left = "their light is" if placed else "their shadow and light are"
    hint = "; latitude and sun_azimuth add the shadow" if placed is False else ""
    warn(f"{consumer} without rings: {left} left out; pictures have them{hint}")
