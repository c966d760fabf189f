"""Properties of all figures: units on the axes, nothing cut off, nothing over the title."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets import Planet
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.studies.plots import KINDS, Choices, Work, draw
from airlight.studies.plots.order_convergence import order_convergence


def halves(lines: LinesOfSight, order: int | None) -> NDArray[np.float64]:
    """Some orders; the figure's data have a test of their own."""
    return np.full(lines.r.size, 0.5 ** (order or 1))


#: Three wavelengths, and as many as a spectral picture has. [nm]
FEW, MANY = (680.0, 550.0, 440.0), tuple(np.linspace(435.0, 685.0, 16).tolist())


@pytest.fixture(
    scope="module",
    params=[(kind, FEW) for kind in KINDS]
    + [(kind, MANY) for kind in KINDS if "quality" not in KINDS[kind].takes],
    ids=lambda pair: f"{pair[0]}-{len(pair[1])}",
)
def figure(request: pytest.FixtureRequest, planet: Planet) -> Figure:
    kind, nm = request.param
    if kind == "order-convergence":  # its solver takes longer than all others together
        return order_convergence(request.getfixturevalue("known_light")(halves, orders=6))
    takes = KINDS[kind].takes
    choices = Choices(
        quality="preview" if "quality" in takes else None,
        wavelengths=nm if "wavelengths" in takes else None,
    )
    return draw(planet, kind, choices, Work(cache=False))


def test_every_label_of_an_axis_ends_with_its_unit(figure: Figure) -> None:
    # the rule of the house; a logarithm or a count has the unit 1
    labels = [
        getattr(axes, f"get_{axis}label")()
        for axes in figure.axes
        for axis in "xyz"
        if hasattr(axes, f"get_{axis}label")
    ]
    named = [label for label in labels if label]
    assert named
    assert all(re.search(r"\[[^\]]+\]", label) for label in named), named


def test_every_panel_shows_data_and_names_its_axis(figure: Figure) -> None:
    # a panel without a label shares its axis with one that has it, above, below or beside
    for axes in figure.axes:
        if not axes.axison:
            continue
        assert axes.has_data()
        words = [axes.get_xlabel(), axes.get_ylabel(), axes.get_title()]
        groups = (axes.get_shared_x_axes(), axes.get_shared_y_axes())
        shared = [one for group in groups for one in group.get_siblings(axes)]
        words += [label for one in shared for label in (one.get_xlabel(), one.get_ylabel())]
        assert any(words) or axes.name == "polar"


def test_no_title_label_or_legend_is_cut_off_or_lies_on_the_title(figure: Figure) -> None:
    # read off the drawn figure, in pixels
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    title: Any = figure._suptitle  # type: ignore[attr-defined]
    caption: Any = figure._supxlabel  # type: ignore[attr-defined]
    texts = [title, caption]
    for axes in figure.axes:
        texts += [axes.title, axes._left_title, axes.xaxis.label, axes.yaxis.label]  # type: ignore[attr-defined]
        texts += axes.texts if not axes.axison else []
        legend = axes.get_legend()
        texts += legend.get_texts() if legend is not None else []
    over = title.get_window_extent(renderer)
    for text in texts:
        if not text.get_text():
            continue
        box = text.get_window_extent(renderer)
        inside = (box.x0, box.y0, figure.bbox.width - box.x1, figure.bbox.height - box.y1)
        assert min(inside) >= -1.0, text.get_text()
        assert text is title or not box.overlaps(over), text.get_text()


def test_the_title_names_the_planet(figure: Figure, planet: Planet) -> None:
    # but for the eye's own figure, which is no planet's
    title = figure.get_suptitle()
    assert planet.name in title or title.startswith("From wavelength to RGB")


def test_no_figure_is_left_in_pyplot(planet: Planet) -> None:
    # the object interface leaves no state behind: pyplot, if it is there at all, knows no figure
    import sys

    draw(planet, "density")
    pyplot = sys.modules.get("matplotlib.pyplot")
    assert pyplot is None or not pyplot.get_fignums()


def test_an_unknown_kind_is_refused_with_all_kinds(planet: Planet) -> None:
    with pytest.raises(
        ParameterError, match=r"KIND is 'histogram'; allowed: solar-spectrum, .*limb"
    ):
        draw(planet, "histogram")


def test_a_choice_that_a_kind_does_not_take_is_refused(planet: Planet) -> None:
    with pytest.raises(ParameterError, match="sun_zenith does not apply to density, which takes"):
        draw(planet, "density", Choices(sun_zenith=3.0))
