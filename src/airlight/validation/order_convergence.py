"""Convergence of the orders of scattering: radiance of each order over the sum."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.solver import Solution
from airlight.solver.montecarlo.settings import MonteCarloSettings as MonteCarloSettings
from airlight.solver.montecarlo.solution import MonteCarloSolution
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.cases import Case, CaseLines, geometry
from airlight.validation.planets import round_earth
from airlight.validation.suite import Part, ReportPicture, ReportTable, SuiteRun, cells

FloatArray = NDArray[np.float64]

#: Solvers that compute separate orders, with their qualities.
ORDER_SOLVERS: Final[tuple[tuple[str, Any], ...]] = (
    ("direct", "default"),
    ("montecarlo", MonteCarloSettings(relative_error=0.005, most_histories=400_000)),
)
#: Wavelength of the figure, that with the strongest scattering. [nm]
WAVELENGTH: Final = 440.0
#: Largest number of orders shown.
MOST_ORDERS: Final = 10
#: Lines of sight: from the ground by day and in twilight, and from space.
CASES: Final = (
    Case(0.0, 30.0, 0.0),
    Case(0.0, 80.0, 85.0, 180.0),
    Case(0.0, 92.0, 0.0),
    Case(0.0, 96.0, 0.0),
    Case(400e3, 30.0, 180.0),
    Case(400e3, 85.0, 10e3, 0.0, "limb"),
)


def order_convergence(
    run: SuiteRun, solvers: Sequence[tuple[str, Any]] = ORDER_SOLVERS
) -> list[Part]:
    """Picture and table of the radiance of each order by each solver.

    Parameters
    ----------
    run : SuiteRun
    solvers : sequence of (str, object)
        Names and qualities.
    """
    planet = round_earth()
    shares: dict[str, FloatArray] = {}
    for done, (name, quality) in enumerate(solvers):
        run.step(done, len(solvers), f"orders by the {name} solver")
        solution = run.solve(planet, [WAVELENGTH], quality, solver=name, polarisation=False)
        shares[name] = order_shares(solution, geometry(planet, CASES))
    if not shares:
        return []
    return [_picture(shares), _table(shares)]


def order_shares(solution: Solution, where: CaseLines) -> FloatArray:
    """Radiance of orders 1, 2, … over the total, shape (orders, cases). [1]"""
    if isinstance(solution, MonteCarloSolution):  # all orders come from the same histories
        traced = solution.trace(solution.lines_of_sight(**where)[0])
        return np.asarray(traced.parts[:, :-1, 0].T / traced.total[:, 0])
    whole = solution.radiance(**where).values[:, 0]
    count = min(solution.highest_order, MOST_ORDERS)
    parts = [solution.radiance(**where, order=k + 1).values[:, 0] for k in range(count)]
    return np.asarray(np.stack(parts) / whole)


def _picture(shares: dict[str, FloatArray]) -> ReportPicture:
    title = f"Light by order of scattering, clear Earth, {WAVELENGTH:g} nm"
    figure = new_figure(title, size=(9.0, 5.2))
    panels = figure.subplots(2, 3, sharex=True, sharey=True).ravel()
    thin: Any = {"markersize": 4, "linewidth": 1.0}
    for k, (axes, case) in enumerate(zip(panels, CASES, strict=True)):
        for s, (name, values) in enumerate(shares.items()):
            orders = np.arange(1, len(values) + 1)
            bright = values[:, k] > 0.0
            style = ("o-", "x--", "s:")[s % 3]
            share = 100.0 * values[bright, k]
            axes.plot(orders[bright], share, style, color=PALETTE[s], label=name, **thin)
        axes.set_yscale("log")
        axes.set_ylim(1e-4, 200.0)
        axes.set_yticks(
            [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0], ["0.001", "0.01", "0.1", "1", "10", "100"]
        )
        axes.set_title(str(case), fontsize=8.5, color=GREY)
        grid(axes)
    panels[0].legend(loc="lower left", fontsize=9)
    figure.supxlabel("order: scattering events and reflections by the ground", fontsize=10)
    figure.supylabel("share of all light [%]", fontsize=10)
    caption = (
        "On a logarithmic scale a straight line is a constant factor from order to order, which is "
        "why a geometric tail can stand for the orders that are not computed."
    )
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def _table(shares: dict[str, FloatArray]) -> ReportTable:
    rows = []
    for k, case in enumerate(CASES):
        for name, values in shares.items():
            share = values[:, k]
            last = min(len(share), 6)
            usual = share[last - 1] / share[last - 2] if last > 1 and share[last - 2] > 0 else 0.0
            first = [f"{100 * x:.3f}" for x in share[:4]] + [""] * (4 - len(share[:4]))
            rows.append([str(case), name, *first, f"{100 * share.sum():.3f}", f"{usual:.3f}"])
    return ReportTable(
        title="Orders of scattering",
        columns=cells(
            f"line of sight | solver | order 1 [%] | 2 | 3 | 4 | first {MOST_ORDERS} [%] | "
            "factor, order 5 to 6"
        ),
        rows=rows,
        note="The same light by solvers that count it in different ways.",
    )
