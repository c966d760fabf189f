"""The keys of a planet file that say what its air is made of: the advanced form."""

from __future__ import annotations

from functools import cache
from typing import Final

from airlight.planets.matter.gases import GASES
from airlight.viewer.parameters.key import Key

#: Per-wavelength lists belong to these.
_NM: Final = "wavelengths"

METHODS: Final = ("mie", "anomalous-diffraction")
SIZE_KINDS: Final = ("gamma", "log-normal", "single")


@cache
def _cross_sections() -> tuple[str, ...]:
    from airlight.spectra.tables import read_spectrum, spectrum_names

    tables = [read_spectrum(name) for name in spectrum_names()]
    return tuple(one.name for one in tables if one.unit in ("cm^2", "m^2", "cm2", "m2"))


def _indices() -> tuple[str, ...]:
    from airlight.optics.index_table import index_names

    return tuple(index_names())


def _advanced(name: str, label: str, text: str, **more: object) -> Key:
    return Key(name=name, label=label, help=text, mode="advanced", **more)  # type: ignore[arg-type]


def _state(prefix: str = "", of: str = "the gas where its profile is 1") -> tuple[Key, Key]:
    return (
        _advanced(f"{prefix}temperature", f"{prefix.replace('_', ' ')}temperature",
                  f"Of {of}.", unit="K", bare="K", low=20.0, high=2000.0, least=1.0, most=1e5,
                  scale="log"),
        _advanced(f"{prefix}pressure", f"{prefix.replace('_', ' ')}pressure", f"Of {of}.",
                  unit="hPa", bare="Pa", low=0.01, high=1e5, least=1e-11, most=1e8, scale="log"),
    )  # fmt: skip


def _number_density(
    name: str = "number_density",
    label: str = "number density",
    text: str = "Molecules in a cubic metre, where its profile is 1.",
    least: float = 1e10,
) -> Key:
    return _advanced(name, label, text, unit="/m^3", bare="1/m^3", low=1e18, high=1e28,
                     least=least, most=1e29, scale="log")  # fmt: skip


_DEPOLARISATION: Final = _advanced(
    "depolarisation", "depolarisation", "How far its molecules are from round, 0 to 0.5.",
    high=0.5, most=0.5, per=_NM,
)  # fmt: skip
_REFRACTIVITY: Final = _advanced(
    "refractivity", "refractivity n - 1", "Of the gas, at the state given with it.",
    low=1e-7, high=1e-2, most=1.0, scale="log", per=_NM,
)  # fmt: skip

_GAS: Final = (
    _advanced("composition", "composition", "Mole fractions.", kind="table", table="composition"),
    *_state(),
    _number_density(),
    _advanced("gravity", "gravity", "With it the scale height follows, RT/(Mg).", unit="m/s^2",
              bare="m/s^2", low=0.1, high=100.0, least=1e-3, most=1e4, scale="log"),
    _DEPOLARISATION,
    _REFRACTIVITY,
    *_state("refractivity_", "the state that the refractivity was measured at"),
)  # fmt: skip

_COMPOSITION: Final = (
    _advanced("*", "share", "Mole fraction; the other gases make room for it in proportion.",
              most=1.0),
)  # fmt: skip

_SCATTERING: Final = (
    _advanced("rayleigh", "gas", "A gas whose scattering is known.", kind="choice",
              words=lambda: tuple(GASES)),
    _REFRACTIVITY,
    *_state(),
    _number_density(),
    _number_density("ground_number_density", "number density at the ground",
                    "Where the planet's own is another than that of the refractivity."),
    _advanced("mass_density", "mass density", "Of the gas where its profile is 1.",
              unit="kg/m^3", bare="kg/m^3", low=1e-4, high=100.0, least=1e-12, most=1e6,
              scale="log"),
    _advanced("molar_mass", "molar mass", "Of the gas.", unit="g/mol", bare="kg/mol", low=1.0,
              high=100.0, least=0.1, most=1000.0, scale="log"),
    _advanced("king_factor", "King factor", "1 for round molecules.", low=1.0, high=1.3,
              least=1.0, most=2.0, per=_NM),
    _DEPOLARISATION,
)  # fmt: skip

_COLUMN: Final = {"unit": "DU", "bare": "1/m^2", "low": 1.0, "high": 2000.0, "scale": "log"}

_ABSORPTION: Final = (
    _advanced("ozone", "ozone column", "All the ozone above the ground.", most=37000.0,
              **_COLUMN),
    _advanced("cross_section", "cross-section", "Area that one molecule blocks.", unit="cm^2",
              bare="m^2", low=1e-26, high=1e-16, most=1e-6, scale="log", per=_NM,
              words=_cross_sections),
    _advanced("column", "column", "All of the gas above the ground.", most=1e12, **_COLUMN),
    _number_density(text="Molecules of the air in a cubic metre, where the profile is 1.",
                    least=0.0),
    _advanced("fraction", "share", "Of the number density.", most=1.0, default=1.0,
              when=lambda table: "number_density" in table),
    _advanced("small_particles", "small particles", "Much smaller than the wavelength.",
              kind="table", table="small_particles"),
)  # fmt: skip

_RADIUS: Final = {
    "unit": "um", "bare": "m", "low": 0.01, "high": 20.0, "least": 1e-4, "most": 1000.0,
    "scale": "log",
}  # fmt: skip

_SMALL_PARTICLES: Final = (
    _advanced("radius", "radius", "Of the particles.", unit="nm", bare="m", low=1.0, high=100.0,
              least=0.1, most=1e4, scale="log"),
    _advanced("number_density", "number density", "Particles in a cubic metre.", unit="/m^3",
              bare="1/m^3", low=1e6, high=1e18, most=1e29, scale="log"),
    _advanced("index", "refractive index", "n + ik.", kind="table", table="index"),
)  # fmt: skip

_INDEX: Final = (
    _advanced("real", "index, real part", "How much slower light is within.", low=1.0, high=3.0,
              least=0.1, most=10.0, per=_NM),
    _advanced("imaginary", "index, imaginary part", "How much is swallowed within.", low=1e-6,
              high=1.0, most=10.0, scale="log", per=_NM, default=0.0,
              when=lambda table: "real" in table),
    _advanced("matrix", "matrix", "What the grains lie in.", kind="choice", table="index",
              words=_indices),
    _advanced("inclusions", "grains", "What lies in the matrix.", kind="choice", table="index",
              words=_indices),
    _advanced("fraction", "share of the grains", "By volume.", most=1.0),
)  # fmt: skip

_SIZES: Final = (
    _advanced("kind", "sizes", "How the radii are distributed.", kind="choice",
              words=lambda: SIZE_KINDS),
    _advanced("effective_radius", "effective radius", "Mean radius, weighted by area.", **_RADIUS),
    _advanced("effective_variance", "effective variance", "How much the radii differ.", low=0.01,
              high=0.49, least=1e-3, most=0.499),
    _advanced("median_radius", "median radius", "Half of the particles are larger.", **_RADIUS),
    _advanced("geometric_deviation", "geometric deviation",
              "Two thirds of the radii lie within this factor of the median.", low=1.0, high=3.0,
              least=1.0, most=5.0),
    _advanced("radius", "radius", "The same for all.", **_RADIUS),
)  # fmt: skip

_PARTICLES: Final = (
    _advanced("index", "material", "What the particles are made of.", kind="choice", table="index",
              words=_indices),
    _advanced("sizes", "sizes", "How large they are.", kind="table", table="sizes"),
    _advanced("optical_depth", "optical depth", "Of all of them straight up, at the wavelength "
              "below.", low=1e-3, high=30.0, most=1e4, scale="log"),
    _advanced("number_density", "number density", "Particles in a cubic centimetre, where their "
              "profile is 1.", unit="/cm^3", bare="1/m^3", low=1e-2, high=1e6, most=1e19,
              scale="log"),
    _advanced("at", "wavelength of the optical depth", "Where it is given.", unit="nm", bare="nm",
              low=300.0, high=1000.0, least=10.0, most=1e6, default="550 nm",
              when=lambda table: "optical_depth" in table),
    _advanced("method", "method", "Exact for spheres, or the approximation of van de Hulst.",
              kind="choice", words=lambda: METHODS, default="mie"),
)  # fmt: skip

_TURBIDITY: Final = (
    _advanced("turbidity", "turbidity", "1 is clear air, 2 clean, 10 thick haze.", low=1.0,
              high=10.0, least=1.0, most=100.0),
    _advanced("rayleigh_optical_depth", "optical depth of the gas", "At 550 nm; the haze has "
              "turbidity - 1 times as much.", low=1e-3, high=10.0, most=1e3, scale="log"),
    _advanced("optical_depth", "optical depth", "Of the haze straight up, at 550 nm.", low=1e-3,
              high=30.0, most=1e4, scale="log"),
    _advanced("junge", "Junge exponent", "Of the sizes: 4 for haze that falls with the wavelength "
              "squared.", low=2.0, high=6.0, least=2.0, most=6.0),
    _advanced("angstrom", "Ångström exponent", "Power of the wavelength that the haze falls with.",
              low=0.0, high=4.0, most=4.0),
    _advanced("single_scattering_albedo", "single-scattering albedo", "Share of the extinction "
              "that is scattering.", most=1.0, default=1.0),
)  # fmt: skip

_TURBIDITY_LITERAL: Final = (
    _advanced("turbidity", "turbidity", "1 is clear air, 2 clean, 10 thick haze.", low=1.0,
              high=10.0, least=1.0, most=100.0),
    _advanced("junge", "Junge exponent", "The printed equation holds for 4 only.", low=4.0,
              high=4.0, least=4.0, most=4.0),
)  # fmt: skip

#: The keys of each kind of table.
COMPOSITION_TABLES: Final[dict[str, tuple[Key, ...]]] = {
    "gas": _GAS,
    "composition": _COMPOSITION,
    "scattering": _SCATTERING,
    "absorption": _ABSORPTION,
    "small_particles": _SMALL_PARTICLES,
    "index": _INDEX,
    "sizes": _SIZES,
    "particles": _PARTICLES,
    "turbidity": _TURBIDITY,
    "turbidity_literal": _TURBIDITY_LITERAL,
}
