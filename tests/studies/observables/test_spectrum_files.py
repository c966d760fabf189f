"""Spectra on disk: what is written is what is read back."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose

from airlight import FileError, load_planet
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables import observe
from airlight.studies.observables.spectrum_files import write_spectrum


@pytest.fixture
def curve(solved: Callable[..., MomentsSolution]) -> xarray.Dataset:
    solution = solved(load_planet("earth-bruneton"), (680.0, 550.0, 440.0), "preview")
    return observe(solution, "disc", phase_angles=[0.0, 90.0])


def test_csv_has_a_row_for_each_angle_and_wavelength(curve: xarray.Dataset, tmp_path: Path) -> None:
    write_spectrum(tmp_path / "disc.csv", curve)
    lines = (tmp_path / "disc.csv").read_text(encoding="utf-8").splitlines()
    head = [line for line in lines if line.startswith("#")]
    assert any("unit of radiance: W m-2 sr-1 nm-1" in line for line in head)
    assert any("notes: per disc of the ground's radius" in line for line in head)
    body = "\n".join(lines[len(head) :])
    rows = np.genfromtxt(io.StringIO(body), delimiter=",", names=True)
    assert rows.dtype.names[:2] == ("phase_angle", "wavelength")
    assert rows.size == 6
    for row in rows:
        one = curve.sel(phase_angle=row["phase_angle"], wavelength=row["wavelength"])
        assert_allclose(row["reflectance"], one["reflectance"], rtol=1e-7)


def test_scalars_stand_in_the_header(
    solved: Callable[..., MomentsSolution], tmp_path: Path
) -> None:
    solution = solved(load_planet("earth-bruneton"), (680.0, 550.0, 440.0), "preview")
    data = observe(solution, "bond-albedo")
    write_spectrum(tmp_path / "bond.csv", data)
    text = (tmp_path / "bond.csv").read_text(encoding="utf-8")
    assert f"# bond_albedo: {float(data['bond_albedo']):.8g} 1 (mean over" in text


def test_netcdf_keeps_numbers_units_and_notes(curve: xarray.Dataset, tmp_path: Path) -> None:
    write_spectrum(tmp_path / "disc.nc", curve)
    with xarray.open_dataset(tmp_path / "disc.nc", engine="scipy") as back:
        assert_allclose(back["reflectance"], curve["reflectance"])
        assert back["radiance"].attrs["units"] == "W m-2 sr-1 nm-1"
        assert back.attrs["notes"] == curve.attrs["notes"]
        assert back["wavelength"].attrs["units"] == "nm"


def test_another_suffix_is_refused_and_nothing_is_written(
    curve: xarray.Dataset, tmp_path: Path
) -> None:
    with pytest.raises(FileError, match=r"\.csv, \.nc"):
        write_spectrum(tmp_path / "disc.xlsx", curve)
    assert not list(tmp_path.iterdir())
