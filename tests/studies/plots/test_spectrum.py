"""Figures of observables show the numbers of the spectrum."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.solver.solution import Solution
from airlight.studies.observables import KINDS, observe
from airlight.studies.plots.figure import write_figure
from airlight.studies.plots.spectrum import COLOR_BARS, spectrum


@pytest.mark.parametrize("of", list(KINDS))
def test_each_observable_has_a_figure_of_its_own_numbers(of: str, solution: Solution) -> None:
    few: dict[str, Any] = {"phase-curve": {"phase_angles": [0.0, 90.0, 150.0]}, "limb": {
        "tangent_heights": [0.0, 20e3, 60e3]}}.get(of, {})  # fmt: skip
    data = observe(solution, of, **few)
    figure = spectrum(data)
    (axes,) = figure.axes
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    line = axes.get_lines()[0]
    x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    shown = data[COLOR_BARS[of]]
    if of == "limb":
        assert_allclose(x, shown.values[:, 0])
        assert_allclose(y, [0.0, 20.0, 60.0])
    elif of == "phase-curve":
        assert_allclose(x, [0.0, 90.0, 150.0])
        assert_allclose(y, shown.values[:, 0])
    else:
        order = np.argsort(data["wavelength"].values)
        assert_allclose(x, data["wavelength"].values[order])
        factor = 1e-3 if of == "transmission" else 1.0
        assert_allclose(y, factor * np.atleast_2d(shown.values)[0][order])
    write_figure(figure, io.BytesIO(), "svg", 72.0)
