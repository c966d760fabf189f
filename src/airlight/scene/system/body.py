"""Body of a scene: planet with an atmosphere, or airless sphere."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.geometry.ephemeris.positions import BODIES
from airlight.geometry.sun_disc import mean_incidence
from airlight.kernel import vectorized
from airlight.physics.optics.bare_surface import albedo_unit, law_number, surface_factor
from airlight.physics.optics.moon_phase import (
    lambert_phase,
    lommel_seeliger_phase,
    moon_albedo,
    moon_phase,
)
from airlight.physics.units import values_in
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.spectral import Spectral, spectral_at
from airlight.scene.system.vectors import POSITION, frame_of, unit

FloatArray = npt.NDArray[np.float64]

#: Laws by which a body without air reflects, with the phase functions of whole spheres.
LAWS: Final = {
    "lambert": lambert_phase,
    "lommel-seeliger": lommel_seeliger_phase,
    "moon": moon_phase,
}


@parameters
class Body(TomlModel):
    """Spherical body, with the atmosphere of a planet file or airless.

    Parameters
    ----------
    name : str
        Name by which lights, observer and camera refer to it.
    planet : str, optional
        Preset or planet file with its ground and atmosphere.
    radius : float, optional
        Radius, required for an airless body. [m]
    albedo : float or PerWavelength, optional
        Albedo of an airless body: that of a Lambert surface, or the geometric albedo for other
        reflectance laws; by default the Moon's for ``moon``, otherwise 0.1. [1]
    reflection : str
        ``lambert``; ``lommel-seeliger``, dark dust; ``moon``, Hapke's law for the Moon's regolith,
        with its opposition surge.
    map : str, optional
        ``moon``, or an image of the surface, whose colours, normalised to mean 1, multiply the
        albedo.
    position : tuple of float
        Centre in the frame of the scene. [m]
    pole : tuple of float
        Direction of the north pole.
    prime_meridian : float
        Angle of the prime meridian from the ascending node of the equator on the frame's xy plane,
        eastward, as the IAU counts it. [deg]
    ephemeris : str, optional
        Body of the solar system that determines position, pole and prime meridian at the time of
        the scene file; see ``airlight.geometry.ephemeris.positions``.
    faces : str, optional
        Name of the body above the prime meridian, an alternative to ``prime_meridian``.
    """

    has_wavelengths = True

    name: str = key(
        label="name",
        help="Name in references of the scene.",
        kind="text",
        range=(1, 60),
        example="moon",
    )
    planet: str | None = key(
        label="planet",
        help="Preset or planet file; none if airless.",
        kind="text",
        range=(1, 4000),
        example="earth",
        default=None,
    )
    radius: float | None = key(
        label="radius",
        help="Radius of an airless body.",
        unit="m",
        range=(1.0, 1e10),
        example="1737.4 km",
        default=None,
    )
    albedo: Spectral | None = key(
        label="albedo",
        help="Albedo of an airless body; geometric except for Lambert's law.",
        range=(0.0, 1.0),
        spectral=True,
        example="0.12",
        default=None,
    )
    reflection: str = key(
        label="reflection",
        help="Reflectance law of an airless body.",
        kind="choice",
        choices=lambda: tuple(LAWS),
        default="lommel-seeliger",
    )
    map: str | None = key(
        label="map",
        help="Map of the surface of an airless body: moon, mars, or a picture.",
        kind="text",
        range=(1, 4000),
        example="moon.jpg",
        default=None,
    )
    position: tuple[float, ...] = key(POSITION, default=(0.0, 0.0, 0.0))
    pole: tuple[float, ...] = key(
        label="pole",
        help="Direction of the north pole.",
        range=(-1e6, 1e6),
        listed=True,
        example="[0, 0, 1]",
        default=(0.0, 0.0, 1.0),
    )
    prime_meridian: float = key(
        label="prime meridian",
        help="Angle from the equator's ascending node, eastward.",
        unit="deg",
        range=(-360.0, 360.0),
        example="30 deg",
        default=0.0,
    )
    ephemeris: str | None = key(
        label="ephemeris",
        help="Body of the solar system with this position and rotation at the scene's time.",
        kind="choice",
        choices=lambda: tuple(name for name in BODIES if name != "sun"),
        default=None,
    )
    faces: str | None = key(
        label="faces",
        help="Body above the prime meridian.",
        kind="text",
        range=(1, 60),
        example="earth",
        default=None,
    )

    def __post_init__(self) -> None:
        unit(self.pole, "pole")
        if len(self.position) != 3:
            raise ParameterError("position", self.position, "three lengths")
        if self.planet is None:
            if self.radius is None:
                raise ParameterError("radius", MISSING, "a length, for an airless body")
        else:
            for name in ("radius", "albedo", "map"):
                if getattr(self, name) is not None:
                    raise ConflictError(name, "cannot be combined with planet")
        if self.ephemeris is not None:
            for name, plain in (
                ("position", (0.0, 0.0, 0.0)),
                ("pole", (0.0, 0.0, 1.0)),
                ("prime_meridian", 0.0),
                ("faces", None),
            ):
                if getattr(self, name) != plain:
                    raise ConflictError(name, "cannot be combined with ephemeris")
        if self.faces is not None and self.prime_meridian != 0.0:
            raise ConflictError("prime_meridian", "cannot be combined with faces")

    @property
    def centre(self) -> FloatArray:
        """Position of the centre, shape (3,). [m]"""
        return np.asarray(self.position, float)

    def albedos(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Albedo at each wavelength, shape (nl,). [1]"""
        nm = values_in(wavelengths, "nm", "wavelengths")
        if self.albedo is not None:
            return spectral_at(self.albedo, nm)
        if self.reflection == "moon":
            return moon_albedo(nm)
        return np.full(nm.shape, 0.1)

    def brightness(self, wavelengths: npt.ArrayLike, phase: float) -> FloatArray:
        """Geometric albedo times phase function of an airless body, shape (nl,). [1]

        Parameters
        ----------
        wavelengths : array, shape (nl,)
            Wavelengths. [nm]
        phase : float
            Phase angle. [deg]
        """
        share = 2.0 / 3.0 if self.reflection == "lambert" else 1.0
        return self.albedos(wavelengths) * share * float(LAWS[self.reflection](phase))

    def surface_factor(
        self,
        normal: FloatArray,
        to_light: FloatArray,
        to_eye: FloatArray,
        angular_radius: FloatArray,
        leaving: FloatArray | None = None,
    ) -> FloatArray:
        """Radiance reflected by an airless body over irradiance and albedo. [sr⁻¹]

        Parameters
        ----------
        normal, to_light, to_eye : array, shape (n, 3)
            Unit vectors: of the surface, towards the light, and towards the observer.
        angular_radius : array, shape (n,)
            Angular radius of the light; its disc sets gradually. [rad]
        leaving : array, shape (n,), optional
            Cosine of emergence from a slope, by default from the surface. [1]

        Returns
        -------
        array, shape (n,)
            Factor, to be multiplied by ``Body.albedo``.
        """
        sine, level, cosine = (
            np.einsum("nk,nk->n", one, other)
            for one, other in ((normal, to_light), (normal, to_eye), (to_light, to_eye))
        )
        if leaving is None:
            leaving = np.maximum(level, 0.0)
        lit = np.asarray(vectorized(mean_incidence)(sine, angular_radius))
        number = law_number(self.reflection)
        factor = vectorized(surface_factor)(number, lit, leaving, cosine)
        return np.where(lit > 0.0, factor, 0.0) / albedo_unit(self.reflection)

    def axes(self, faced: FloatArray | None) -> FloatArray:
        """Axes of the body-fixed frame as rows, shape (3, 3). [1]

        Parameters
        ----------
        faced : array, shape (3,), or None
            Centre of the body named by ``faces``. [m]
        """
        if faced is None:
            return frame_of(np.asarray(self.pole, float), self.prime_meridian)
        north = unit(self.pole, "pole")
        across = np.cross(north, faced - self.centre)
        if not np.linalg.norm(across) > 0.0:
            raise ParameterError("faces", self.faces, "a body that is not above the pole")
        east = across / np.linalg.norm(across)
        return np.stack([np.cross(east, north), east, north])
