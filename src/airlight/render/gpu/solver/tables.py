"""Host inputs of the solver passes: sizes in the uniform ``solve``, tables in two textures.

The flat texture ``scalars`` holds scalar tables, ``spectra`` those of four wavelengths.
"""

from __future__ import annotations

from typing import Annotated, Any, Final, NamedTuple

from airlight.kernel.shader_fields import SPECTRA, scalars, spectra
from airlight.physics.optics.reflection import Reflection
from airlight.render.gpu.emit.uniform_struct import UniformStruct


class GridSizes(NamedTuple):
    """Axis lengths and other scalars of the passes.

    Attributes
    ----------
    radii, angles, sun_angles, turns : int
        Numbers of radii that gather light, of directions in zenith angle, of nodes in sun
        elevation, and of azimuths.
    degree, terms, constituents, directions : int
        Degree of the harmonics, and numbers of moments of a node, of constituents, and of
        directions in the table of columns.
    levels, refinement : int
        Number of radii of the grid; light is gathered at every ``refinement``-th of them.
    received : int
        First texel of the ground's irradiances in a packed field.
    bottom, top, star_radius : float
        Radii of the ground and the top [m]; angular radius of the star [rad].
    """

    radii: int
    angles: int
    sun_angles: int
    turns: int
    degree: int
    terms: int
    constituents: int
    directions: int
    levels: int
    refinement: int
    received: int
    bottom: float
    top: float
    star_radius: float


class Tables(NamedTuple):
    """Tables of the passes; shapes and units as in ``Grid``, ``Rays``, ``ScaledOptics`` ….

    Attributes
    ----------
    mu, weight, flux, start, total, end, radius, mu_along, turn, amount, column :
        Fields of ``Rays``; total and column flat.
    sun_cosines, first_nodes, row, place :
        Fields of ``Grid``.
    cosines, multiples, sines :
        Fields of ``Azimuths``.
    harmonic, ahead, back :
        Fields of ``Harmonics``.
    column_rows :
        Rows of ``ratios`` at the altitude nodes, from ``column_rows``.
    ratios :
        Table from ``rational_mean_density``.
    refraction_table :
        Table from ``refraction_table``.
    level : array, shape (s·4,)
        Weights from ``level_weights``, of four wavelengths.
    extinction, moments, polarised_moments :
        Fields of ``ScaledOptics``; four wavelengths a texel.
    ground : Reflection
        Field of ``ScaledOptics``.
    """

    mu: Annotated[Any, scalars(2)]
    weight: Annotated[Any, scalars(2)]
    flux: Annotated[Any, scalars(2)]
    start: Annotated[Any, scalars(2)]
    total: Annotated[Any, scalars()]
    end: Annotated[Any, scalars(3)]
    radius: Annotated[Any, scalars()]
    mu_along: Annotated[Any, scalars()]
    turn: Annotated[Any, scalars(2)]
    amount: Annotated[Any, scalars(2)]
    column: Annotated[Any, scalars()]
    sun_cosines: Annotated[Any, scalars()]
    first_nodes: Annotated[Any, scalars()]
    row: Annotated[Any, scalars()]
    place: Annotated[Any, scalars()]
    cosines: Annotated[Any, scalars()]
    multiples: Annotated[Any, scalars(2)]
    sines: Annotated[Any, scalars(2)]
    harmonic: Annotated[Any, scalars()]
    ahead: Annotated[Any, scalars()]
    back: Annotated[Any, scalars()]
    column_rows: Annotated[Any, scalars()]
    ratios: Annotated[Any, scalars(4)]
    refraction_table: Annotated[Any, scalars(3)]
    level: Annotated[Any, scalars()]
    extinction: Annotated[Any, SPECTRA]
    moments: Annotated[Any, spectra(2)]
    polarised_moments: Annotated[Any, spectra(2)]
    ground: Reflection


#: Scalars and tables of the solver passes.
SOLVE: Final = UniformStruct("solve", (GridSizes, Tables))
