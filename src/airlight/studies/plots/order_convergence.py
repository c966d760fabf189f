"""Convergence of the orders of scattering."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.solution import Solution
from airlight.studies.plots.figure import LINE_STYLES, PALETTE, chosen, grid, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Lines of sight: name, altitude as a fraction of the shell, view zenith angle, azimuth. [1], [deg]
SIGHTS: Final = (
    ("ground, zenith", 0.0, 0.0, 0.0),
    ("ground, 85° across the sun", 0.0, 85.0, 90.0),
    ("ground, 85° towards the sun", 0.0, 85.0, 0.0),
    ("space, nadir", 1.0, 180.0, 0.0),
)
#: Largest number of orders drawn.
_MOST_ORDERS: Final = 30
#: Upper limit of the tail's ratio. [1]
_LARGEST_RATIO: Final = 0.98


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """Radiance by order along some lines of sight.

    Attributes
    ----------
    radiance : array, shape (orders, lines, nl)
        Radiance of each order. [W m⁻² sr⁻¹ nm⁻¹]
    ratio : array, shape (lines, nl)
        Ratio of the last order to the previous one. [1]
    tail : array, shape (lines, nl)
        Sum of the orders beyond the last, as a geometric series of that ratio. [W m⁻² sr⁻¹ nm⁻¹]
    rest : array, shape (orders, lines, nl)
        Remainder after each order, tail included, relative to the total. [1]
    """

    radiance: FloatArray
    ratio: FloatArray
    tail: FloatArray
    rest: FloatArray


def convergence(radiance: FloatArray) -> Convergence:
    """Convergence, with an estimate of the orders that were not computed.

    Parameters
    ----------
    radiance : array, shape (orders, lines, nl)
        Radiance of the first, second, … order; at least two. [W m⁻² sr⁻¹ nm⁻¹]

    Examples
    --------
    >>> halves = convergence(0.5 ** np.arange(4.0).reshape(4, 1, 1))  # 1 + 1/2 + 1/4 + … = 2
    >>> halves.tail.item(), halves.rest[:, 0, 0].tolist()
    (0.125, [0.5, 0.25, 0.125, 0.0625])
    """
    last, before = radiance[-1], radiance[-2]
    ratio = np.divide(last, before, out=np.zeros_like(last), where=before > 0.0)
    ratio = np.clip(ratio, 0.0, _LARGEST_RATIO)
    tail = last * ratio / (1.0 - ratio)
    # Summed from the last order, so that small remainders are sums of small numbers.
    after = np.cumsum(np.concatenate([tail[None], radiance[:0:-1]]), axis=0)[::-1]
    whole = after[0] + radiance[0]
    rest = np.divide(after, whole, out=np.zeros_like(after), where=whole > 0.0)
    return Convergence(radiance=radiance, ratio=ratio, tail=tail, rest=rest)


def order_convergence(
    solution: Solution,
    *,
    sun_zenith: float = 60.0,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Figure:
    """Radiance by order, and the remainder after each, for some lines of sight.

    Parameters
    ----------
    solution : Solution
        Solution by a solver with separate orders: ``direct`` or ``montecarlo``.
    sun_zenith : float
        Solar zenith angle at the observer. [deg]

    Returns
    -------
    Figure
        The radiance by order above and the relative remainder below, for at most three wavelengths;
        dashed, the geometric series for the orders beyond the last.
    """
    if solution.highest_order < 2:
        raise ParameterError(
            "solution",
            solution.report.solver,
            "a solution with scattering orders, by direct or montecarlo",
        )
    orders = np.arange(1, min(solution.highest_order, _MOST_ORDERS) + 1)
    share, view, azimuth = (np.array([one[k] for one in SIGHTS]) for k in (1, 2, 3))
    values = []
    for order in orders:
        if cancel is not None and cancel():
            raise Cancelled("order convergence")
        seen = solution.radiance(
            altitude=share * solution.medium.thickness,
            sun_zenith=sun_zenith,
            view_zenith=view,
            azimuth=azimuth,
            order=int(order),
        )
        values.append(np.asarray(seen))
        if progress is not None:
            progress(int(order), orders.size, "radiance by order")
    found = convergence(np.stack(values))
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: orders of scattering",
        f"Solver {solution.report.solver}, sun zenith angle {sun_zenith:.4g}°; "
        "ground bounces count. Dotted: geometric series of the last ratio.",
        size=(8.0, 6.4),
    )
    shown = chosen(solution.wavelengths, 3)
    heads = figure.add_gridspec(2, 1, height_ratios=[0.06, 1.0])
    panels = heads[1].subgridspec(2, len(shown)).subplots(sharex=True, sharey="row", squeeze=False)
    beyond = np.arange(0, max(3, orders.size // 3) + 1)
    for column, k in enumerate(shown):
        upper, lower = panels[:, column]
        for index, (words, *_) in enumerate(SIGHTS):
            look = {"color": PALETTE[index], "linewidth": 1.6}
            marks = {"linestyle": LINE_STYLES[index], "marker": "osD^"[index], "markersize": 4}
            falling = found.ratio[index, k] ** beyond
            for axes, curve in (
                (upper, found.radiance[:, index, k]),
                (lower, found.rest[:, index, k]),
            ):
                shown_curve = np.where(curve > 0.0, curve, np.nan)
                axes.plot(orders, shown_curve, label=words, **look, **marks)
                axes.plot(orders[-1] + beyond, shown_curve[-1] * falling, linestyle=":", **look)
        upper.set_title(f"{solution.wavelengths[k]:.4g} nm", fontsize=10)
        lower.set_xlabel("order [1]")
        for axes in (upper, lower):
            grid(axes)
            axes.set_yscale("log")
            axes.xaxis.get_major_locator().set_params(integer=True)
    panels[0, 0].set_ylabel("radiance of one order\n[W m⁻² sr⁻¹ nm⁻¹]")
    panels[1, 0].set_ylabel("rest after this order\n/ whole [1]")
    legend = figure.add_subplot(heads[0])
    legend.set_axis_off()
    legend.legend(*panels[0, 0].get_legend_handles_labels(), loc="center", ncols=4, fontsize=8.5)
    return figure
