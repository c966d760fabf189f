"""Bruneton's tables for his shaders, with a single lobe for all particles, and their look-ups.

Radiance is ``S p_R(nu) + M p_CS(nu; g)``: S, "scattering", times the Rayleigh phase function; M,
"single Mie", times a Cornette-Shanks lobe. M has a separate table, or only its red channel is
stored in the alpha of S, from which its colours are restored. ``fill_tables`` converts a solution
to this form; ``SkyTables`` is the look-up of the program.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import groups
from airlight.engines.baking.bake import Baked, bake
from airlight.engines.baking.packing import combine
from airlight.engines.targets.fits.texel_light import STEP, TexelFit
from airlight.engines.targets.fits.weighted_lobe import WeightedLobe, fit_weighted_lobe
from airlight.errors import ParameterError
from airlight.kernel import vectorized
from airlight.kernel.threads import Progress
from airlight.physics.optics.phase_functions import cornette_shanks, rayleigh
from airlight.solver.solution import Solution
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.irradiance import IrradianceLayout
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.transmittance import TransmittanceLayout

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]
Stored = NDArray[Any]

#: Wavelengths of red, green and blue. [nm]
WAVELENGTHS: Final = (680.0, 550.0, 440.0)
#: Numbers of texels in r, mu, mu_s and nu, fixed by the programs.
_SIZE: Final = (32, 128, 32, 8)
#: Sun's cosine below which a program omits M in front of surfaces, partly or entirely.
_LEFT_OUT: Final = 0.01
#: Smallest number of points at which the bake is compared; these errors are not reported.
_FEW: Final = 64
#: Radiance relative to the brightest below which it does not determine the colours of M.
_DIM: Final = 1e-5
#: Largest half float.
_LARGEST: Final = 65504.0
#: Altitudes for the search of the largest density.
_HEIGHTS: Final = 1001


@dataclass(frozen=True, kw_only=True, eq=False)
class SkyTables:
    """Tables of a folder and the look-up of the program, in double precision.

    Attributes
    ----------
    layout : BrunetonLayout
        Positions of the texels.
    scattering : array, shape (radii, views, suns, angles, 4)
        S, and red of M. [W m⁻² nm⁻¹]
    single_mie : array, shape (radii, views, suns, angles, 3), or None
        M, if it has a separate table. [W m⁻² nm⁻¹]
    transmittance : array, shape (radii, views, 3)
        Transmittance to the top. [1]
    irradiance : array, shape (radii, suns, 3)
        Diffuse horizontal irradiance. [W m⁻² nm⁻¹]
    g : float
        Parameter of the lobe. [1]
    mie_colours : array, shape (3,)
        Ratio of scattering by particles and by molecules, over that at red. [1]
    darkest : float
        Smallest red of S for which the colours of M are restored. [W m⁻² nm⁻¹]
    """

    layout: BrunetonLayout
    scattering: Stored
    single_mie: Stored | None
    transmittance: Stored
    irradiance: Stored
    g: float
    mie_colours: FloatArray
    darkest: float = 0.0

    def radiance(self, positions: Positions) -> FloatArray:
        """Path radiance, shape (n, 3). [W m⁻² sr⁻¹ nm⁻¹]"""
        even: Any = vectorized(rayleigh)
        lobe: Any = vectorized(cornette_shanks)
        found = self.layout.interpolate(self.scattering, positions)
        smooth = found[:, :3]
        if self.single_mie is not None:
            mie = self.layout.interpolate(self.single_mie, positions)
        else:
            red = smooth[:, :1]
            bright = red > self.darkest
            ratio = np.divide(found[:, 3:], red, out=np.zeros_like(red), where=bright)
            mie = smooth * ratio * self.mie_colours
        return np.asarray(
            smooth * even(positions.nu, 0.0)[:, None] + mie * lobe(positions.nu, self.g)[:, None]
        )

    def transmittance_at(self, positions: Positions) -> FloatArray:
        """Transmittance to the top, shape (n, 3). [1]"""
        radii, views, _ = self.transmittance.shape
        layout = TransmittanceLayout(**self._shell, radii=radii, views=views)
        return layout.interpolate(self.transmittance, positions)

    def irradiance_at(self, positions: Positions) -> FloatArray:
        """Diffuse horizontal irradiance, shape (n, 3). [W m⁻² nm⁻¹]"""
        radii, suns, _ = self.irradiance.shape
        layout = IrradianceLayout(**self._shell, radii=radii, sun_angles=suns)
        return layout.interpolate(self.irradiance, positions)

    @property
    def _shell(self) -> dict[str, Any]:
        return {"bottom_radius": self.layout.bottom_radius, "top_radius": self.layout.top_radius}


@dataclass(frozen=True, kw_only=True, eq=False)
class Filled:
    """Tables of a solution in Bruneton's form.

    Attributes
    ----------
    tables : SkyTables
        Tables with M, separate or in alpha.
    higher : array, shape (radii, views, suns, angles, 3)
        Multiple scattering, the part of S from the second order on, over the Rayleigh phase
        function. [W m⁻² nm⁻¹]
    lobe : WeightedLobe
        Fit of the particles' phase functions.
    """

    tables: SkyTables
    higher: FloatArray
    lobe: WeightedLobe


def fill_tables(
    solution: Solution,
    *,
    combined: bool = False,
    lowest_sun: float | None = None,
    darkest: float = 0.0,
    progress: Progress | None = None,
) -> Filled:
    """Tables of a solution in Bruneton's form, with the sizes fixed by his programs.

    Parameters
    ----------
    solution : Solution
        Solution at ``WAVELENGTHS``.
    combined : bool
        Whether M is stored in alpha; S is then such that the look-up is exact at the texels.
    lowest_sun : float, optional
        Largest solar zenith angle of the tables; default: the end of twilight. [deg]
    darkest : float
        See ``SkyTables``.
    """
    medium = solution.medium
    _, particles = groups(medium)
    fine = bool(particles) and not combined
    radii, views, suns, angles = _SIZE
    baked = bake(
        solution,
        "bruneton",
        size=(radii, views, suns, STEP * (angles - 1) + 1 if fine else angles),
        packing="separate",
        mu_s_min=None if lowest_sun is None else float(min(np.cos(np.radians(lowest_sun)), 0.0)),
        higher_orders=True,
        smooth_phase="rayleigh",
        points=_FEW,
        progress=progress,
    )
    light = medium.lights[0].irradiance
    baked_layout = baked.tables["scattering"].layout
    assert isinstance(baked_layout, BrunetonLayout)
    layout = replace(baked_layout, angles=angles)
    lobe, smooth, mie = _smooth_and_mie(medium, baked, layout, one_row=combined)
    smooth, mie, colours = smooth * light, mie * light, mie_colours(medium)
    packed = np.concatenate([smooth, mie[..., :1]], axis=-1)
    if combined:
        colours = _colours_ahead(layout, smooth, mie, colours)
        packed = _combined(layout, smooth, mie, lobe.g, colours)
    tables = SkyTables(
        layout=layout,
        scattering=packed,
        single_mie=None if combined else mie,
        transmittance=baked.tables["transmittance"].physical,
        irradiance=baked.tables["irradiance"].physical * light,
        g=lobe.g,
        mie_colours=colours,
        darkest=darkest,
    )
    # Where alpha restores colours, S is the part that gives the right sum, which may be less.
    every = STEP if fine else 1
    orders = baked.tables["higher-order"].physical[..., ::every, :] * light
    higher = np.minimum(orders, packed[..., :3])
    return Filled(tables=tables, higher=higher, lobe=lobe)


def textures_of(tables: SkyTables) -> dict[str, Stored]:
    """Values of the files that both programs load, rows of all slices one after another."""
    textures = {
        "transmittance": opaque(tables.transmittance),
        "irradiance": opaque(tables.irradiance),
        "scattering": sliced(tables.scattering),
    }
    if tables.single_mie is not None:
        textures["single_mie_scattering"] = sliced(opaque(tables.single_mie))
    return textures


def tables_of(
    read: Callable[[str], Stored], layout: BrunetonLayout, *, combined: bool, **more: Any
) -> SkyTables:
    """Tables of the files that both programs load, by ``read(name)``; see ``textures_of``."""
    single = None
    if not combined:
        single = unsliced(read("single_mie_scattering"), layout)[..., :3].copy()
    return SkyTables(
        layout=layout,
        scattering=unsliced(read("scattering"), layout),
        single_mie=single,
        transmittance=read("transmittance").reshape(64, 256, 4)[..., :3].copy(),
        irradiance=read("irradiance").reshape(16, 64, 4)[..., :3].copy(),
        **more,
    )


def check_lowest_sun(lowest_sun: float | None) -> None:
    """Raise an error for a lowest sun outside 90 to 180 deg."""
    if lowest_sun is not None and not 90.0 <= lowest_sun <= 180.0:
        raise ParameterError("lowest_sun", lowest_sun, "90 to 180 deg")


def check_halves(textures: dict[str, Stored]) -> None:
    """Raise an error for radiances beyond the range of half floats."""
    for name, values in textures.items():
        largest = float(np.abs(values).max())
        if not largest <= _LARGEST:
            raise ParameterError(name, largest, f"at most {_LARGEST:g}, the largest half float")


def opaque(values: Stored) -> Stored:
    """Texture with an alpha channel of 1."""
    return np.concatenate([values, np.ones((*values.shape[:-1], 1))], axis=-1)


def sliced(values: Stored) -> Stored:
    """Texture (r mu, nu mu_s, channels) of values (r, mu, mu_s, nu, channels)."""
    radii, views, suns, angles, channels = values.shape
    turned = values.transpose(0, 1, 3, 2, 4)
    return turned.reshape(radii * views, angles * suns, channels)


def unsliced(flat: Stored, layout: BrunetonLayout) -> Stored:
    """Inverse of ``sliced`` for four channels, from numbers in the order of a file."""
    shape = (layout.radii, layout.views, layout.angles, layout.sun_angles, 4)
    return np.ascontiguousarray(flat.reshape(shape).transpose(0, 1, 3, 2, 4))


def mie_colours(medium: Medium) -> FloatArray:
    """Ratio of scattering by particles and by molecules, over that at red, shape (3,). [1]"""
    molecules, particles, _ = coefficients(medium)
    ratio = particles / molecules
    return np.asarray(ratio / ratio[0])


def coefficients(medium: Medium) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Scattering of molecules, and scattering and extinction of particles, each (3,). [m⁻¹]

    Each is taken where its group scatters most. Programs restore the colours of M by the ratio of
    the first two, which is 1 without molecules or particles.
    """
    heights = np.linspace(0.0, medium.thickness, _HEIGHTS)
    density = medium.density.at(heights)
    gas, dust = groups(medium)

    def densest(group: list[int], values: FloatArray) -> FloatArray:
        scattering = density[:, group] @ medium.scattering[group]
        row = int(scattering.sum(axis=-1).argmax())
        return np.asarray(density[row, group] @ values[group])

    extinction = densest(dust, medium.extinction)
    molecules, particles = (densest(group, medium.scattering) for group in (gas, dust))
    if not (particles > 0.0).all():
        return molecules, molecules, molecules
    if not (molecules > 0.0).all():
        return particles, particles, extinction
    return molecules, particles, extinction


def _smooth_and_mie(
    medium: Medium, baked: Baked, layout: BrunetonLayout, *, one_row: bool
) -> tuple[WeightedLobe, FloatArray, FloatArray]:
    """Fit of the phase functions, and S and M per irradiance of the star."""
    phases = baked.light.phases
    kinds = phases.names[1:]
    _, dust = groups(medium)
    depth = (medium.scattering * medium.columns[:, None])[dust][: len(kinds)]
    names = tuple(medium.names[index] for index in dust)[: len(kinds)]
    lobe = fit_weighted_lobe(
        names, lambda k, nu: phases.at(kinds[k], nu), depth, layout.angles, one_row=one_row
    )
    exact = baked.tables["scattering"].physical
    once = [baked.tables[kind].physical for kind in kinds]
    every = (exact.shape[-2] - 1) // (layout.angles - 1)
    smooth = np.array(exact[..., ::every, :])
    mie = np.zeros_like(smooth)
    for k, one in enumerate(once):
        smooth += one[..., ::every, :] * lobe.smooth[k].T
        mie += one[..., ::every, :] * lobe.lobe[k].T
    if every == 1:
        return lobe, smooth, mie
    fit = TexelFit(
        lobe.g, layout.angles, lambda nu: np.stack([phases.at(kind, nu) for kind in kinds])
    )
    start = np.concatenate([smooth, mie], axis=-2)
    flat = (-1, *exact.shape[-2:])
    # in front of a surface the program omits M while the sun is below the horizon
    signed = layout.positions().mu_s.reshape(layout.shape)[..., 0].ravel() > _LEFT_OUT
    lights, rows = [one.reshape(flat) for one in once], start.reshape(-1, *start.shape[-2:])
    found = fit.fitted(exact.reshape(flat), lights, rows, signed=signed).reshape(start.shape)
    return lobe, found[..., : layout.angles, :], found[..., layout.angles :, :]


def _colours_ahead(
    layout: BrunetonLayout, smooth: FloatArray, mie: FloatArray, coefficients: FloatArray
) -> FloatArray:
    """Factors that best restore the colours of M from S and its red, at the sun.

    Least squares by day; the planet's coefficients elsewhere. With dust, S is not scattering by
    molecules alone, so that their coefficients do not determine its colour.
    """
    mu_s = layout.positions().mu_s.reshape(layout.shape)[..., -1]
    ahead, even = mie[..., -1, :], smooth[..., -1, :]
    lit = (mu_s > 0.0) & (ahead[..., 0] > 0.0) & (even[..., 0] > _DIM * even[..., 0].max())
    proportional = even[lit] * (ahead[lit][:, :1] / even[lit][:, :1])
    below = (proportional**2).sum(axis=0)
    if not (below > 0.0).all():
        return coefficients
    return np.asarray((ahead[lit] * proportional).sum(axis=0) / below)


def _combined(
    layout: BrunetonLayout, smooth: FloatArray, mie: FloatArray, g: float, colours: FloatArray
) -> FloatArray:
    """Texture with M in alpha, (…, 4); the look-up is exact at the texels' nu."""
    nu = np.linspace(-1.0, 1.0, layout.angles)
    even: Any = vectorized(rayleigh)
    narrow: Any = vectorized(cornette_shanks)
    p_smooth, p_mie = even(nu, 0.0)[:, None], narrow(nu, g)[:, None]
    flat = (-1, smooth.shape[-1])
    per_texel = np.broadcast_to(p_smooth, smooth.shape).reshape(flat)
    per_mie = np.broadcast_to(p_mie, smooth.shape).reshape(flat)
    light = smooth * p_smooth + mie * p_mie
    made = combine(light.reshape(flat), mie.reshape(flat), per_texel, per_mie, colours, 0)
    return made.reshape(*smooth.shape[:-1], 4)
