"""Common interface of every solver's result: radiance, transmittance, irradiance, residual.

Public arguments are degrees and metres, texts with a unit or quantities, as arrays that broadcast,
see ``named_axes``; observers outside the shell are moved to where their line of sight enters it;
results are labelled arrays.
"""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.files.provenance import provenance
from airlight.planets.light_source import LightSource
from airlight.planets.rings import warn_of_rings
from airlight.solver.air_mass_columns import replace_air_mass
from airlight.solver.lines_of_sight import LinesOfSight, distance_to_shell, enter_shell
from airlight.solver.named_axes import Argument, NamedAxes
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.report import Report
from airlight.solver.stokes_frame import STOKES, to_meridian
from airlight.solver.tables.columns import columns
from airlight.solver.under_rings import place_arguments, ring_shade_at, under_rings

if TYPE_CHECKING:
    import xarray

    from airlight.physics.units import Measures
    from airlight.planets.medium import Medium
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]


#: Largest altitude of an observer. [m]
HIGHEST = 1e15
#: Wavelength for which reports state albedos. [nm]
GREEN = 550.0


class Solution(ABC):
    """Radiance field of a planetary atmosphere at some wavelengths.

    Attributes
    ----------
    medium : Medium
        Medium that was solved.
    report : Report
        Provenance of the solution.
    planet : Planet or None
        Planet of the medium.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("mars-rayleigh", quality="preview")
    >>> thin = solution.transmittance(altitude=0.0, view_zenith=[0.0, 80.0])
    >>> thin.dims, bool((thin > 0.9).all())
    (('view_zenith', 'wavelength'), True)
    """

    medium: Medium
    report: Report
    planet: Planet | None = None
    _source: LightSource | None = None
    #: Whether the source is a secondary light of a scene; city lights belong to the first.
    secondary: bool = False

    def __repr__(self) -> str:
        name = "a medium" if self.planet is None else self.planet.name
        nm = self.wavelengths
        span = f"{nm.min():g} to {nm.max():g} nm" if nm.size > 1 else f"{nm[0]:g} nm"
        count = f"{nm.size} wavelengths, " if nm.size > 1 else ""
        return (
            f"<{type(self).__name__} of {name}: {count}{span}; {self.report.sweeps} sweeps, "
            f"last change {max(self.report.residual, default=0.0):.1e}>"
        )

    def of(self, planet: Planet) -> Self:
        """Attach the planet, and note its ground in the report."""
        nm = self.wavelengths
        line = planet.ground.local_line(float(nm[np.argmin(np.abs(nm - GREEN))]))
        self.planet, self.report = planet, replace(self.report, ground=line)
        return self

    @property
    def provenance(self) -> dict[str, str]:
        """Attributes of results, see ``airlight.files.provenance``."""
        name = None if self.planet is None else self.planet.name
        return provenance(name, self.report.provenance, self.report.settings)

    @cached_property
    def geometry(self) -> RefractedGeometry:
        """Refracted geometry of the medium."""
        return RefractedGeometry.of(self.medium)

    @property
    def lights(self) -> tuple[LightSource, ...]:
        """Light sources of the planet; the first is that of the solution."""
        if self._source is not None:
            return (self._source,)
        if self.planet is None:
            return self.medium.lights
        return tuple(
            replace(sampled, spectrum=light.spectrum, darkening=light.darkening)
            for sampled, light in zip(
                self.medium.lights, self.planet.lights(self.wavelengths), strict=True
            )
        )

    def with_light(self, source: LightSource, *, secondary: bool = False) -> Self:
        """Solution under another light source.

        Single scattering and direct irradiance of the ground use the source's own disc. Multiple
        scattering keeps the disc of the solve, which matters only while a disc sets.

        Parameters
        ----------
        source : LightSource
            Source, sampled at the solution's wavelengths.
        secondary : bool
            Whether it is a secondary light of a scene, without city lights.
        """
        other = copy.copy(self)
        other.medium, other._source = self.medium.with_light(source), source
        other.secondary = secondary
        return other

    #: Largest order that can be requested separately.
    highest_order: int = 1

    @property
    def shaded_by_rings(self) -> bool:
        """Whether radiances of lines with a ``pole`` are those in the shadow of the rings."""
        return False

    @abstractmethod
    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """Radiance per irradiance of the star along lines of sight, shape (n, nl). [sr⁻¹]

        ``order`` selects a single order of scattering and reflection.
        """

    @property
    def polarised(self) -> bool:
        """Whether transfer is polarised (I, Q, U) rather than scalar."""
        return False

    def relative_stokes(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """I, Q and U per irradiance of the star, shape (n, 3, nl), where ``polarised``. [sr⁻¹]

        Azimuths count as 0 to 180, see ``stokes_frame``.

        Raises
        ------
        ParameterError
            If transfer is scalar.
        """
        raise ParameterError("stokes", True, "a solver with polarised transfer")

    @abstractmethod
    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Diffuse horizontal irradiance, downward, per irradiance of the star, (n, nl). [1]"""

    @abstractmethod
    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Direct horizontal irradiance per irradiance of the star, (n, nl). [1]"""

    def relative_beam(self, r: FloatArray, mu_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Unscattered irradiance, horizontal and normal, per that of the star. [1]

        Without the delta-M fraction of forward peaks, unlike ``relative_direct_irradiance``.

        Parameters
        ----------
        r, mu_s : array, shape (n,)
            Radii [m] and cosines of the star's zenith angle [1].

        Returns
        -------
        horizontal, normal : array, shape (n, nl)
            [1]

        Raises
        ------
        ParameterError
            If the solver has no unscattered beam.
        """
        raise ParameterError("solver", self.report.solver, "moments")

    @property
    def wavelengths(self) -> FloatArray:
        """Wavelengths, shape (nl,). [nm]"""
        return self.medium.wavelengths

    def radiance(
        self,
        *,
        altitude: Measures,
        sun_zenith: Measures,
        view_zenith: Measures,
        azimuth: Measures = 0.0,
        order: int | None = None,
        stokes: bool = False,
        latitude: Measures | None = None,
        sun_azimuth: Measures | None = None,
    ) -> xarray.DataArray:
        """Radiance of atmosphere and ground for an observer, without the star's disc.

        Each argument is a number, text with a unit such as ``"400 km"`` or ``"0:80:10 deg"``, a
        quantity of pint, astropy or unyt, or an array of these. Arrays broadcast by the rules of
        NumPy, and an axis of the result has the name of the argument that varies along it;
        ``xarray.DataArray`` broadcast by the names of their dimensions.

        Parameters
        ----------
        altitude : array
            Altitude of the observer above the ground, also outside the shell. [m]
        sun_zenith, view_zenith : array
            Zenith angles of star and view at the observer, 0 to 180; with refraction, the true
            angle of the star and the apparent angle of the view. [deg]
        azimuth : array
            Azimuth of the view relative to the star; 0 towards the star's side. [deg]
        order : int, optional
            Order of scattering, 1 to ``highest_order``; default: all orders.
        stokes : bool
            Whether to return the Stokes parameters I, Q and U, in the frame of ``stokes_frame``:
            Q > 0 is polarised parallel to the meridian plane.
        latitude, sun_azimuth : array, optional
            Latitude of the observer, and compass bearing of the star, for the shadow of rings on
            air and ground; ``azimuth`` is then clockwise. Without them a planet with rings is
            computed without, which a warning says; the rings' own light is always left out. [deg]

        Returns
        -------
        xarray.DataArray, shape (..., wavelength), or (..., stokes, wavelength)
            Spectral radiance; I, Q and U with ``stokes``. [W m⁻² sr⁻¹ nm⁻¹]

        Raises
        ------
        ParameterError
            If a value is out of its range, the shapes do not broadcast, or Stokes parameters are
            requested of a scalar solution.
        """
        rays = altitude, sun_zenith, view_zenith, azimuth, latitude, sun_azimuth
        arrays, lines, axes = self._rays_from_arguments(*rays)
        self.check_order(order)
        warn_of_rings(self.medium.rings, "radiance", placed=latitude is not None)
        sun, unit = self.lights[0].irradiance, "W m-2 sr-1 nm-1"
        if not stokes:
            values = self.relative_radiance(lines, order=order) * sun
            return self._labelled(values, axes, "radiance", unit)
        self.check_polarised()
        found = to_meridian(self.relative_stokes(lines, order=order), *arrays[2:4]) * sun
        return self._labelled(found, axes.with_axis("stokes", STOKES), "radiance", unit)

    def check_polarised(self) -> None:
        """Raise an error if Stokes parameters are requested of a scalar solution."""
        if not self.polarised:
            raise ParameterError("stokes", True, "a solution with polarised transfer")

    def check_order(self, order: int | None) -> None:
        """Raise an error for an order that is not available separately."""
        if order is not None and not (isinstance(order, int) and 1 <= order <= self.highest_order):
            allowed = f"1 to {self.highest_order}" if self.highest_order > 1 else "1"
            raise ParameterError("order", order, f"{allowed}, or nothing for all orders")

    def lines_of_sight(
        self,
        *,
        altitude: Measures,
        sun_zenith: Measures,
        view_zenith: Measures,
        azimuth: Measures = 0.0,
    ) -> tuple[LinesOfSight, NamedAxes]:
        """Lines of sight inside the shell as flat arrays, and the axes of the inputs.

        Parameters
        ----------
        altitude, sun_zenith, view_zenith, azimuth : array
            Arguments of ``radiance``. [m], [deg]

        Raises
        ------
        ParameterError
            If a value is out of its range, or the shapes do not broadcast.
        """
        return self._rays_from_arguments(altitude, sun_zenith, view_zenith, azimuth)[1:]

    def _rays_from_arguments(
        self,
        altitude: Measures,
        sun_zenith: Measures,
        view_zenith: Measures,
        azimuth: Measures,
        latitude: Measures | None = None,
        sun_azimuth: Measures | None = None,
    ) -> tuple[list[FloatArray], LinesOfSight, NamedAxes]:
        """Arguments of ``radiance`` as flat arrays, and results of ``lines_of_sight``."""
        placed = place_arguments(latitude, sun_azimuth)
        arrays, axes = NamedAxes.of(
            altitude=Argument(altitude, 0.0, HIGHEST, "m"),
            sun_zenith=Argument(sun_zenith, 0.0, 180.0, "deg"),
            view_zenith=Argument(view_zenith, 0.0, 180.0, "deg"),
            azimuth=Argument(azimuth, -360.0, 360.0, "deg"),
            **placed,
        )
        sun, view, around = (np.radians(one) for one in arrays[1:4])
        mu, mu_s = np.cos(view), np.cos(sun)
        nu = np.clip(mu * mu_s + np.sin(view) * np.sin(sun) * np.cos(around), -1.0, 1.0)
        bottom, top = self.medium.bottom_radius, self.medium.top_radius
        lines = enter_shell(bottom + arrays[0], mu, np.sin(view), mu_s, nu, bottom, top)
        if placed and self.medium.rings:
            if not self.shaded_by_rings:
                allowed = "moments or montecarlo, for the shadow of rings"
                raise ParameterError("solver", self.report.solver, allowed)
            place = np.radians(arrays[4]), np.radians(arrays[5])
            lines = under_rings(lines, bottom + arrays[0], (view, around), sun, place)
        return arrays, lines, axes

    def transmittance(
        self,
        *,
        altitude: Measures,
        view_zenith: Measures,
        distance: Measures | None = None,
        air_mass: str | None = None,
    ) -> xarray.DataArray:
        """Transmittance along lines of sight from an observer, refracted if refraction is on.

        Arguments broadcast as those of ``radiance``.

        Parameters
        ----------
        altitude : array
            Altitude of the observer. [m]
        view_zenith : array
            Zenith angle of the view. [deg]
        distance : array, optional
            Length of the path; default: to space, with the result 0 where the ground blocks it.
            [m]
        air_mass : str, optional
            ``"pickering"``: columns of the gases by Pickering's air-mass formula, as in OpenSpace,
            for lines of sight from the ground to space; other constituents keep their columns.

        Returns
        -------
        xarray.DataArray, shape (..., wavelength)
            Transmittance. [1]
        """
        named = {
            "altitude": Argument(altitude, 0.0, HIGHEST, "m"),
            "view_zenith": Argument(view_zenith, 0.0, 180.0, "deg"),
        }
        if distance is not None:
            named["distance"] = Argument(distance, 0.0, HIGHEST, "m")
        arrays, axes = NamedAxes.of(**named)
        bottom, top = self.medium.bottom_radius, self.medium.top_radius
        r, view = bottom + arrays[0], np.radians(arrays[1])
        mu, sine, zero = np.cos(view), np.sin(view), np.zeros_like(view)
        lines = self.geometry.optical_lines(enter_shell(r, mu, sine, zero, zero, bottom, top))
        length = lines.length
        blocked = lines.to_ground
        if distance is not None:
            inside = np.maximum(arrays[2] - distance_to_shell(r, mu, sine, top), 0.0)
            asked = self.geometry.optical_length(lines.r, lines.mu, inside, length)
            blocked = blocked & (asked > length * (1.0 + 1e-12))
            length = np.minimum(length, asked)
        drawn = self.geometry.medium
        depth = columns(lines.r, lines.mu, length, drawn.bottom_radius, drawn.density)
        if air_mass is not None:
            if distance is not None:
                raise ParameterError("distance", distance, "none with an air mass")
            replace_air_mass(depth, air_mass, arrays[0], arrays[1], self.medium)
        values = self._over_bands(np.exp(-(depth @ drawn.extinction)))
        values[blocked] = 0.0
        return self._labelled(values, axes, "transmittance", "1")

    def irradiance(
        self,
        *,
        altitude: Measures,
        sun_zenith: Measures,
        latitude: Measures | None = None,
        sun_azimuth: Measures | None = None,
    ) -> xarray.Dataset:
        """Downward horizontal irradiance, direct and diffuse.

        Arguments broadcast as those of ``radiance``.

        Parameters
        ----------
        altitude : array
            Altitude, 0 to the top of the shell. [m]
        sun_zenith : array
            Solar zenith angle, 0 to 180. [deg]
        latitude, sun_azimuth : array, optional
            As in ``radiance``; diffuse light is in the shadow that the observer is in, as it comes
            from some scale heights around. [deg]

        Returns
        -------
        xarray.Dataset
            ``direct`` and ``diffuse``, each of shape (..., wavelength); light scattered into the
            delta-M fraction of forward peaks counts as direct. [W m⁻² nm⁻¹]
        """
        placed = place_arguments(latitude, sun_azimuth)
        warn_of_rings(self.medium.rings, "irradiance", placed=bool(placed))
        thickness = self.medium.thickness
        arrays, axes = NamedAxes.of(
            altitude=Argument(altitude, 0.0, thickness, "m"),
            sun_zenith=Argument(sun_zenith, 0.0, 180.0, "deg"),
            **placed,
        )
        r = np.minimum(self.medium.bottom_radius + arrays[0], self.medium.top_radius)
        mu_s = np.cos(np.radians(arrays[1]))
        parts = {
            "direct": ("direct irradiance", self.relative_direct_irradiance(r, mu_s)),
            **self._diffuse(r, mu_s),
        }
        sun = self.lights[0].irradiance
        if placed and self.medium.rings:
            sun = sun * ring_shade_at(self.medium, r, *np.radians(arrays[1:]))[:, None]
        import xarray

        labelled = {
            name: self._labelled(values * sun, axes, words, "W m-2 nm-1")
            for name, (words, values) in parts.items()
        }
        return xarray.Dataset(labelled, attrs=self.provenance)

    def _diffuse(self, r: FloatArray, mu_s: FloatArray) -> dict[str, tuple[str, FloatArray]]:
        """Diffuse irradiance over that of the star [1], its label, and its error if known."""
        return {"diffuse": ("diffuse irradiance", self.relative_sky_irradiance(r, mu_s))}

    def _over_bands(self, values: FloatArray) -> FloatArray:
        """Values per wavelength from those of the medium of ``geometry``, shape (n, nl)."""
        return values

    def _labelled(
        self, values: NDArray[Any], axes: NamedAxes, name: str, unit: str
    ) -> xarray.DataArray:
        return axes.labelled(values, self.wavelengths, name, unit, **self.provenance)  # type: ignore[no-any-return]
