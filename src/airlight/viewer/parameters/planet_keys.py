"""The keys of a planet file: shell, ground, star, profiles, coefficients, phase functions."""

from __future__ import annotations

from functools import cache
from typing import Final

from airlight.planets.ground_and_star import SUN
from airlight.planets.reading.constituent_reader import OZONE_TABLE
from airlight.viewer.parameters.composition_keys import COMPOSITION_TABLES
from airlight.viewer.parameters.key import Key

#: Per-wavelength lists belong to these.
_NM: Final = "wavelengths"


@cache
def reflectances() -> tuple[str, ...]:
    """Names of the tables of reflectances that come with the package."""
    from airlight.spectra.tables import read_spectrum, spectrum_names

    tables = [read_spectrum(name) for name in spectrum_names()]
    return tuple(one.name for one in tables if one.unit == "1" and one.values.ndim == 1)


_WAVELENGTHS: Final = Key(
    name="wavelengths",
    label="wavelength",
    help="A wavelength that the lists of this part belong to.",
    unit="nm",
    bare="nm",
    low=300.0,
    high=1000.0,
    least=10.0,
    most=1e6,
    mode="advanced",
)


def _coefficient(name: str, label: str, text: str, **more: object) -> Key:
    return Key(
        name=name,
        label=label,
        help=text,
        unit="/km",
        bare="1/m",
        low=1e-7,
        high=1.0,
        most=1000.0,
        scale="log",
        per=_NM,
        **more,  # type: ignore[arg-type]
    )


def _asymmetry(name: str, label: str, text: str) -> Key:
    return Key(name=name, label=label, help=text, low=-0.99, high=0.99, least=-0.999, most=0.999,
               per=_NM)  # fmt: skip


def _term(name: str, label: str, text: str, unit: str, bare: str, most: float) -> Key:
    end = 2.0 if unit == "1" else 1.0
    return Key(name=name, label=label, help=text, unit=unit, bare=bare, low=-end, high=end,
               least=-most, most=most, default=0.0)  # fmt: skip


_ROOT: Final = (
    Key(name="name", label="name", kind="text", least=1.0, most=60.0,
        help="What the planet is called."),
    Key(name="description", label="description", kind="text", default="",
        help="What the numbers are and where they come from."),
    _WAVELENGTHS,
    Key(name="refraction", label="refraction", kind="choice", default="none",
        words=lambda: ("none", "bouguer"),
        help="Whether the gases bend light, so that the star is seen lifted and flattened."),
    Key(name="shell", label="shell", kind="table", table="shell", help="Where the air lies."),
    Key(name="ground", label="ground", kind="table", table="ground", help="What lies below."),
    Key(name="star", label="star", kind="table", table="star", help="What shines."),
    Key(name="constituents", label="constituents", kind="table", table="constituent",
        help="What the air is made of."),
)  # fmt: skip

_SHELL: Final = (
    Key(name="bottom_radius", label="radius of the ground", unit="km", bare="m", low=10.0,
        high=1e5, least=1.0, most=1e9, scale="log",
        help="Distance of the ground from the planet's centre; the air moves with it."),
    Key(name="top_radius", label="radius of the top of the air", unit="km", bare="m", low=10.0,
        high=1e5, least=1.0, most=1e10,
        help="Where the air ends, from the centre: up to ten times the ground's radius."),
)  # fmt: skip

_GROUND: Final = (
    Key(name="albedo", label="albedo", most=1.0, words=reflectances, per=_NM,
        help="Share of the light that the ground reflects, alike into all directions."),
    _WAVELENGTHS,
    Key(name="map", label="map", kind="text", least=1.0, most=100.0,
        help="Name of the picture of the ground."),
)  # fmt: skip

#: Stands for a star that is given by its temperature.
BLACK_BODY: Final = "black body"

_STAR: Final = (
    Key(name="spectrum", label="spectrum", kind="choice", words=lambda: (SUN, BLACK_BODY),
        default=BLACK_BODY, when=lambda star: "temperature" in star,
        help="The sun as measured outside the air, at 1 au; or a star of a temperature."),
    Key(name="irradiance", label="irradiance", unit="W/m^2/nm", bare="W/m^2/nm", low=1e-3,
        high=1e2, most=1e9, scale="log", per=_NM,
        help="The star's light at the planet, on a plane that faces it."),
    _WAVELENGTHS,
    Key(name="temperature", label="temperature", unit="K", bare="K", low=1000.0, high=40000.0,
        least=100.0, most=1e6, scale="log", mode="advanced",
        help="Of the star, as a black body."),
    Key(name="radius", label="radius of the star", unit="km", bare="m", low=1e4, high=1e8,
        least=1.0, most=1e10, scale="log", mode="advanced",
        help="With the distance it gives the light of a black body and the angle it fills."),
    Key(name="distance", label="distance", unit="au", bare="m", low=0.01, high=50.0, least=7e-6,
        most=66000.0, scale="log", default="1 au", when=lambda star: "spectrum" in star,
        help="From the star to the planet."),
    Key(name="angular_radius", label="angular radius", unit="deg", bare="deg", low=0.0, high=5.0,
        most=30.0, help="Half the angle that the star fills in the sky; 0 is a point."),
)  # fmt: skip


def _coefficients_alone(constituent: object) -> bool:
    """Whether a missing absorption means none: beside nothing that says it otherwise."""
    assert isinstance(constituent, dict)
    others = ("extinction", "single_scattering_albedo", "optical_depth", "absorption")
    return not any(key in constituent for key in others)


_CONSTITUENT: Final = (
    Key(name="name", label="name", kind="text", least=1.0, most=60.0,
        help="What the constituent is called."),
    Key(name="profile", label="profile", kind="table", table="profile",
        help="How its density changes with altitude."),
    _WAVELENGTHS,
    _coefficient("scattering", "scattering", table="scattering",
                 text="How much light it scatters on a kilometre of way, where its profile is 1."),
    _coefficient("absorption", "absorption", table="absorption", default=0.0,
                 when=_coefficients_alone,
                 text="How much light it swallows on a kilometre of way, where its profile is 1."),
    _coefficient("extinction", "extinction",
                 text="Scattering and absorption together, where its profile is 1."),
    Key(name="single_scattering_albedo", label="single-scattering albedo", most=1.0, per=_NM,
        help="Share of the extinction that is scattering."),
    Key(name="optical_depth", label="optical depth", low=1e-3, high=30.0, most=1e4, scale="log",
        per=_NM, help="Of the whole air straight up."),
    Key(name="gas", label="gas", kind="table", table="gas", help="A gas by its composition."),
    Key(name="particles", label="particles", kind="table", table="particles",
        help="Particles by what they are made of and how large they are."),
    Key(name="turbidity", label="turbidity", kind="table", table="turbidity",
        help="Haze by one number."),
    Key(name="turbidity_literal", label="turbidity", kind="table", table="turbidity_literal",
        help="Haze as OpenSpace has it."),
    Key(name="phase_function", label="phase function", kind="table", table="phase_function",
        help="Where the scattered light goes."),
)  # fmt: skip

#: Kinds of density profile, and of phase functions.
PROFILE_KINDS: Final = ("exponential", "tent", "layered", "tabulated", "uniform")
PHASE_KINDS: Final = (
    "rayleigh",
    "henyey-greenstein",
    "cornette-shanks",
    "double-henyey-greenstein",
    "tabulated",
)

_PROFILE: Final = (
    Key(name="kind", label="profile", kind="choice", words=lambda: PROFILE_KINDS,
        help="The form of its density over altitude."),
    Key(name="scale_height", label="scale height", unit="km", bare="m", low=0.1, high=100.0,
        least=1e-3, most=1e6, scale="log", table="bulk",
        help="Each such step up thins it by a factor of e."),
    Key(name="center", label="centre", unit="km", bare="m", low=0.0, high=100.0, most=1e6,
        help="Altitude where it is densest."),
    Key(name="half_width", label="half width", unit="km", bare="m", low=0.1, high=100.0,
        least=1e-3, most=1e6, scale="log",
        help="From the altitude where it is densest to where it ends."),
    Key(name="layers", label="layer", kind="table", table="layer", help="From the ground up."),
    Key(name="table", label="table", kind="choice", words=lambda: (OZONE_TABLE,),
        help="A table of densities that comes with the package."),
    Key(name="altitudes", label="altitude", unit="km", bare="m", low=0.0, high=100.0, most=1e6,
        mode="advanced", help="Altitude of one row of the table, above the one before it."),
    Key(name="densities", label="density", low=1e-6, high=1.0, most=1e6, scale="log",
        per="altitudes", per_unit="km", mode="advanced", help="Relative density in one row."),
)  # fmt: skip

_BULK: Final = (
    Key(name="temperature", label="temperature", unit="K", bare="K", low=20.0, high=1000.0,
        least=1e-3, most=1e9, scale="log", mode="advanced",
        help="The scale height is RT/(Mg)."),
    Key(name="molar_mass", label="molar mass", unit="g/mol", bare="kg/mol", low=1.0, high=100.0,
        least=1e-6, most=1e9, scale="log", mode="advanced", help="M of RT/(Mg)."),
    Key(name="gravity", label="gravity", unit="m/s^2", bare="m/s^2", low=0.1, high=100.0,
        least=1e-6, most=1e9, scale="log", mode="advanced", help="g of RT/(Mg)."),
)  # fmt: skip

_LAYER: Final = (
    Key(name="width", label="thickness", unit="km", bare="m", low=0.0, high=100.0, most=1e6,
        help="Of the layer; the topmost reaches the top of the air."),
    _term("exp_term", "exponential term", "Factor of the exponential.", "1", "1", 1e6),
    _term("exp_scale", "exponential scale", "Growth of the exponential upwards.", "/km", "1/m",
          1000.0),
    _term("linear_term", "linear term", "Factor of the altitude.", "/km", "1/m", 1000.0),
    _term("constant_term", "constant term", "Added to the others; the sum is held to 0 to 1.",
          "1", "1", 1e6),
)  # fmt: skip

_PHASE: Final = (
    Key(name="kind", label="phase function", kind="choice", words=lambda: PHASE_KINDS,
        help="Its form over the scattering angle."),
    Key(name="depolarisation", label="depolarisation", high=0.5, most=0.5, per=_NM, default=0.0,
        when=lambda phase: phase.get("kind") == "rayleigh",
        help="How far its molecules are from round: 0 for round ones."),
    _asymmetry("asymmetry", "asymmetry g", "1 is all forward, 0 even, -1 all backward."),
    _asymmetry("asymmetry_1", "asymmetry of the first lobe", "1 is all forward, -1 backward."),
    _asymmetry("asymmetry_2", "asymmetry of the second lobe", "1 is all forward, -1 backward."),
    Key(name="weight", label="weight of the first lobe", most=1.0, per=_NM,
        help="The second lobe has the rest."),
    Key(name="angles", label="angle", unit="deg", bare="deg", high=180.0, most=180.0,
        mode="advanced", help="Scattering angle of one row, above the one before it."),
    Key(name="values", label="phase function", unit="/sr", bare="1/sr", low=1e-4, high=1e3,
        most=1e9, scale="log", per="angles", per_unit="deg", mode="advanced",
        help="Its value there; the integral over the sphere is 1."),
)  # fmt: skip

#: The keys of each kind of table.
TABLES: Final[dict[str, tuple[Key, ...]]] = {
    "planet": _ROOT,
    "shell": _SHELL,
    "ground": _GROUND,
    "star": _STAR,
    "constituent": _CONSTITUENT,
    "profile": _PROFILE,
    "bulk": _BULK,
    "layer": _LAYER,
    "phase_function": _PHASE,
    **COMPOSITION_TABLES,
}
