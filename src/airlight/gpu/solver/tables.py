"""Inputs of the solver's passes from the host: sizes and tables, and their positions.

Numbers are in the uniform ``solve``, tables of numbers in the flat texture ``scalars``, those of
four wavelengths in ``spectra``.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from airlight.gpu.emit.shader_types import F32, I32, Bundle, Uniform, Value
from airlight.gpu.emit.texture_table import TextureTable
from airlight.optics.reflection import NUMBERS

#: Tables of numbers and of four wavelengths that the host uploads, with their ranks.
SCALARS: Final = {
    "mu": 2, "weight": 2, "flux": 2, "start": 2, "total": 1, "end": 3, "radius": 1, "mu_along": 1,
    "turn": 2, "amount": 2, "column": 1, "sun_cosines": 1, "row": 1, "place": 1, "cosines": 1,
    "multiples": 2, "harmonic": 1, "ahead": 1, "back": 1, "ratios": 4, "lift": 3, "level": 1,
}  # fmt: skip
SPECTRA: Final = ("extinction", "moments", "albedo")
#: Integers of ``Sizes`` in the uniform, four to a vector.
COUNTS: Final = (
    "radii", "angles", "suns", "turns", "degree", "terms", "constituents", "directions", "levels",
    "parts",
)  # fmt: skip
MEASURES: Final = ("bottom", "top", "star_radius")


class Sizes(NamedTuple):
    """Lengths of the axes, and other numbers of the passes.

    Attributes
    ----------
    radii, angles, suns, turns : int
        Numbers of radii that gather light, of directions in zenith angle, of nodes in sun
        elevation, and of azimuths.
    degree, terms, constituents, directions : int
        Degree of the harmonics, and numbers of harmonics, of constituents, and of directions in
        the table of columns.
    levels, parts : int
        Number of radii of the grid; light is gathered at every ``parts``-th of them.
    bottom, top, star_radius : float
        Radii of the ground and the top [m]; angular radius of the star [rad].
    """

    radii: Any
    angles: Any
    suns: Any
    turns: Any
    degree: Any
    terms: Any
    constituents: Any
    directions: Any
    levels: Any
    parts: Any
    bottom: Any
    top: Any
    star_radius: Any


class Tables(NamedTuple):
    """Tables of the passes; shapes and units as in ``Grid``, ``Rays``, ``Air`` ….

    Attributes
    ----------
    mu, weight, flux, start, total, end, radius, mu_along, turn, amount, column :
        Fields of ``Rays``; total and column flat.
    sun_cosines, row, place :
        Fields of ``Grid``.
    cosines, multiples :
        Fields of ``Azimuths``.
    harmonic, ahead, back :
        Fields of ``Harmonics``.
    ratios :
        Table from ``mean_density_ratios``.
    lift :
        Table from ``star_lift``.
    level : array, shape (s·4,)
        Weights from ``level_weights``, of four wavelengths.
    extinction, moments :
        Fields of ``Air``; four wavelengths a texel.
    ground : Reflection
        Field of ``Air``; its table of four wavelengths a texel is ``albedo``.
    """

    mu: Any
    weight: Any
    flux: Any
    start: Any
    total: Any
    end: Any
    radius: Any
    mu_along: Any
    turn: Any
    amount: Any
    column: Any
    sun_cosines: Any
    row: Any
    place: Any
    cosines: Any
    multiples: Any
    harmonic: Any
    ahead: Any
    back: Any
    ratios: Any
    lift: Any
    level: Any
    extinction: Any
    moments: Any
    ground: Any


def uniform_fields() -> tuple[str, ...]:
    """Names of the vectors of the uniform ``solve``, in their order."""
    tables = [*SCALARS, *SPECTRA]
    return (
        "counts", "more_counts", "most_counts", "measures", "reflection",
        *(f"{name}_{part}" for name in tables for part in ("shape", "start")),
    )  # fmt: skip


def sizes_in_shader() -> Bundle:
    """Bundle of ``Sizes`` as a shader reads them, from its uniform ``solve``."""
    fields: dict[str, Value] = {}
    for at, name in enumerate(COUNTS):
        vector = ("counts", "more_counts", "most_counts")[at // 4]
        fields[name] = Uniform(f"solve.{vector}[{at % 4}]", I32)
    for at, name in enumerate(MEASURES):
        fields[name] = Uniform(f"solve.measures[{at}]", F32)
    return Bundle(Sizes(**fields)._asdict())


def tables_in_shader() -> Bundle:
    """Bundle of ``Tables`` as a shader reads them, from textures."""
    fields: dict[str, Value] = {name: texture_table(name).table for name in (*SCALARS, *SPECTRA)}
    ground = {"albedo": fields.pop("albedo")}
    for at, (name, kind) in enumerate(NUMBERS.items()):
        ground[name] = Uniform(f"solve.reflection[{at}]", I32 if kind is int else F32)
    fields["ground"] = Bundle(ground)
    return Bundle(Tables(**fields)._asdict())


def texture_table(name: str) -> TextureTable:
    """Table of ``Tables`` in its texture.

    Parameters
    ----------
    name : str
        Name from ``SCALARS`` or ``SPECTRA``.
    """
    start, lengths = f"solve.{name}_start.x", f"solve.{name}_shape"
    if name in SPECTRA:
        return TextureTable(name, "spectra", 1, True, start, lengths)
    return TextureTable(name, "scalars", SCALARS[name], False, start, lengths)
