"""Picture of the differences between solvers, case by case."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.agreement import Agreement
from airlight.validation.cases import Case
from airlight.validation.suite import ReportPicture


def agreement_picture(
    planet: str, pairs: Sequence[Agreement], cases: Sequence[Case]
) -> ReportPicture:
    """Plot the differences of each pair over the cases in their order, with the noise as bars."""
    title = f"How far the solvers differ: {planet}"
    figure = new_figure(title, size=(9.5, 1.4 + 2.1 * len(pairs)))
    panels = np.atleast_1d(figure.subplots(len(pairs), 1, sharex=True, sharey=True))
    for axes, pair in zip(panels, pairs, strict=True):
        at = np.arange(len(cases), dtype=float)
        for c in range(pair.relative.shape[1]):
            seen = pair.judged[:, c]
            noise = 3.0 * pair.noise[:, c] / np.maximum(pair.second.radiance[:, c], 1e-300)
            axes.errorbar(
                at[seen] + 0.22 * (c - 1), 100.0 * pair.relative[seen, c],
                yerr=100.0 * noise[seen], fmt="o", markersize=2.6, linewidth=0.8,
                color=PALETTE[(1, 2, 0)[c % 3]],
            )  # fmt: skip
        axes.axhspan(-1.0, 1.0, color="#eeeeee")
        axes.set_ylim(-4.0, 4.0)
        axes.set_title(f"{pair.name} [%]", fontsize=9.5, color=GREY, loc="left")
        for k in range(1, len(cases)):
            if cases[k].observer != cases[k - 1].observer:
                axes.axvline(k - 0.5, color=GREY, linewidth=0.7)
        grid(axes)
    starts = [k for k in range(len(cases)) if not k or cases[k].observer != cases[k - 1].observer]
    names = [
        "top" if cases[k].observer == "top" else f"{float(cases[k].observer) / 1e3:g} km"
        for k in starts
    ]
    panels[-1].set_xticks(starts, names, fontsize=8.5)
    panels[-1].set_xlabel("lines of sight in the grid's order, by the observer's altitude")
    caption = (
        "Grey: 1 %. Lines: three standard errors of the Monte Carlo. Red, green, blue: 680, 550, "
        "440 nm. Within an observer the sun sinks from left to right. Points beyond 4 % are in the "
        "table of the worst values."
    )
    return ReportPicture.from_figure(figure, title=title, caption=caption)
