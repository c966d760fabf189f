"""Degree and angle of polarisation, of arrays and of labelled results."""

from __future__ import annotations

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose, assert_array_equal

import airlight
from airlight import ParameterError
from airlight.solver.stokes_frame import angle_of_polarisation, degree_of_polarisation


def test_degree_and_angle_are_those_that_light_was_made_of() -> None:
    # by definition Q = I p cos 2χ, U = I p sin 2χ
    degree, angle = np.meshgrid([0.1, 0.5, 1.0], np.arange(-89.0, 91.0, 7.0))
    light = 3.0 * np.stack(
        [np.ones_like(degree), *(degree * f(2.0 * np.radians(angle)) for f in (np.cos, np.sin))]
    )
    assert_allclose(degree_of_polarisation(light), degree, rtol=1e-14)
    assert_allclose(angle_of_polarisation(light), angle, atol=1e-12)


def test_without_light_or_polarisation_there_is_0_and_no_warning() -> None:
    light = np.array([[0.0, 2.0, 2.0], [0.0, 0.0, -1.0], [0.0, 0.0, -0.0]])
    assert_array_equal(degree_of_polarisation(light), [0.0, 0.0, 0.5])
    assert_array_equal(angle_of_polarisation(light), [0.0, 0.0, 90.0])


def test_results_keep_their_labels() -> None:
    values = np.arange(1.0, 13.0).reshape(2, 3, 2) * [[[1.0], [0.1], [-0.1]]]
    light = xarray.DataArray(
        values,
        dims=("azimuth", "stokes", "wavelength"),
        coords={"stokes": ["I", "Q", "U"], "wavelength": [680.0, 440.0]},
        attrs={"units": "W m-2 sr-1 nm-1", "solver": "a solver"},
    )
    degree = airlight.degree_of_polarisation(light)
    assert degree.dims == ("azimuth", "wavelength")
    assert degree.attrs["units"] == "1"
    assert degree.attrs["solver"] == "a solver"
    assert_allclose(degree, degree_of_polarisation(np.moveaxis(values, 1, 0)), rtol=1e-15)
    angle = airlight.angle_of_polarisation(light)
    assert angle.attrs["units"] == "deg"
    assert_array_equal(angle.wavelength, [680.0, 440.0])


@pytest.mark.parametrize(
    "light", [1.0, np.ones((2, 5)), xarray.DataArray(np.ones(3), dims="stokes"),
              xarray.DataArray(np.ones((3, 2)), dims=("x", "y"))],
)  # fmt: skip
def test_what_has_no_stokes_parameters_is_refused(light: object) -> None:
    with pytest.raises(ParameterError, match="allowed: I, Q and U along"):
        degree_of_polarisation(light)  # type: ignore[call-overload]
