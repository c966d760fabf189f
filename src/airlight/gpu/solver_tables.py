"""What the host gives to the passes of the solver: lengths of axes, and tables."""

from __future__ import annotations

from typing import Any, NamedTuple


class Sizes(NamedTuple):
    """How long the axes are.

    Attributes
    ----------
    radii, angles, suns, turns : int
        Radii that gather light; directions in zenith angle; nodes in sun elevation; azimuths.
    degree, terms, constituents, directions : int
        Of the harmonics; how many of them; of the air; of the table of columns.
    levels, parts : int
        Radii of the grid; light is gathered at one of so many of them.
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
    """What the host gives to the passes; shapes and units as in ``Grid``, ``Rays``, ``Air`` ….

    Attributes
    ----------
    mu, weight, flux, start, total, end, radius, mu_along, turn, amount, column :
        Of ``Rays``; total and column flat.
    sun_cosines, row, place :
        Of ``Grid``.
    cosines, multiples :
        Of ``Azimuths``.
    harmonic, ahead, back :
        Of ``Harmonics``.
    ratios :
        From ``mean_density_ratios``.
    lift :
        From ``star_lift``.
    level : array, shape (s·4,)
        From ``level_weights``, of four wavelengths.
    extinction, moments, albedo :
        Of ``Air``; four wavelengths a texel.
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
    albedo: Any
