"""Medium: a planet sampled at wavelengths, as plain arrays that kernels can read."""

from __future__ import annotations

import dataclasses
import hashlib
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.image.upsampling import reflectance_basis
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.optics.density_profile import DensitySegments
from airlight.physics.optics.effective_top import effective_top
from airlight.physics.optics.layer_edges import ThinLayer, thin_layers
from airlight.physics.optics.reflection import WHITE, Reflection
from airlight.physics.optics.refracting_shell import RefractingShell
from airlight.physics.units import values_in
from airlight.planets.constituent import Constituent
from airlight.planets.light_source import LightSource
from airlight.planets.matter.phases import INTEGRAL_TOLERANCE
from airlight.planets.matter.profiles import Uniform
from airlight.planets.refractivities import refractivities
from airlight.planets.spectral import check_wavelength_list
from airlight.planets.surface import PLAIN, Surface
from airlight.planets.without_clouds import check_clear

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.planets.rings import Ring

FloatArray = npt.NDArray[np.float64]

#: Nodes of the phase tables in u = sin(θ/2), both ends included.
PHASE_NODES: Final = 4097
#: Largest vertical optical depth of one constituent.
LARGEST_OPTICAL_DEPTH: Final = 1e4
#: Name of the constituent whose column is proportional to the refraction angle.
REFRACTION_COLUMN: Final = "refraction"
#: Largest number of wavelengths of one medium.
MOST_WAVELENGTHS: Final = 2000
#: Largest number of wavelengths of a medium that a planet keeps.
MOST_KEPT_WAVELENGTHS: Final = 64


@dataclass(frozen=True, eq=False, kw_only=True)
class Medium:
    """Optical properties of a planet at ``nl`` wavelengths, with ``nc`` constituents.

    Parameters
    ----------
    bottom_radius, top_radius : float
        Radii of the ground and of the top of the atmosphere, see ``effective_top``. [m]
    wavelengths : array, shape (nl,)
        Wavelengths in the order given, repeated for terms of a band. [nm]
    names : tuple of str, length nc
        Names of the constituents.
    scattering, absorption : array, shape (nc, nl)
        Coefficients at relative density 1. [m⁻¹]
    density : DensitySegments
        Relative densities over altitude.
    phase_table : array, shape (nc, nl, 4097)
        Phase functions on the uniform grid u = sin(θ/2) in [0, 1], nu = 1 - 2u²; zero for a
        constituent that does not scatter. [sr⁻¹]
    ground_albedo : array, shape (nl,)
        Albedo of the ground, without its clouds. [1]
    solar_irradiance : array, shape (nl,)
        Irradiance at the planet, on a plane that faces the star. [W m⁻² nm⁻¹]
    star_angular_radius : float
        Angular radius of the star. [rad]
    refractivity : array, shape (nc,)
        n - 1 of each constituent at relative density 1, at 550 nm or the nearest possible
        wavelength; zero without refraction. Dispersion, 3 % over the visible for the Earth, is
        neglected. [1]
    constituents : tuple of Constituent
        Constituents from which the arrays were sampled.
    surface : Surface
        Appearance of the ground in pictures, without effect on a solution or the fingerprint.
    resolve_layers : bool
        Whether grids resolve layers aloft of any width, not only thin ones.
    reflection : Reflection
        Reflectance law of the ground, for an albedo of 1.
    rings : tuple of Ring
        Rings, without effect on a solution or the fingerprint.
    flattening : float
        Flattening in pictures from outside the air, without effect on a solution. [1]

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> medium = Medium.from_planet(load_planet("earth-atmosphere-plus"), [680, 550, 440])
    >>> medium.vertical_optical_depth.round(4).tolist()[0]  # 8 km (1 - exp(-12.5)) of air
    [0.0464, 0.1085, 0.2648]
    """

    bottom_radius: float
    top_radius: float
    wavelengths: FloatArray
    names: tuple[str, ...]
    scattering: FloatArray
    absorption: FloatArray
    density: DensitySegments
    phase_table: FloatArray
    ground_albedo: FloatArray
    solar_irradiance: FloatArray
    star_angular_radius: float
    refractivity: FloatArray
    constituents: tuple[Constituent, ...] = field(repr=False)
    surface: Surface = PLAIN
    resolve_layers: bool = False
    reflection: Reflection = WHITE
    rings: tuple[Ring, ...] = ()
    flattening: float = 0.0

    def __post_init__(self) -> None:
        self._freeze()

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._freeze()

    def _freeze(self) -> None:
        """Make the arrays read-only, which gives Numba a single array type."""
        for array in self._arrays().values():
            array.flags.writeable = False

    def __repr__(self) -> str:
        nm = self.wavelengths
        span = f"{nm.min():g} to {nm.max():g} nm" if nm.size > 1 else f"{nm[0]:g} nm"
        return f"<Medium of {', '.join(self.names)} at {span}, {nm.size} wavelengths>"

    @property
    def lights(self) -> tuple[LightSource, ...]:
        """Light sources at the wavelengths of the medium."""
        radius, nm, light = self.star_angular_radius, self.wavelengths, self.solar_irradiance
        return (LightSource(name="star", angular_radius=radius, wavelengths=nm, irradiance=light),)

    def with_light(self, source: LightSource) -> Medium:
        """Medium under another light source at the same wavelengths."""
        light, radius = source.irradiance, source.angular_radius
        return dataclasses.replace(self, solar_irradiance=light, star_angular_radius=radius)

    @property
    def ground(self) -> Reflection:
        """Reflection by the ground, at all wavelengths, with the layer of clouds that are seen."""
        layer = self.surface.layer(self.wavelengths)
        return self.reflection._replace(albedo=self.ground_albedo, layer=layer)

    @classmethod
    def from_planet(
        cls,
        planet: Planet,
        wavelengths: npt.ArrayLike,
        *,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Medium:
        """Medium of a planet at some wavelengths, cached with the planet.

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths within ``planet.wavelength_limits``. [nm]
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``; Mie computations take seconds.

        Raises
        ------
        ParameterError
            If a wavelength is out of range, a constituent is unphysical, or the planet has
            three-dimensional clouds: those who compute them take ``planet.without_clouds``.
        FileError
            If the picture of its clouds cannot be read.
        Cancelled
            If ``cancel`` returned True.
        """
        from airlight.planets.planet import Planet

        if not isinstance(planet, Planet):
            raise ParameterError("planet", planet, "a Planet, as load_planet returns it")
        check_clear(planet)
        nm = _checked_wavelengths(planet, wavelengths)
        make = partial(cls._sampled, planet, nm, progress=progress, cancel=cancel)
        if nm.size > MOST_KEPT_WAVELENGTHS:
            return make()
        medium: Medium = planet.media.of(nm.tobytes(), make)
        return medium

    @classmethod
    def _sampled(
        cls, planet: Planet, nm: FloatArray, *, progress: Progress | None, cancel: Cancel | None
    ) -> Medium:
        for i, one in enumerate(planet.constituents):
            if one.matter is not None:
                try:
                    one.matter.prepare(nm, progress=progress, cancel=cancel)
                except ParameterError as error:
                    raise error.named(f"constituents[{i}].{error.field}") from None
        density = planet.relative_densities
        height = effective_top(density)
        if height < planet.thickness:
            density = density.below(height)
        nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, PHASE_NODES) ** 2
        constituents, lights = planet.constituents, planet.lights(nm)
        if len(lights) != 1:
            raise ParameterError("lights", len(lights), "1: a planet is solved for a single star")
        light = lights[0]
        medium = cls(
            bottom_radius=planet.bottom_radius,
            top_radius=min(planet.bottom_radius + height, planet.top_radius),
            wavelengths=nm,
            names=tuple(one.name for one in constituents),
            scattering=np.stack(
                [one.scattering_coefficients(nm, planet.thickness) for one in constituents]
            ),
            absorption=np.stack(
                [one.absorption_coefficients(nm, planet.thickness) for one in constituents]
            ),
            density=density,
            phase_table=np.stack([one.phase_values(nu, nm).T for one in constituents]),
            ground_albedo=planet.ground.albedos(nm),
            solar_irradiance=light.irradiance,
            star_angular_radius=light.angular_radius,
            refractivity=refractivities(planet),
            constituents=constituents,
            surface=Surface.of(planet.ground, planet.airglow),
            reflection=planet.ground.reflection,
            rings=planet.rings,
            flattening=planet.flattening,
        )
        medium._check()
        _ = medium.refracting_shell  # raises an error if rays would be ducted
        return medium

    @property
    def map_basis(self) -> FloatArray:
        """Reflectances of red, green and blue of the ground's picture, shape (nl, 3). [1]"""
        return self.surface.brightness * reflectance_basis(self.wavelengths)

    @property
    def thickness(self) -> float:
        """Height of the shell. [m]"""
        return self.top_radius - self.bottom_radius

    @cached_property
    def columns(self) -> FloatArray:
        """Vertical column of each constituent, ∫ relative density dh, shape (nc,). [m]"""
        return self.density.columns

    @cached_property
    def thin_layers(self) -> tuple[ThinLayer, ...]:
        """Layers that are thin compared with the shell, see ``physics.optics.layer_edges``."""
        strongest = self.scattering.max(axis=1), self.absorption.max(axis=1)
        widest = 1.0 if self.resolve_layers else None
        return tuple(thin_layers(self.density, *strongest, widest=widest))

    @cached_property
    def refracting_shell(self) -> RefractingShell | None:
        """Shell by optical radius, or None without refraction."""
        if not self.refractivity.any():
            return None
        return RefractingShell.build(
            self.density, self.refractivity, self.bottom_radius, self.top_radius
        )

    def in_optical_radius(self) -> Medium:
        """Medium in the optical radius, in which rays are straight; itself without refraction.

        An additional constituent is the refraction column, which neither scatters nor absorbs; see
        ``physics.optics.refracting_shell``.
        """
        shell = self.refracting_shell
        if shell is None:
            return self
        nothing = np.zeros((1, self.wavelengths.size))
        phases = np.zeros((1, *self.phase_table.shape[1:]))
        return dataclasses.replace(
            self,
            bottom_radius=shell.bottom,
            top_radius=shell.top,
            names=(*self.names, REFRACTION_COLUMN),
            scattering=np.concatenate([self.scattering, nothing]),
            absorption=np.concatenate([self.absorption, nothing]),
            density=shell.density,
            phase_table=np.concatenate([self.phase_table, phases]),
            refractivity=np.zeros(len(self.names) + 1),
            constituents=(
                *self.constituents,
                Constituent(name=REFRACTION_COLUMN, profile=Uniform()),
            ),
        )

    @property
    def extinction(self) -> FloatArray:
        """Scattering + absorption at relative density 1, shape (nc, nl). [m⁻¹]"""
        return self.scattering + self.absorption

    @property
    def vertical_optical_depth(self) -> FloatArray:
        """Vertical optical depth, shape (nc, nl). [1]"""
        return self.extinction * self.columns[:, None]

    @property
    def single_scattering_albedo(self) -> FloatArray:
        """Scattering / extinction, shape (nc, nl); 0 where there is no extinction. [1]"""
        extinction = self.extinction
        return np.divide(
            self.scattering, extinction, out=np.zeros_like(extinction), where=extinction > 0.0
        )

    def phase_function(self, nu: npt.ArrayLike) -> FloatArray:
        """Exact phase functions, not interpolated in the table.

        Parameters
        ----------
        nu : array, shape (...)
            Cosine of the scattering angle. [1]

        Returns
        -------
        array, shape (..., nc, nl)
            Phase functions. [sr⁻¹]
        """
        nm, back = self._distinct
        found = [one.phase_values(nu, nm) for one in self.constituents]
        return np.stack(found, axis=-2)[..., back]

    def phase_f12(self, nu: npt.ArrayLike) -> FloatArray:
        """Elements F₁₂ of the phase matrices.

        Negative where light is polarised normal to the scattering plane; arguments and shape are
        those of ``phase_function``. [sr⁻¹]
        """
        nm, back = self._distinct
        found = [one.polarising_values(nu, nm) for one in self.constituents]
        return np.stack(found, axis=-2)[..., back]

    def polarising_moments(self) -> FloatArray:
        """Expansion coefficients of the phase matrix, see ``PhaseFunction``, (nc, nl, 3). [1]"""
        nm, back = self._distinct
        return np.stack([one.polarising_moments(nm)[back] for one in self.constituents])

    def phase_moments(self, degree: int) -> FloatArray:
        """Legendre moments g_l of the phase functions; see ``physics.optics.legendre``.

        Parameters
        ----------
        degree : int
            Highest degree l.

        Returns
        -------
        array, shape (nc, nl, degree + 1)
            Moments; zero for a constituent that does not scatter. [1]
        """
        moments = self._moments(degree)
        # A table's integral is 1 within INTEGRAL_TOLERANCE; the division conserves energy exactly.
        scatters = moments[..., :1] > 0.0
        return np.divide(moments, moments[..., :1], out=np.zeros_like(moments), where=scatters)

    def _moments(self, degree: int) -> FloatArray:
        """Legendre moments as integrated, g_0 not set to 1; shape (nc, nl, degree + 1). [1]"""
        nm, back = self._distinct
        return np.stack([one.phase_moments(nm, degree)[back] for one in self.constituents])

    @cached_property
    def _distinct(self) -> tuple[FloatArray, npt.NDArray[np.intp]]:
        """Each wavelength once [nm], and the index of every one of the medium's in them."""
        return np.unique(self.wavelengths, return_inverse=True)

    def fingerprint(self) -> str:
        """SHA-256 of everything that a solution depends on.

        Examples
        --------
        >>> from airlight.planets import load_planet
        >>> earth = load_planet("earth-atmosphere-plus")
        >>> red, green = (Medium.from_planet(earth, [nm]).fingerprint() for nm in (680, 550))
        >>> red == green
        False
        """
        digest = hashlib.sha256(b"airlight medium 3\n")
        scalars = (self.bottom_radius, self.top_radius, self.star_angular_radius)
        law = {name: one for name, one in self.reflection._asdict().items() if name != "layer"}
        digest.update(repr((scalars, self.names, tuple(law.values()))).encode())
        for name, array in self._arrays().items():
            digest.update(f"{name} {array.shape}\n".encode())
            digest.update(np.ascontiguousarray(array, dtype="<f8").tobytes())
        return digest.hexdigest()

    def _arrays(self) -> dict[str, FloatArray]:
        return {
            "wavelengths": self.wavelengths,
            "scattering": self.scattering,
            "absorption": self.absorption,
            "density edges": self.density.edges,
            "density coefficients": self.density.coefficients,
            "phase table": self.phase_table,
            "ground albedo": self.ground_albedo,
            "solar irradiance": self.solar_irradiance,
            "refractivity": self.refractivity,
        }

    def _check(self) -> None:
        """Raise an error for values that are NaN or unphysical."""
        for name, array in self._arrays().items():
            if not np.isfinite(array).all():
                raise ParameterError(name, float(array[~np.isfinite(array)][0]), "finite numbers")
        for name, array in (("scattering", self.scattering), ("absorption", self.absorption)):
            if (array < 0.0).any():
                raise ParameterError(name, float(array.min()), "0 or more, in /m")
        depths = self.vertical_optical_depth
        integrals = self._moments(0)[..., 0]
        for i, one in enumerate(self.constituents):
            where = f"constituents[{i}]"
            if not depths[i].max() <= LARGEST_OPTICAL_DEPTH:
                raise ParameterError(
                    f"vertical optical depth of {where}",
                    float(depths[i].max()),
                    f"at most {LARGEST_OPTICAL_DEPTH:g}",
                )
            off = np.abs(integrals[i] - 1.0)
            if one.scatters and not off.max() <= INTEGRAL_TOLERANCE:
                raise ParameterError(
                    f"integral of {where}.phase_function",
                    float(integrals[i][off.argmax()]),
                    f"1 within {INTEGRAL_TOLERANCE:g}",
                )


def _checked_wavelengths(planet: Planet, wavelengths: npt.ArrayLike) -> FloatArray:
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths")).copy()
    if nm.ndim != 1 or nm.size > MOST_WAVELENGTHS:
        raise ParameterError("wavelengths", nm.shape, f"a flat list of 1 to {MOST_WAVELENGTHS}")
    listed = tuple(nm.tolist())
    check_wavelength_list(listed)
    planet.check_wavelengths(listed)
    return nm
