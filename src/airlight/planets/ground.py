"""Ground of a planet: albedo, reflectance law, maps."""

from __future__ import annotations

from functools import cache
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.optics.droplet_layer import THICKEST
from airlight.physics.optics.hapke import REGOLITHS, regolith
from airlight.physics.optics.reflection import LAWS, Reflection, largest_albedo, law_number
from airlight.planets.cloud_cover import mean_cover
from airlight.planets.local_ground import LocalGround
from airlight.planets.parameters import instance_of, parameters, replace
from airlight.planets.schema.field import FileTable, Wavelengths, always, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import Limits, spectral_at, spectral_limits, table_limits

FloatArray = npt.NDArray[np.float64]

#: Wind speeds over water. [m s⁻¹]
WINDS: Final = (0.5, 25.0)
#: Optical depth of full cover, whose spherical albedo is 0.6: in the middle of ISCCP's clouds of
#: medium thickness, 3.6 to 23 (Rossow & Schiffer 1999, BAMS 80, 2261). [1]
CLOUD_OPTICAL_DEPTH: Final = 14.0
#: Altitude of the layer: ISCCP's middle clouds have their tops at 680 to 440 hPa, which is 3.2 to
#: 6.5 km in the standard atmosphere. [m]
CLOUD_ALTITUDE: Final = 4000.0


@cache
def reflectances() -> tuple[str, ...]:
    """Names of the reflectance tables in the package."""
    from airlight.physics.spectra.tables import read_spectrum, spectrum_names

    tables = [read_spectrum(name) for name in spectrum_names()]
    return tuple(one.name for one in tables if one.unit == "1" and one.values.ndim == 1)


def _read_albedo(table: TomlTable, name: str, wavelengths: Wavelengths) -> Any:
    """Read an albedo: a number, a list, or the name of a table."""
    given = table.raw(name)
    if isinstance(given, str) and given[:1].isalpha():
        return given
    return table.spectral(name, "1", "0.1", wavelengths)


def _clouded(table: FileTable) -> bool:
    """Whether an editor shows the key: for a table with clouds."""
    return "clouds" in table or "clouds_from_space" in table


def _of_regolith(table: FileTable) -> bool:
    """Whether an editor shows the key: for Hapke's law."""
    return table.get("law") == "hapke"


@parameters
class Ground(TomlModel):
    """Ground: albedo and reflectance law.

    Parameters
    ----------
    albedo : float, PerWavelength or str
        Albedo, 0 to 1, or the name of a table. [1]
    map : str, optional
        Name of a picture of the ground, for rendering and ``airlight.local_ground``; otherwise
        solvers use ``albedo``.
    deck : str, optional
        Name or path of a picture of a cloud deck, belts and zones, which pictures alone show.
    lights : str, optional
        Name of a picture of city lights, which light the air in pictures alone.
    clouds : str, optional
        Name or path of a picture of cloud cover, a thin layer above the ground.
    clouds_from_space : str, optional
        Name or path of a picture of cloud cover that only pictures of detailed ground show, from
        above; without effect if ``clouds`` is given.
    relief : str, optional
        Name or path of a picture of heights, which shade detailed ground.
    rocks : float
        Share of bare detailed ground below rocks, 0 to 0.2. [1]
    craters : float
        Craters of detailed ground wider than D per area D², 0 to 0.3. [1]
    cloud_optical_depth : float
        Optical depth of complete cloud cover, 0 to 1000. [1]
    cloud_altitude : float
        Altitude of the layer, 0 to 100 km. [m]
    brightness : float
        Factor of albedo and picture, 0 to 100, limited to the largest albedo of the law. [1]
    law : str
        Name from ``optics.reflection.LAWS``: ``lambert``, ``lommel-seeliger`` for dark
        porous ground, ``water`` for the open sea, ``hapke`` for regolith.
    regolith : str
        Name from ``optics.hapke.REGOLITHS``: published grains and roughness for Hapke's law.
    grain_albedo, grain_lobe, grain_backward, surge, surge_width, roughness : float, optional
        Parameters of Hapke's law that replace the published ones, see ``optics.hapke.Regolith``;
        roughness in degrees.
    wind : float, optional
        Wind speed over water, 0.5 to 25. If given, the water of a map is specular; otherwise only
        the law ``water`` is, at 5 m/s. [m s⁻¹]

    Examples
    --------
    >>> Ground(albedo=0.3).albedos([440.0, 680.0])
    array([0.3, 0.3])
    """

    has_wavelengths = True

    albedo: Any = key(
        help="Albedo under a uniform sky.",
        note="A number, a list beside `wavelengths`, or the name of a table of reflectances."
        " With a map it is the mean over the planet.",
        range=(0.0, 1.0),
        spectral=True,
        read=_read_albedo,
        required=True,
        choices=reflectances,
        synonyms=("ground brightness", "reflectance", "colour", "color", "snow", "sand"),
        default=0.0,
    )
    map: str | None = key(
        help="Name of the map of the ground, or path of a picture of it.",
        note="`earth`, or a picture of the whole sphere, twice as wide as high, north up,"
        " 180° W on the left, of up to 200 million pixels, floats from 0 to 1; a grey one"
        " beside it whose name ends in `-water.png` has the share of water. Used where the"
        " ground is seen; the air has the albedo, in pictures times the map's mean around"
        " the observer over that of the whole map.",
        range=(1.0, 100.0),
        example="the name of a map of the ground",
        default=None,
    )
    deck: str | None = key(
        help="Name of a map of a cloud deck, or path of a picture of it: belts and zones.",
        note="`jupiter`, `saturn`, or a picture as for the map. In pictures the light of lines of"
        " sight that meet the deck from above is multiplied by it, over its mean over the full"
        " disc; radiances and spectra have the mean. Instead of `map`.",
        range=(1.0, 100.0),
        example="the name of a map of a cloud deck",
        synonyms=("belts", "zones", "bands", "cloud tops"),
        default=None,
    )
    lights: str | None = key(
        help="Name of a map of city lights, or path of a picture of them.",
        note="`earth`, or a picture as for the map, white for the brightest towns,"
        " 0.2 cd/m²; seen through the air by night; they light it in pictures, not in radiances.",
        range=(1.0, 100.0),
        example="the name of a map of lights",
        default=None,
    )
    clouds: str | None = key(
        help="Name of a map of cloud cover, or path of a picture of it: a thin layer with shadows.",
        note="`earth`, or a picture as for the map, black for clear sky, white for full cover."
        " Seen from above the layer; the air has the mean of ground and clouds below it,"
        " in pictures around the observer.",
        range=(1.0, 100.0),
        example="the path of a picture of clouds",
        synonyms=("cloud map", "weather"),
        default=None,
    )
    clouds_from_space: str | None = key(
        help="Name of a map of cloud cover, or path of a picture of it, shown from above 100 km.",
        note="As `clouds`, but only seen: in pictures of detailed ground, fully from 100 km up,"
        " fading to none at 60 km; radiances and solvers have clear sky. Ignored beside"
        " `clouds`.",
        range=(1.0, 100.0),
        example="the name of a map of clouds",
        synonyms=("weather",),
        default=None,
    )
    relief: str | None = key(
        help="Name of a map of heights, or path of a picture of them, which shades the ground.",
        note="`earth`, or a picture as for the map, black for sea level, white for 6400 m."
        " Slopes and shadows in sunlight on detailed ground: decoration of pictures.",
        range=(1.0, 100.0),
        example="the name of a map of heights",
        synonyms=("terrain", "mountains", "elevation"),
        default=None,
    )
    rocks: float = key(
        help="Share of bare ground below rocks, in pictures of detailed ground.",
        note="Decoration: their sizes follow Golombek and Rapp (1997) for this share.",
        range=(0.0, 0.2),
        synonyms=("stones", "boulders"),
        default=0.0,
    )
    craters: float = key(
        help="Craters wider than D per area D², in pictures of detailed ground.",
        note="Decoration: equilibrium below 0.3 to 20 km; 0.079 on the lunar maria (Trask 1966).",
        range=(0.0, 0.3),
        synonyms=("impacts", "moon"),
        default=0.0,
    )
    cloud_optical_depth: float = key(
        label="optical depth of clouds",
        help="Optical depth of complete cloud cover, of droplets of water.",
        note="At 550 nm. 14: a spherical albedo of 0.6; 5, 0.37; 50, 0.84.",
        range=(0.0, THICKEST),
        slider=(0.0, 100.0),
        offered=_clouded,
        default=CLOUD_OPTICAL_DEPTH,
    )
    cloud_altitude: float = key(
        label="altitude of clouds",
        help="Altitude of the cloud layer, which displaces its shadows.",
        unit="m",
        range=(0.0, 1e5),
        example="4 km",
        shown="km",
        slider=(0.0, 20.0),
        offered=_clouded,
        default=CLOUD_ALTITUDE,
    )
    brightness: float = key(
        help="Factor applied to the ground's albedo and to its map.",
        note="Albedos are limited to 1, by Lommel and Seeliger's law to 0.409.",
        range=(0.0, 100.0),
        slider=(0.0, 5.0),
        offered=always,
        default=1.0,
    )
    law: str = key(
        label="law of reflection",
        help="Reflectance law: Lambertian, porous rock, water, or regolith.",
        note="By Lommel and Seeliger's law the full disc of an airless body is as bright at its"
        " limb as in its middle; `water` mirrors, and its albedo is of the light from below;"
        " `hapke` is rough regolith with an opposition surge.",
        choices=lambda: tuple(LAWS),
        offered=always,
        default="lambert",
    )
    wind: float | None = key(
        label="wind over water",
        help="Wind speed, which determines the roughness of water.",
        note="With it the water of a map mirrors; without it only the law `water` does, at"
        " 5 m/s. Slopes by Cox and Munk (1954).",
        unit="m/s",
        range=WINDS,
        example="5 m/s",
        slider=(0.5, 15.0),
        offered=always,
        default=None,
    )

    regolith: str = key(
        help="Published grains and roughness for Hapke's law.",
        note="`moon`: Sato et al. (2014); `mars`: Vincendon (2013); `triton`: Hillier et al."
        " (1994). The keys below replace single values; the albedo sets level and colour at all"
        " wavelengths.",
        choices=lambda: tuple(REGOLITHS),
        offered=_of_regolith,
        default="moon",
    )
    grain_albedo: float | None = key(
        help="Single-scattering albedo w of a grain, for Hapke's law.",
        note="The share of light that is scattered several times grows with it.",
        range=(0.01, 1.0),
        offered=_of_regolith,
        default=None,
    )
    grain_lobe: float | None = key(
        help="Asymmetry b of both lobes of a grain's phase function, for Hapke's law.",
        range=(0.0, 0.9),
        offered=_of_regolith,
        default=None,
    )
    grain_backward: float | None = key(
        help="Excess c of a grain's backward lobe, whose share is (1 + c)/2, for Hapke's law.",
        range=(-1.0, 1.0),
        offered=_of_regolith,
        default=None,
    )
    surge: float | None = key(
        help="Amplitude B0 of the opposition surge, for Hapke's law.",
        range=(0.0, 5.0),
        offered=_of_regolith,
        default=None,
    )
    surge_width: float | None = key(
        help="Angular width h of the opposition surge, for Hapke's law.",
        range=(0.005, 1.0),
        offered=_of_regolith,
        default=None,
    )
    roughness: float | None = key(
        help="Mean slope angle of rough ground, for Hapke's law.",
        unit="deg",
        range=(0.0, 45.0),
        example="23.4 deg",
        offered=_of_regolith,
        default=None,
    )

    local: Annotated[LocalGround | None, instance_of(LocalGround, type(None))] = None

    def __post_init__(self) -> None:
        if self.deck is not None and self.map is not None:
            raise ParameterError("deck", self.deck, "one of deck and map")

    @property
    def limits(self) -> Limits:
        """Wavelength range of the albedo. [nm]"""
        if isinstance(self.albedo, str):
            return table_limits(self.albedo)
        return spectral_limits(self.albedo)

    def albedos(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Albedo at wavelengths [nm], shape (nl,). [1]"""
        if isinstance(self.albedo, str):
            from airlight.physics.spectra.tables import read_spectrum

            known = read_spectrum(self.albedo).at(wavelengths)
        else:
            known = spectral_at(self.albedo, wavelengths)
        if self.local is not None:
            mirrors = self.map is not None and self.law != "water"
            known = known * self.local.ratio(wavelengths, self.wind if mirrors else None)
        return np.clip(self.brightness * known, 0.0, largest_albedo(self._clear))

    @property
    def reflection(self) -> Reflection:
        """Reflectance law with its parameters, for an albedo of 1."""
        if self.clouds is None:
            return self._clear
        cover = mean_cover(self.clouds) if self.local is None else self.local.here.cover
        return self._clear._replace(cover=cover, cloud_optical_depth=self.cloud_optical_depth)

    @property
    def _clear(self) -> Reflection:
        """Reflection without clouds."""
        wet = self.law == "water" or (self.map is not None and self.wind is not None)
        clear = Reflection(1.0, law_number(self.law), wet)
        if self.law == "hapke":
            clear = clear._replace(regolith=regolith(*self._grains))
        return clear if self.wind is None else clear._replace(wind=self.wind)

    @property
    def _grains(self) -> tuple[float, ...]:
        """Arguments of ``optics.hapke.regolith``."""
        given = (
            self.grain_albedo,
            self.grain_lobe,
            self.grain_backward,
            self.surge,
            self.surge_width,
            self.roughness,
        )
        published = REGOLITHS[self.regolith]
        return tuple(
            known if own is None else own for own, known in zip(given, published, strict=True)
        )

    def local_line(self, wavelength: float) -> str:
        """Line of a report about the local ground; empty for the mean ground of the planet.

        Parameters
        ----------
        wavelength : float
            Wavelength of the albedos. [nm]
        """
        if self.local is None:
            return ""
        here, all_of_it = (
            float(one.albedos([wavelength])[0]) for one in (self, replace(self, local=None))
        )
        clouds = f", cover of clouds {self.local.here.cover:.3g}" if self.clouds else ""
        return (
            f"ground of {self.local}: albedo {here:.3g} at {wavelength:.4g} nm, "
            f"planet {all_of_it:.3g}{clouds}"
        )
