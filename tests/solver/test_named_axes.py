"""Axes of results: named for what varies along them; labelled arrays broadcast by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray
from numpy.testing import assert_array_equal

from airlight import ParameterError
from airlight.solver.named_axes import Argument, NamedAxes


def altitude(value: Any) -> Argument:
    return Argument(value, 0.0, 1e9, "m")


def angle(value: Any) -> Argument:
    return Argument(value, 0.0, 180.0, "deg")


@pytest.mark.parametrize(
    ("height", "view", "dims", "shape"),
    [
        (0.0, 30.0, (), ()),
        (0.0, [10.0, 20.0], ("view_zenith",), (2,)),
        ([0.0, 1.0], [10.0, 20.0], ("case",), (2,)),
        ([[0.0], [1.0], [2.0]], [10.0, 20.0], ("altitude", "view_zenith"), (3, 2)),
        ([0.0], 20.0, ("altitude",), (1,)),
        (np.zeros((2, 3)), np.ones((2, 3)), ("case_1", "case_2"), (2, 3)),
        (0.0, np.ones((2, 3)), ("case_1", "case_2"), (2, 3)),
        ([], 20.0, ("altitude",), (0,)),
    ],
)
def test_an_axis_has_the_name_of_what_varies_along_it(
    height: Any, view: Any, dims: tuple[str, ...], shape: tuple[int, ...]
) -> None:
    arrays, axes = NamedAxes.of(altitude=altitude(height), view_zenith=angle(view))
    assert (axes.dims, axes.shape) == (dims, shape)
    wanted = np.broadcast_arrays(np.asarray(height, float), np.asarray(view, float))
    for array, one in zip(arrays, wanted, strict=True):
        assert_array_equal(array, one.ravel())
    values = np.zeros((int(np.prod(shape)), 2))
    made = axes.labelled(values, np.array([680.0, 440.0]), "radiance", "1")
    assert made.dims == (*dims, "wavelength")
    assert {"altitude", "view_zenith"} <= set(made.coords)


def test_coordinates_select_by_value() -> None:
    _, axes = NamedAxes.of(altitude=altitude([[0.0], [1e3]]), view_zenith=angle([10.0, 50.0]))
    made = axes.labelled(np.arange(4.0)[:, None], np.array([550.0]), "radiance", "1")
    assert float(made.sel(altitude=1e3, view_zenith=10.0).item()) == 2.0
    assert made["view_zenith"].attrs["units"] == "degree"


def test_labelled_arrays_broadcast_by_name_and_keep_their_coordinates() -> None:
    time = xarray.DataArray([1.0, 2.0, 3.0], dims="time")
    sun = xarray.DataArray([30.0, 60.0, 90.0], dims="time", coords={"time": time})
    view = xarray.DataArray([0.0, 45.0], dims="view")
    arrays, axes = NamedAxes.of(
        altitude=altitude("2 km"), sun_zenith=angle(sun), view_zenith=angle(view)
    )
    assert (axes.dims, axes.shape) == (("time", "view"), (3, 2))
    assert_array_equal(arrays[1], np.repeat([30.0, 60.0, 90.0], 2))
    assert_array_equal(arrays[2], np.tile([0.0, 45.0], 3))
    made = axes.labelled(np.arange(6.0)[:, None], np.array([550.0]), "radiance", "1")
    assert float(made.sel(time=2.0).isel(view=1).item()) == 3.0
    assert float(made["altitude"]) == 2000.0
    assert made["sun_zenith"].dims == ("time",)


def test_plain_lists_beside_labelled_arrays_get_axes_of_their_own() -> None:
    sun = xarray.DataArray([30.0, 60.0], dims="time")
    _, axes = NamedAxes.of(sun_zenith=angle(sun), view_zenith=angle([0.0, 45.0, 80.0]))
    assert dict(zip(axes.dims, axes.shape, strict=True)) == {"time": 2, "view_zenith": 3}


def test_units_of_text_and_of_labelled_arrays_are_converted() -> None:
    km = xarray.DataArray([1.0, 400.0], dims="height", attrs={"units": "km"})
    arrays, _ = NamedAxes.of(altitude=altitude(km), view_zenith=angle("0.5 rad"))
    assert_array_equal(arrays[0], [1e3, 4e5])
    assert arrays[1][0] == pytest.approx(np.degrees(0.5))
    arrays, axes = NamedAxes.of(altitude=altitude(["1 km", "20 m"]))
    assert (arrays[0].tolist(), axes.dims) == ([1000.0, 20.0], ("altitude",))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("altitude", "400 parsnips"),
        ("altitude", "400"),
        ("altitude", "30 deg"),
        ("altitude", "-1 km"),
        ("view_zenith", "4 rad"),
        ("view_zenith", [np.nan]),
        ("view_zenith", "north"),
        ("view_zenith", xarray.DataArray([1.0], dims="x", attrs={"units": "km"})),
        ("view_zenith", xarray.DataArray([1.0], dims="wavelength")),
        ("view_zenith", None),
    ],
)
def test_what_is_no_value_is_refused_by_name(field: str, value: Any) -> None:
    given: dict[str, Argument] = {"altitude": altitude(0.0), "view_zenith": angle(0.0)}
    given[field] = (altitude if field == "altitude" else angle)(value)
    with pytest.raises(ParameterError) as caught:
        NamedAxes.of(**given)
    assert field in caught.value.field
    assert "\n" not in str(caught.value)


def test_shapes_that_do_not_fit_are_named() -> None:
    with pytest.raises(ParameterError, match=r"altitude \(2,\), view_zenith \(3,\)"):
        NamedAxes.of(altitude=altitude([0.0, 1.0]), view_zenith=angle([1.0, 2.0, 3.0]))
    one, other = (xarray.DataArray(np.zeros(n), dims="time") for n in (2, 3))
    with pytest.raises(ParameterError, match=r"shapes"):
        NamedAxes.of(altitude=altitude(one), view_zenith=angle(other))
    with pytest.raises(ParameterError, match="labelled"):
        NamedAxes.of(altitude=altitude(one), view_zenith=angle(np.zeros((2, 2))))
