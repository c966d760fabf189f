"""``bake``: look-up tables for engines from a solution, with their errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import AirLight, described_orders, lines_of_sight
from airlight.engines.baking.labelled_tables import Labels, facts, unscattered
from airlight.engines.baking.packing import (
    FIT_AZIMUTHS,
    ScatteringGroups,
    SeparatedLight,
    colours_of,
    combine,
    fit_azimuths,
    scattering_groups,
    separate_orders,
)
from airlight.engines.baking.smooth_light import smooth_phases
from airlight.engines.baking.table_errors import (
    ERROR_POINTS,
    SEED,
    ErrorSample,
    TableErrors,
    measured_errors,
)
from airlight.engines.baking.texel_values import balanced, fill_angles, of_views
from airlight.errors import ConflictError, ParameterError
from airlight.kernel import vectorized
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.physics.optics.phase_functions import rayleigh
from airlight.physics.units import Measure
from airlight.planets.left_out import warn_of_shape
from airlight.planets.reading.reader import PlanetLike
from airlight.planets.without_clouds import check_clear
from airlight.scene.limits import within
from airlight.solver.refracted_geometry import require_no_refraction
from airlight.solver.solution import Solution
from airlight.solver.solve import solution_of
from airlight.solver.tables.atmosphere_plus import AtmospherePlusLayout
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.layout import Positions, TableLayout
from airlight.solver.tables.scattered_light import PhaseFunctions, ScatteredLight
from airlight.solver.tables.table import Table

FloatArray = NDArray[np.float64]

#: Names of the layouts of scattered light.
LAYOUT_NAMES: Final = ("bruneton", "atmosphere-plus")
#: Texels per block of work.
_BLOCK: Final = 1 << 13
#: Divisors of the smooth radiance, by the name of the phase function.
_DIVISORS: Final = {
    "smooth": "the phase function smooth",
    "rayleigh": "Rayleigh's phase function",
    "gas": "the gas's phase function",
}
#: Quantity of the tables of scattered light.
_AIR: Final = "path radiance without the ground's radiance, per irradiance of the star"


@dataclass(frozen=True, kw_only=True, eq=False)
class Baked:
    """Tables of one planet.

    Attributes
    ----------
    light : ScatteredLight
        Path radiance from ``tables``.
    tables : dict of str to Table
        ``transmittance``, ``irradiance``, ``scattering``, and ``single-<name>`` or ``particles``;
        optionally ``higher-order``.
    about : dict
        Planet, fingerprint, solver, orders, wavelengths, irradiance of the star.
    errors : dict of str to TableErrors
        Errors by quantity.
    """

    light: ScatteredLight
    tables: dict[str, Table]
    about: dict[str, Any]
    errors: dict[str, TableErrors]

    def __repr__(self) -> str:
        return f"<Baked tables of {self.about['planet']}: {', '.join(self.tables)}>"


def bake(
    solution: Solution | PlanetLike,
    layout: str = "bruneton",
    *,
    mapping: str = "weighted-power",
    packing: str | None = None,
    azimuth: Measure = 0.0,
    size: tuple[int, ...] | None = None,
    precision: str = "single",
    order: int | None = None,
    cumulative: bool = False,
    mu_s_min: Measure | None = None,
    higher_orders: bool = False,
    smooth_phase: str = "own",
    balance: bool = True,
    points: int = ERROR_POINTS,
    seed: int = SEED,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Baked:
    """Look-up tables of a solution by any solver, with their errors.

    Parameters
    ----------
    solution : Solution, Planet, str or Path
        Solution to bake; a planet, preset name or path is solved at the planet's wavelengths.
    layout : str
        ``bruneton``: (r, mu, mu_s, nu). ``atmosphere-plus``: (altitude, mu, mu_s).
    mapping : str
        Mapping of ``atmosphere-plus``: ``linear``, ``power`` or ``weighted-power``.
    packing : str, optional
        ``bruneton``: ``separate`` (default: single scattering by particles in a separate table) or
        ``combined`` (in alpha, colours restored at look-up). ``atmosphere-plus``: ``rgba``
        (default: particles in alpha, grey), ``separate`` or ``phase-included`` (at ``azimuth``).
    azimuth : float
        Azimuth of a ``phase-included`` table; 0 towards the sun. [deg]
    size : tuple of int, optional
        Texels along each axis; default (32, 128, 32, 8) or (32, 256, 32).
    precision : str
        Precision ``single`` or ``half``; transmittance is always single.
    order : int, optional
        Single order of scattering to include.
    cumulative : bool
        Whether all orders up to ``order`` are included.
    mu_s_min : float, optional
        Lowest cosine of the sun's zenith angle in a ``bruneton`` table, -1 to 0; default: the end
        of twilight. [1]
    higher_orders : bool
        Whether to add the ``bruneton`` table ``higher-order``: the multiple scattering that
        ``scattering`` includes, over the Rayleigh phase function.
    smooth_phase : str
        Phase function that multiplies the ``bruneton`` table ``scattering``: ``own``, its mean
        angular shape (``baking.smooth_light``), or ``rayleigh``, for Bruneton's shaders, which
        loses the forward peak of multiple scattering in dust.
    balance : bool
        Whether errors of a ``bruneton`` table along r and mu_s average to zero
        (``baking.texel_values``); otherwise texels are exact, and errors between them twice as
        large.
    points, seed : int
        Number and seed of the random points at which errors are measured.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Baked

    Raises
    ------
    ParameterError
        For an invalid choice, an order without separate results, or a planet with refraction.
    ConflictError
        If the planet has three-dimensional clouds.
    Cancelled
        If ``cancel`` returned True.

    Examples
    --------
    >>> import airlight
    >>> solution = airlight.solve("mars-rayleigh", quality="preview")
    >>> bake(solution, size=(4, 8, 4, 2), points=20)
    <Baked tables of Mars (Rayleigh): transmittance, irradiance, scattering>
    """
    solution = solution_of(solution, progress=progress, cancel=cancel)
    if solution.planet is not None:
        check_clear(solution.planet, "tables")
    warn_of_shape(solution.medium, "tables")
    require_no_refraction(solution.medium, "tables, whose look-ups draw straight lines")
    azimuth = within("azimuth", azimuth, -360.0, 360.0, "deg")
    lowest = None if mu_s_min is None else within("mu_s_min", mu_s_min, -1.0, 0.0, "1")
    where = _layout(solution, layout, mapping, azimuth, size, lowest)
    if higher_orders and layout != "bruneton":
        raise ConflictError("higher_orders", "requires layout bruneton")
    packing = _packing(layout, packing)
    if smooth_phase not in ("own", "rayleigh"):
        raise ParameterError("smooth_phase", smooth_phase, "own, rayleigh")
    if smooth_phase != "own" and layout != "bruneton":
        raise ConflictError("smooth_phase", "requires layout bruneton")
    if precision not in ("single", "half"):
        raise ParameterError("precision", precision, "single, half")
    if points < 1:
        raise ParameterError("points", points, "1 or more")
    # Light scattered again by a forward peak has the angular shape of the higher orders, which
    # would be lost with Rayleigh's phase function as divisor.
    air = AirLight(solution, order, cumulative=cumulative, peaks_once=smooth_phase == "rayleigh")
    step = _Steps(progress, cancel)
    medium = solution.medium
    groups = scattering_groups(medium, each=layout == "bruneton" and packing == "separate")
    if packing == "separate" and not air.has_first:  # nothing is left for tables of their own
        gas = PhaseFunctions(groups.phases.names[:1], groups.phases.values[:1])
        groups = ScatteringGroups((), groups.gas, gas)
    reference = int(np.argmax(medium.wavelengths))
    colours = colours_of(medium, groups, reference)
    phases, rest_shape = groups.phases, np.ones_like(groups.phases.values[0])
    if layout == "bruneton":
        phases, rest_shape = smooth_phases(
            air, groups, each=packing == "separate", rayleigh=smooth_phase == "rayleigh"
        )
    orders = described_orders(order, cumulative)
    label = Labels(medium, {"solver": solution.report.provenance, "orders": orders})
    tables = unscattered(solution, label, precision)
    scattering = _Scattering(
        air,
        where,
        groups,
        phases,
        rest_shape,
        packing,
        (colours, reference),
        step,
        higher_orders,
        balance,
    )
    for name, values, quantity, unit in scattering.tables():
        tables[name] = label.table(name, quantity, unit, where, values, precision)
    light = ScatteredLight(
        packing=packing, tables=tables, phases=phases, colours=colours, reference=reference
    )
    azimuth_of = azimuth if packing == "phase-included" else None
    errors = measured_errors(air, light, azimuth_of, ErrorSample(points, seed, step.run))
    return Baked(light=light, tables=tables, about=facts(solution, orders), errors=errors)


def _layout(
    solution: Solution,
    layout: str,
    mapping: str,
    azimuth: float,
    size: tuple[int, ...] | None,
    mu_s_min: float | None,
) -> TableLayout:
    if layout not in LAYOUT_NAMES:
        raise ParameterError("layout", layout, ", ".join(LAYOUT_NAMES))
    wanted = 4 if layout == "bruneton" else 3
    if size is not None and len(size) != wanted:
        names = "r, mu, mu_s, nu" if wanted == 4 else "altitude, mu, mu_s"
        raise ParameterError("size", size, f"{wanted} numbers of texels: {names}")
    shell: dict[str, Any] = {
        "bottom_radius": solution.medium.bottom_radius,
        "top_radius": solution.medium.top_radius,
    }
    if layout == "bruneton":
        sizes = dict(zip(("radii", "views", "sun_angles", "angles"), size or (), strict=False))
        return BrunetonLayout(**shell, **sizes, mu_s_min=mu_s_min)
    if mu_s_min is not None:
        raise ConflictError("mu_s_min", "requires layout bruneton")
    sizes = dict(zip(("altitudes", "views", "sun_angles"), size or (), strict=False))
    return AtmospherePlusLayout(**shell, **sizes, mapping=mapping, azimuth=azimuth)


def _packing(layout: str, packing: str | None) -> str:
    allowed: tuple[str, ...] = ("separate", "combined")
    if layout == "atmosphere-plus":
        allowed = ("rgba", "separate", "phase-included")
    if packing is None:
        return allowed[0]
    if packing not in allowed:
        raise ParameterError("packing", packing, f"{', '.join(allowed)} for {layout}")
    return packing


class _Steps:
    """Runner of blocks on all cores, with progress and cancellation."""

    def __init__(self, progress: Progress | None, cancel: Cancel | None) -> None:
        self.progress, self.cancel = progress, cancel

    def run(
        self, positions: Positions, make: Callable[[Positions], list[FloatArray]], message: str
    ) -> list[FloatArray]:
        """Values of ``make`` at all points, block by block; equal neighbours are computed once."""
        fresh = np.ones(len(positions), bool)
        for array in (positions.r, positions.mu, positions.mu_s, positions.nu, positions.to_ground):
            fresh[1:] &= array[1:] == array[:-1]
        fresh[1:] = ~fresh[1:]
        index = np.cumsum(fresh) - 1
        unique = positions[fresh]
        count = -(-len(unique) // _BLOCK)
        made: list[list[FloatArray]] = [[] for _ in range(count)]

        def run(block: int) -> None:
            made[block] = make(unique[block * _BLOCK : (block + 1) * _BLOCK])

        run_blocks(run, count, cancel=self.cancel, progress=self.progress, message=message)
        found = [np.concatenate(blocks) for blocks in zip(*made, strict=True)]
        out = [np.empty((len(index), *values.shape[1:])) for values in found]

        def repeat(block: int) -> None:
            rows = slice(block * _BLOCK, (block + 1) * _BLOCK)
            for values, all_values in zip(found, out, strict=True):
                np.take(values, index[rows], axis=0, out=all_values[rows], mode="clip")

        run_blocks(repeat, -(-len(index) // _BLOCK))
        return out


@dataclass(frozen=True, eq=False)
class _Scattering:
    """Tables of scattered light.

    Attributes
    ----------
    air : AirLight
        Light of the solution.
    where : TableLayout
        Layout of the tables.
    groups : ScatteringGroups
        Constituents by their phase functions.
    phases : PhaseFunctions
        Phase functions of a look-up, that of the smooth light first.
    rest_shape : array
        Shape over the scattering angle of the smooth light that is not the gas's. [sr⁻¹]
    packing : str
        See ``bake``.
    colours : (array, int)
        See ``packing.colours_of``, and the index of the reference wavelength.
    step : _Steps
        Runner of the blocks.
    higher_orders, balance : bool
        See ``bake``.
    """

    air: AirLight
    where: TableLayout
    groups: ScatteringGroups
    phases: PhaseFunctions
    rest_shape: FloatArray
    packing: str
    colours: tuple[FloatArray, int]
    step: _Steps
    higher_orders: bool
    balance: bool

    def tables(self) -> list[tuple[str, FloatArray, str, str]]:
        """Name, values, quantity and unit of each table."""
        medium = self.air.solution.medium
        smooth_is = f"{_AIR}, divided by {_DIVISORS[self.phases.names[0]]}"
        dust_is = f"{_AIR}: the particles' part, divided by their phase function"
        if self.packing == "phase-included":

            def light(block: Positions) -> list[FloatArray]:
                return [self.air.at_sun_angles(lines_of_sight(block, medium))]

            (values,) = self.step.run(self.where.positions(), light, "scattering")
            return [("scattering", values, _AIR, "sr-1")]
        if isinstance(self.where, AtmospherePlusLayout):
            return self._fitted(smooth_is, dust_is)
        return self._separated(smooth_is, f"{dust_is}, single scattering")

    def _fitted(self, smooth_is: str, dust_is: str) -> list[tuple[str, FloatArray, str, str]]:
        """Tables without the azimuth, fitted over it."""
        grey = self.packing == "rgba"

        def fit(block: Positions) -> list[FloatArray]:
            smooth, mie = fit_azimuths(self.air, block, self.groups, grey=grey)
            return [np.concatenate([smooth, mie], axis=-1)] if grey else [smooth, mie]

        fitted = self.step.run(self.where.positions(), fit, "scattering")
        note = f"; best fit over {FIT_AZIMUTHS} azimuths"
        if grey:
            return [("scattering", fitted[0], f"{smooth_is}; {dust_is}, grey{note}", "1")]
        out = [("scattering", fitted[0], smooth_is + note, "1")]
        if self.groups.particles:
            out.append(("particles", fitted[1], dust_is + note, "1"))
        return out

    def _separated(self, smooth_is: str, dust_is: str) -> list[tuple[str, FloatArray, str, str]]:
        """Tables over all angles, with the particles' single light apart."""
        groups, phases, positions = self.groups, self.phases, self.where.positions()

        def apart(block: Positions) -> list[FloatArray]:
            each = self.packing == "separate"
            separated: SeparatedLight = separate_orders(self.air, block, groups, each=each)
            mie = (separated.mie[:, k] for k in range(separated.mie.shape[1]))
            return [
                separated.rayleigh,
                separated.remainder,
                *([separated.multiple] if self.higher_orders else []),
                *mie,
            ]

        shapes = PhaseFunctions(
            (*phases.names, "gas", "rest"),
            np.stack([*phases.values, groups.phases.values[0], self.rest_shape]),
        )
        # A texel whose angle no view and sun can have holds the light at the nearest possible
        # angle, brought to its own by the light's shape.
        angles = np.linspace(-1.0, 1.0, self.where.shape[-1])
        by_rayleigh = vectorized(rayleigh)(angles, 0.0)[:, None]
        divisor, of_gas, of_rest = (
            shapes.at(name, angles) for name in (phases.names[0], "gas", "rest")
        )

        def texels(
            nu: FloatArray, gas: FloatArray, rest: FloatArray, *others: FloatArray
        ) -> list[FloatArray]:
            shape = shapes.at("rest", nu)
            near = rest / shape
            there = fill_angles(near, nu)
            turned = np.divide(there, near, out=np.ones_like(near), where=near > 0.0)
            turned = turned * of_rest / shape
            smooth = kept((gas * of_gas + rest * turned) / divisor)
            made = [smooth]
            if self.higher_orders:
                higher, others = others[0], others[1:]
                # Where the first order ends, the smooth light is shifted by more than the higher
                # orders in it, which are no more than all of it.
                made.append(
                    np.minimum(kept(higher * turned / by_rayleigh), smooth * divisor / by_rayleigh)
                )
            return [*made, *(kept(values) for values in others)]

        def kept(values: FloatArray) -> FloatArray:
            return balanced(values) if self.balance else values

        made = self.step.run(positions, apart, "scattering")
        smooth, *mie = of_views(texels, self.where.shape, positions.nu, *made)
        apart_too = []
        if self.higher_orders:
            part, *mie = mie
            quantity = f"{_AIR}: orders from the second on, divided by Rayleigh's phase function"
            apart_too.append(("higher-order", part, quantity, "1"))
        if self.packing == "combined":
            if not mie:
                mie = [np.zeros_like(smooth)]
            p_mie = shapes.at(phases.names[-1], angles)
            light = smooth * divisor + mie[0] * p_mie
            values = combine(light, mie[0], divisor, p_mie, *self.colours)
            nm = self.air.solution.medium.wavelengths[self.colours[1]]
            quantity = f"{smooth_is}; {dust_is}, at {nm:g} nm"
            return [("scattering", values, quantity, "1"), *apart_too]
        names = groups.phases.names[1:]
        return [
            ("scattering", smooth, smooth_is, "1"),
            *((name, values, dust_is, "1") for name, values in zip(names, mie, strict=True)),
            *apart_too,
        ]
