"""Cloud files: units, axes, liquid water by Mie theory, conserved columns, rejected files."""

import numpy as np
import pytest
import xarray as xr

from airlight.clouds.cloud_files import (
    cloud_data,
    extinction_efficiency,
    read_cloud_file,
    standard_air_density,
)
from airlight.errors import AirlightError
from airlight.planets.clouds import CloudFile

ANY = CloudFile(file="any.nc", effective_radius=8e-6)
RNG = np.random.default_rng(3)


def _les(values=None, name="extinction", units="m-1", **coordinates):
    values = RNG.random((4, 6, 5)) * 1e-2 if values is None else values
    axes = {
        "x": (np.arange(4) * 100.0 + 50.0, "m"),
        "y": (np.arange(6) * 100.0 + 50.0, "m"),
        "z": (np.arange(5) * 40.0 + 820.0, "m"),
        **coordinates,
    }
    return xr.Dataset(
        {name: (("x", "y", "z"), values, {"units": units})},
        {key: ((key,), one, {"units": unit}) for key, (one, unit) in axes.items()},
    )


@pytest.mark.parametrize("kind", ["NETCDF3_64BIT", "NETCDF4", "zarr"])
def test_extinction_of_a_file_is_that_of_the_field(tmp_path, kind):
    data = _les().transpose("z", "y", "x").expand_dims("time")
    path = tmp_path / "clouds"
    if kind == "zarr":
        data.to_zarr(path, consolidated=False)
    else:
        engine = "scipy" if kind.startswith("NETCDF3") else None
        data.to_netcdf(path, format=kind, engine=engine)
    field, radius = read_cloud_file(CloudFile(file=str(path)), latitude=10.0, longitude=200.0)
    expected = data["extinction"].values[0].transpose(2, 1, 0)
    np.testing.assert_allclose(field.extinction, expected, rtol=1e-6)
    assert field.spacing == (100.0, 100.0, pytest.approx(40.0))
    assert (field.base, field.latitude, field.longitude) == (800.0, 10.0, -160.0)
    assert radius == CloudFile(file="x").effective_radius


def test_large_droplets_extinguish_twice_their_cross_section():
    # van de Hulst (1957), section 17.25: Q = 2 + 2 s x^(-2/3), with s of about 1
    for radius in (4e-6, 8e-6):
        x = 2.0 * np.pi * radius / 550e-9
        excess = extinction_efficiency(radius, 1 / 9) - 2.0
        assert 0.7 < excess / (2.0 * x ** (-2.0 / 3.0)) < 1.3


@pytest.mark.parametrize(
    ("name", "units", "factor"),
    [("lwc", "g m-3", 1e-3), ("ql", "kg kg-1", None), ("clwc", "g/kg", None), ("qc", "kg/m3", 1.0)],
)
def test_liquid_water_extinguishes_by_mie_theory(name, units, factor):
    water = RNG.random((4, 6, 5))
    water = water if units.startswith("g") else water * 1e-3
    field, _ = cloud_data(_les(water, name, units), ANY)
    if factor is None:
        factor = standard_air_density(np.arange(5) * 40.0 + 820.0)
        factor = factor * (1e-3 if units == "g/kg" else 1.0)
    expected = 0.75 * extinction_efficiency(8e-6, 1 / 9) * water * factor / (1000.0 * 8e-6)
    np.testing.assert_allclose(field.extinction, expected, rtol=1e-5)


def test_effective_radius_and_density_of_the_file_are_used():
    data = _les(np.full((4, 6, 5), 1e-3), "ql", "kg kg-1")
    radii = np.full((4, 6, 5), 4.0)
    radii[2:] = 8.0
    data["reff"] = (("x", "y", "z"), radii, {"units": "um"})
    data["rho"] = (("z",), np.linspace(1.2, 1.0, 5), {"units": "kg m-3"})
    field, radius = cloud_data(data, ANY)
    for part, r in ((0, 4e-6), (3, 8e-6)):
        expected = 0.75 * extinction_efficiency(r, 1 / 9) * 1e-3 / (1000.0 * r)
        np.testing.assert_allclose(
            field.extinction[part, 0], expected * np.linspace(1.2, 1.0, 5), rtol=1e-4
        )
    assert 4e-6 < radius < 6e-6  # weighted by extinction, twice as large for the smaller


def test_uneven_levels_keep_the_optical_depth_of_columns():
    up = np.array([100.0, 120.0, 160.0, 230.0, 350.0])
    data = _les(z=(up, "m"))
    edges = np.array([90.0, 110.0, 140.0, 195.0, 290.0, 410.0])
    expected = data["extinction"].values @ np.diff(edges)
    np.testing.assert_allclose(
        cloud_data(data, ANY).field.column_optical_depth, expected, rtol=1e-5
    )


def test_descending_and_named_axes_are_put_in_order():
    data = _les()
    turned = data.isel(y=slice(None, None, -1), z=slice(None, None, -1))
    turned = turned.rename(x="west_east", y="south_north", z="height").transpose()
    np.testing.assert_array_equal(
        cloud_data(turned, ANY).field.extinction, cloud_data(data, ANY).field.extinction
    )


def test_longitude_and_latitude_are_projected_about_their_middle():
    longitude = 10.0 + np.linspace(-0.1, 0.1, 41)
    latitude = 60.0 + np.linspace(-0.05, 0.05, 21)
    values = np.zeros((41, 21, 5)) + longitude[:, None, None] - 9.0
    data = xr.Dataset(
        {"ext": (("lon", "lat", "z"), values, {"units": "1/m"})},
        {
            "lon": (("lon",), longitude, {"units": "degrees_east"}),
            "lat": (("lat",), latitude, {"units": "degrees_north"}),
            "z": (("z",), np.arange(5) * 40.0 + 820.0, {"units": "m"}),
        },
    )
    field, _ = cloud_data(data, ANY, radius=6.4e6)
    assert (field.latitude, field.longitude) == (pytest.approx(60.0), pytest.approx(10.0))
    # a hundredth of a degree eastwards of 60° N is R cos(60°) times that
    east = 6.4e6 * np.radians(0.05) * 0.5
    assert field.at(np.array(east), np.array(0.0), np.array(900.0)) == pytest.approx(1.05, abs=1e-4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda d: d.rename(extinction="theta"),
            "variables is 'theta'; allowed: one of extinction",
        ),
        (lambda d: d.assign(extinction=-d.extinction.assign_attrs(units="1/m")), "units|0 or more"),
        (lambda d: d.assign(extinction=d.extinction * np.nan), "units of extinction|finite"),
        (lambda d: _les(d.extinction.values * np.nan), "finite numbers"),
        (lambda d: _les(-d.extinction.values), "0 or more"),
        (lambda d: _les(units=""), "units of extinction is 'missing'"),
        (lambda d: _les(units="K"), "units of extinction is 'K'"),
        (lambda d: d.rename(x="a"), "dimension of extinction is 'a"),
        (lambda d: d.rename(x="lon_2", y="lon"), "one axis x"),
        (lambda d: d.isel(z=0), "three: x, y and z"),
        (lambda d: d.drop_vars("z"), "coordinate z"),
        (lambda d: _les(z=(np.arange(5), "hPa")), "units of z is 'hPa'"),
        (lambda d: _les(z=(np.array([0, 2, 1, 3, 4]), "m")), "ascending"),
        (lambda d: _les(x=(np.array([0, 1, 2, 5]), "m")), "regular grid"),
        (lambda d: xr.concat([d, d], "time"), r"time \(2\)"),
        (lambda d: _les(name="ql", units="K"), "units of ql"),
    ],
)
def test_an_invalid_field_gets_one_line(change, message):
    with pytest.raises(AirlightError, match=message) as error:
        cloud_data(change(_les()), ANY)
    assert "\n" not in str(error.value)


def test_other_files_get_one_line(tmp_path):
    text, empty, torn = tmp_path / "a.nc", tmp_path / "b.zarr", tmp_path / "c.nc"
    text.write_text("no clouds")
    empty.mkdir()
    _les().to_netcdf(torn, format="NETCDF3_64BIT", engine="scipy")
    torn.write_bytes(torn.read_bytes()[:300])
    for path in (text, empty, torn, tmp_path / "none.nc"):
        with pytest.raises(AirlightError) as error:
            read_cloud_file(CloudFile(file=str(path)))
        assert path.name in str(error.value)
        assert "\n" not in str(error.value)


def test_a_field_larger_than_allowed_is_rejected_unread():
    huge = np.broadcast_to(np.float32(0.0), (2048, 2048, 128))
    data = xr.Dataset(
        {"extinction": (("x", "y", "z"), huge, {"units": "1/m"})},
        {
            name: ((name,), np.arange(size) * 10.0, {"units": "m"})
            for name, size in zip("xyz", huge.shape, strict=True)
        },
    )
    with pytest.raises(AirlightError, match="at most 268435456 cells"):
        cloud_data(data, ANY)


def test_a_file_of_generated_clouds_gives_them_back(tmp_path):
    import importlib.util
    from pathlib import Path

    from airlight.clouds.cloud_types import cloud_field
    from airlight.planets.clouds import CumulusHumilis

    source = Path(__file__).parents[2] / "builders" / "les_clouds.py"
    spec = importlib.util.spec_from_file_location("les_clouds", source)
    builder = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(builder)
    clouds = CumulusHumilis(effective_radius=8e-6)
    builder.les_like(clouds, size=3200.0).to_netcdf(tmp_path / "les.nc", engine="scipy")
    field, radius = read_cloud_file(CloudFile(file=str(tmp_path / "les.nc"), beyond="periodic"))
    expected = cloud_field(clouds, size=3200.0)
    np.testing.assert_allclose(field.extinction, expected.extinction, rtol=1e-4, atol=1e-9)
    assert (radius, field.base, field.beyond) == (pytest.approx(8e-6), 1000.0, "periodic")
