"""Three-dimensional clouds of a planet: tables ``[[clouds]]`` of its file.

Defaults follow: heights, WMO (2017), International Cloud Atlas, section 2.2.1, and for cirrus
Sassen & Campbell (2001), JAS 58, 481; optical depths of layers, the classes of Rossow & Schiffer
(1999), BAMS 80, 2261, and of heaps, about two fifths of the water of adiabatic ascent; water
droplets, Miles, Verlinde & Clothiaux (2000), JAS 57, 295 (9.6 µm marine, 5.4 µm continental), and
the C1 cumulus of Deirmendjian (1969), Electromagnetic Scattering on Spherical Polydispersions
(6 µm, effective variance 1/9); stratocumulus, Wood (2012), MWR 140, 2373.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import ClassVar, Final

from airlight.planets.matter.state_keys import RADIUS
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, FileTable, Wavelengths, always, key
from airlight.planets.schema.tagged_union import TaggedUnion
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable

#: Largest number of kinds of clouds of a planet.
MAX_CLOUDS: Final = 8
#: Particles of clouds.
WATER, ICE = "water", "ice"

_BASE: Final = Field(
    label="base",
    help="Altitude of the base, above the ground.",
    unit="m",
    range=(0.0, 1e5),
    example="1 km",
    shown="km",
    slider=(0.0, 15.0),
    offered=always,
)
_DEPTH: Final = Field(
    label="depth",
    help="Height of the deepest clouds from base to top.",
    unit="m",
    range=(10.0, 3e4),
    example="500 m",
    shown="km",
    slider=(0.1, 10.0),
    scale="log",
    offered=always,
)
_COVER: Final = Field(
    label="cover",
    help="Share of columns with cloud.",
    range=(0.0, 1.0),
    example="0.4",
    offered=always,
    synonyms=("cloudiness", "weather", "overcast"),
)
_OPTICAL_DEPTH: Final = Field(
    label="optical depth",
    help="Mean vertical optical depth of the cloudy columns at 550 nm.",
    range=(0.0, 1e3),
    example="10",
    slider=(0.1, 100.0),
    scale="log",
    offered=always,
    synonyms=("thickness", "opacity"),
)
_CELL: Final = Field(
    label="cell size",
    help="Horizontal size: width of the largest cumuli, of cells, or between fibres.",
    unit="m",
    range=(10.0, 1e6),
    example="1.5 km",
    shown="km",
    slider=(0.1, 50.0),
    scale="log",
    offered=always,
)
_SHEAR: Final = Field(
    label="wind shear",
    help="Increase of the wind with height, which tilts clouds to the east.",
    unit="1/s",
    range=(-0.1, 0.1),
    example="0.002 /s",
    shown="/s",
    slider=(-0.02, 0.02),
    offered=always,
)
_ORGANISATION: Final = Field(
    label="organisation",
    help="Gathering of heaps in clusters and streets; 0 strews them evenly.",
    range=(0.0, 3.0),
    example="1",
    slider=(0.0, 2.0),
    offered=always,
    synonyms=("clustering",),
)
_RADIUS: Final = replace(RADIUS, help="Mean radius, weighted by area.", offered=always)
_VARIANCE: Final = Field(
    label="effective variance",
    help="Width of the gamma distribution of radii of droplets.",
    range=(0.0, 0.5),
    open_ends=True,
    example="0.1",
    slider=(0.01, 0.49),
    input_range=(1e-3, 0.499),
    mode="advanced",
    offered=always,
)
_WIND_SPEED: Final = Field(
    label="wind speed",
    help="Speed at which the clouds drift, in films.",
    unit="m/s",
    range=(0.0, 200.0),
    example="10 m/s",
    shown="m/s",
    slider=(0.0, 50.0),
    offered=always,
    synonyms=("drift",),
)
_WIND_DIRECTION: Final = Field(
    label="wind direction",
    help="Bearing from which the wind blows: 0 north, 90 east.",
    unit="deg",
    range=(-360.0, 360.0),
    example="270 deg",
    shown="deg",
    slider=(0.0, 360.0),
    offered=always,
)
_BEYOND: Final = Field(
    label="beyond",
    help="What is beyond the four sides of the field.",
    choices=lambda: ("clear", "periodic"),
    offered=always,
)
_PARTICLES: Final = Field(
    label="particles",
    help="Droplets of water by Mie theory, or crystals of ice by a bulk phase function.",
    choices=lambda: (WATER, ICE),
    offered=always,
)


@parameters
class Clouds(TomlModel):
    """Clouds of one kind, a table ``[[clouds]]``.

    Parameters
    ----------
    name : str, optional
        Name of 1 to 60 letters; the word of its kind by default.
    particles : "water" or "ice"
        Substance of the particles.
    effective_radius : float
        Area-weighted mean radius of the particles, 1e-10 to 1e-3. [m]
    effective_variance : float
        Effective variance of the gamma distribution of droplets, above 0, below 1/2. [1]
    wind_speed : float
        Speed at which the whole field drifts in films, 0 to 200. [m/s]
    wind_direction : float
        Bearing from which the wind blows, 0 north and 90 east. [deg]
    """

    name: str | None = key(
        help="Name of the clouds.",
        note="1 to 60 letters; by default the word of the kind. For `--set clouds.NAME.cover`.",
        range=(1.0, 60.0),
        example="a name of its own",
        default=None,
    )
    particles: str = key(_PARTICLES, default=WATER)
    effective_radius: float = key(_RADIUS, default=10e-6)
    effective_variance: float = key(_VARIANCE, default=1.0 / 9.0)
    wind_speed: float = key(_WIND_SPEED, default=0.0)
    wind_direction: float = key(_WIND_DIRECTION, default=270.0)

    @property
    def title(self) -> str:
        """Name, or the word of the kind."""
        return self.name or self.keyword

    def drift(self, seconds: float) -> tuple[float, float]:
        """Displacement by the wind to the east and to the north. [m]

        Parameters
        ----------
        seconds : float
            Time. [s]

        Examples
        --------
        >>> [round(one, 9) for one in Clouds(wind_speed=10.0, wind_direction=270.0).drift(3.0)]
        [30.0, 0.0]
        """
        way, bearing = -self.wind_speed * seconds, math.radians(self.wind_direction)
        return way * math.sin(bearing), way * math.cos(bearing)


@parameters
class CloudType(Clouds):
    """Generated clouds of one type.

    Parameters
    ----------
    base, depth : float
        Altitude of the base and height of the deepest clouds. [m]
    cover : float
        Share of cloudy columns, 0 to 1. [1]
    optical_depth : float
        Mean vertical optical depth of the cloudy columns at 550 nm, 0 to 1000. [1]
    cell : float
        Width of the largest cumuli, of cells, or between fibres. [m]
    shear : float
        Increase of the eastward wind with height. [s⁻¹]
    seed : float
        Number, 0 to 1e9, whose whole part selects a field of the same statistics. [1]
    beyond : "periodic" or "clear"
        What is beyond the four sides. A field that ends has no clouds that its sides would cut,
        unless they cut most.
    latitude, longitude : float, optional
        Place of the middle. [deg]
    """

    #: Width of a cell of the grid by default [m], and number of levels.
    spacing: ClassVar[float] = 200.0
    levels: ClassVar[int] = 32

    base: float = key(_BASE, default=1000.0)
    depth: float = key(_DEPTH, default=500.0)
    cover: float = key(_COVER, default=0.5)
    optical_depth: float = key(_OPTICAL_DEPTH, default=10.0)
    cell: float = key(_CELL, default=2000.0)
    shear: float = key(_SHEAR, default=0.0)
    seed: float = key(
        help="Number whose whole part selects one of many fields of the same statistics.",
        range=(0.0, 1e9),
        slider=(0.0, 100.0),
        example="1",
        offered=always,
        default=0.0,
    )
    beyond: str = key(_BEYOND, default="periodic")
    latitude: float | None = key(
        label="latitude",
        help="Latitude of the middle of the field; below the observer by default.",
        unit="deg",
        range=(-90.0, 90.0),
        example="10 deg",
        default=None,
    )
    longitude: float | None = key(
        label="longitude",
        help="Longitude of the middle of the field; below the observer by default.",
        unit="deg",
        range=(-180.0, 180.0),
        example="20 deg",
        default=None,
    )


@parameters
class Stratus(CloudType):
    """Low even layer."""

    keyword = "stratus"

    base: float = key(_BASE, default=300.0)
    depth: float = key(_DEPTH, default=400.0)
    cover: float = key(_COVER, default=1.0)
    optical_depth: float = key(_OPTICAL_DEPTH, default=23.0)
    cell: float = key(_CELL, default=6000.0)
    effective_radius: float = key(_RADIUS, default=5.4e-6)


@parameters
class Stratocumulus(CloudType):
    """Low layer of closed cells."""

    keyword = "stratocumulus"
    spacing = 100.0

    base: float = key(_BASE, default=800.0)
    depth: float = key(_DEPTH, default=320.0)
    cover: float = key(_COVER, default=0.9)
    optical_depth: float = key(_OPTICAL_DEPTH, default=10.0)
    cell: float = key(_CELL, default=3000.0)
    effective_radius: float = key(_RADIUS, default=9.6e-6)


@parameters
class CumulusHumilis(CloudType):
    """Separate heaps of fair weather.

    Parameters
    ----------
    organisation : float
        Standard deviation of the logarithm of the number density of heaps, 0 to 3. [1]
    """

    keyword = "cumulus"
    spacing = 100.0

    base: float = key(_BASE, default=1000.0)
    depth: float = key(_DEPTH, default=900.0)
    cover: float = key(_COVER, default=0.25)
    optical_depth: float = key(_OPTICAL_DEPTH, default=15.0)
    cell: float = key(_CELL, default=2000.0)
    shear: float = key(_SHEAR, default=5e-4)
    effective_radius: float = key(_RADIUS, default=6e-6)
    organisation: float = key(_ORGANISATION, default=1.6)


@parameters
class CumulusCongestus(CloudType):
    """Towering heaps.

    Parameters
    ----------
    organisation : float
        Standard deviation of the logarithm of the number density of heaps, 0 to 3. [1]
    """

    keyword = "congestus"
    spacing = 100.0

    base: float = key(_BASE, default=1000.0)
    depth: float = key(_DEPTH, default=4500.0)
    cover: float = key(_COVER, default=0.25)
    optical_depth: float = key(_OPTICAL_DEPTH, default=60.0)
    cell: float = key(_CELL, default=5000.0)
    shear: float = key(_SHEAR, default=5e-4)
    organisation: float = key(_ORGANISATION, default=1.0)


@parameters
class Cumulonimbus(CloudType):
    """Storm tower below an anvil."""

    keyword = "cumulonimbus"
    spacing = 100.0
    levels = 64

    base: float = key(_BASE, default=1000.0)
    depth: float = key(_DEPTH, default=11000.0)
    cover: float = key(_COVER, default=0.3)
    optical_depth: float = key(_OPTICAL_DEPTH, default=60.0)
    cell: float = key(_CELL, default=12000.0)
    shear: float = key(_SHEAR, default=1e-4)
    particles: str = key(_PARTICLES, default=ICE)
    effective_radius: float = key(_RADIUS, default=30e-6)
    beyond: str = key(_BEYOND, default="clear")


@parameters
class Altocumulus(CloudType):
    """Layer of small heaps and rolls at middle heights."""

    keyword = "altocumulus"
    spacing = 100.0

    base: float = key(_BASE, default=3500.0)
    depth: float = key(_DEPTH, default=300.0)
    cover: float = key(_COVER, default=0.6)
    optical_depth: float = key(_OPTICAL_DEPTH, default=3.6)
    cell: float = key(_CELL, default=800.0)


@parameters
class Cirrus(CloudType):
    """High fibres of ice with fall streaks."""

    keyword = "cirrus"
    spacing = 100.0

    base: float = key(_BASE, default=8800.0)
    depth: float = key(_DEPTH, default=1800.0)
    cover: float = key(_COVER, default=0.5)
    optical_depth: float = key(_OPTICAL_DEPTH, default=0.7)
    cell: float = key(_CELL, default=2500.0)
    shear: float = key(_SHEAR, default=5e-3)
    particles: str = key(_PARTICLES, default=ICE)
    effective_radius: float = key(_RADIUS, default=30e-6)


def _read_file(table: TomlTable, name: str, wavelengths: Wavelengths) -> str:
    return str(table.beside(table.text(name, "the path of a NetCDF or Zarr file")))


@parameters
class CloudFile(Clouds):
    """Clouds of a NetCDF or Zarr file.

    Parameters
    ----------
    file : str
        Path of the file, see ``clouds.cloud_files``.
    beyond : "clear" or "periodic"
        What is beyond the four sides of its grid.
    """

    keyword = "file"

    file: str = key(
        help="Path of a NetCDF or Zarr file of extinction or liquid water.",
        note="See [clouds](clouds.md); `kind` may be left out. `effective_radius` is for files"
        " without it.",
        range=(1.0, 1000.0),
        example="the path of a file of clouds",
        read=_read_file,
    )
    beyond: str = key(_BEYOND, default="clear")


#: Clouds that are generated, by their words.
CLOUD_TYPES: Final = (
    Stratus,
    Stratocumulus,
    CumulusHumilis,
    CumulusCongestus,
    Cumulonimbus,
    Altocumulus,
    Cirrus,
)


class _CloudKinds(TaggedUnion[Clouds]):
    """Kinds of clouds; a table with ``file`` needs no ``kind``."""

    def declared(self, table: FileTable | None = None) -> tuple[Field, ...]:
        """Keys of the table's kind."""
        if table is not None and "kind" not in table and "file" in table:
            table = {**table, "kind": CloudFile.keyword}
        return super().declared(table)

    def read(self, table: TomlTable, wavelengths: Wavelengths = None) -> Clouds:
        """Read the clouds from a table of a planet file."""
        if "kind" not in table and "file" in table:
            return CloudFile.read(table, wavelengths)
        return super().read(table, wavelengths)


#: Words of generated clouds.
WORDS: Final = tuple(one.keyword for one in CLOUD_TYPES)
#: Kinds of ``[[clouds]]``.
CLOUDS: Final[TaggedUnion[Clouds]] = _CloudKinds(
    Clouds, (*CLOUD_TYPES, CloudFile), label="kind of clouds", help="Kind of clouds."
)
