"""Section 11 of the physics text: single scattering, per irradiance of the star."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import solve
from airlight.planets import Planet
from airlight.solver.direct.settings import QUALITIES
from airlight.solver.moments.solution import MomentsSolution

#: Altitude [m], sun zenith, view zenith, azimuth [deg], gas and aerosol at 680, 550, 440 nm [sr⁻¹]
TABLE = [
    (0, 0, 0, 0, (5.185366e-3, 1.117972e-2, 2.398102e-2),
     (1.826243e-2, 1.684971e-2, 1.480460e-2)),
    (0, 60, 0, 0, (3.134886e-3, 6.446098e-3, 1.314929e-2),
     (1.123048e-4, 9.646411e-5, 7.606759e-5)),
    (0, 85, 80, 0, (1.851332e-2, 2.316154e-2, 2.202125e-2),
     (4.915177e-2, 2.350074e-2, 6.715066e-3)),
    (0, 85, 80, 180, (1.754372e-2, 2.114934e-2, 1.948629e-2),
     (8.225719e-5, 3.885843e-5, 1.083821e-5)),
    (0, 94, 0, 0, (8.23933e-5, 4.81661e-5, 9.09019e-5),
     (0.0, 0.0, 0.0)),
    (30e3, 30, 90, 90, (2.129340e-3, 4.336579e-3, 1.166657e-2),
     (0.0, 0.0, 0.0)),
    (100e3, 30, 180, 0, (4.511166e-3, 9.520487e-3, 2.097659e-2),
     (2.305006e-5, 1.972848e-5, 1.563138e-5)),
]  # fmt: skip


@pytest.mark.parametrize("quality", ["default", pytest.param("fine", marks=pytest.mark.validation)])
def test_first_order_meets_the_golden_table(
    quality: str, reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution],
    tell: Callable[[str], None],
) -> None:  # fmt: skip
    # An authority converged to 1e-6 or better. A march of the default quality reads columns that
    # are good to 1e-3 and computes in float32.
    rows = np.array([row[:4] for row in TABLE], float)
    expected = np.array([np.add(row[4], row[5]) for row in TABLE])
    got = solved(reference_earth(albedo=0.0), quality=quality, polarisation=False).radiance(
        altitude=rows[:, 0], sun_zenith=rows[:, 1], view_zenith=rows[:, 2], azimuth=rows[:, 3],
        order=1,
    )  # fmt: skip
    error = got.values / expected - 1.0
    for row, one in zip(rows, error, strict=True):
        tell(
            f"golden single scattering, {quality}: {row.tolist()} error "
            f"{np.array2string(one, precision=1)}"
        )
    assert_allclose(got.values, expected, rtol=1e-3)


def test_gas_alone_meets_its_own_column_where_absorption_is_none(
    reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # At 30 km the aerosol is 1e-11 of its ground value: taking it away changes nothing.
    row = TABLE[5]
    with_it, without = (
        solved(reference_earth(albedo=0.0, aerosol=aerosol), polarisation=False).radiance(
            altitude=row[0], sun_zenith=row[1], view_zenith=row[2], azimuth=row[3], order=1
        )
        for aerosol in ("cornette-shanks", None)
    )
    assert_allclose(without.values, row[4], rtol=1e-3)
    assert_allclose(with_it.values, without.values, rtol=1e-5)


@pytest.mark.slow
def test_direct_solver_meets_the_golden_table(reference_earth: Callable[..., Planet]) -> None:
    # Order 1 is integrated along the line itself by nested trapezoids, 96 graded steps on each leg.
    rows = np.array([row[:4] for row in TABLE], float)
    expected = np.array([np.add(row[4], row[5]) for row in TABLE])
    settings = replace(QUALITIES["preview"], steps=96, orders=1)
    got = solve(
        reference_earth(albedo=0.0), quality=settings, solver="direct", cache=False
    ).radiance(
        altitude=rows[:, 0], sun_zenith=rows[:, 1], view_zenith=rows[:, 2], azimuth=rows[:, 3],
        order=1,
    )  # fmt: skip
    assert_allclose(got.values, expected, rtol=2e-4)
