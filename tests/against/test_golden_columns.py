"""Section 11 of the physics text: columns and transmittances of AP2's atmosphere."""

from __future__ import annotations

from collections.abc import Callable
from math import acos, degrees, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium, Planet
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.tables.column_ratios import column_rows, columns_to_top, rational_mean_density
from airlight.solver.tables.columns import ColumnTable, columns

BOTTOM, TOP = 6360e3, 6460e3
#: From the top of the shell past a lowest height of 10 km.
LIMB = -sqrt(1.0 - (6370e3 / TOP) ** 2)

#: Altitude [m], mu, length [km], columns of gas, aerosol and ozone [m], transmittance at 680, 550
#: and 440 nm: converged to 1e-13 and printed to these digits.
TABLE = [
    (0.0, 1.0, "100", ("7999.9702", "1200.0000", "15000"), (".940359", ".867616", ".762310")),
    (
        0.0, 0.5, "195.559", ("15940.456", "2398.6446", "29654.833"),
        (".884784", ".753858", ".582282"),
    ),
    (
        0.0, np.cos(np.radians(80.0)), "477.275", ("44401.444", "6869.3513", "77291.912"),
        (".712941", ".459379", ".221627"),
    ),
    (
        0.0, 0.0, "1132.254", ("282838.135", "109498.922", "173954.566"),
        (".106429", ".00957976", "5.20709e-5"),
    ),
    (
        100e3, LIMB, "2149.139", ("162195.957", "52.6818", "483614.869"),
        (".284892", ".0446471", ".00447152"),
    ),
    (
        30e3, 0.0, "948.420", ("6667.1808", "0", "158922.296"),
        (".867636", ".677513", ".791210"),
    ),
]  # fmt: skip
NAMES = ["zenith", "60 deg", "80 deg", "90 deg", "limb at 10 km", "30 km, 90 deg"]


def half_a_digit(printed: str) -> float:
    """Half a unit of the last digit of a printed number."""
    mantissa, _, exponent = printed.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 0.5 * 10.0 ** (int(exponent or 0) - decimals)


@pytest.fixture
def medium(reference_earth: Callable[..., Planet]) -> Medium:
    return Medium.from_planet(
        reference_earth(albedo=0.0, aerosol_absorption=0.444e-6), [680.0, 550.0, 440.0]
    )


@pytest.mark.parametrize("row", TABLE, ids=NAMES)
def test_columns_by_quadrature_meet_the_golden_table(
    row: tuple, medium: Medium, tell: Callable[[str], None]
) -> None:
    # An authority converged to 1e-13. Smooth profiles must meet half the last digit printed or
    # 1e-9; ozone's tent has corners inside panels, which 24 points smooth over to 1e-6.
    altitude, mu, length, expected, _ = row
    got = columns(BOTTOM + altitude, mu, 1e3 * float(length), BOTTOM, medium.density)
    # The length is printed to a metre, all of it at the top, where 1e-5 of the air is.
    error = [
        float(abs(g / float(e) - 1.0)) if float(e) else 0.0
        for g, e in zip(got, expected, strict=True)
    ]
    tell(
        f"golden columns {altitude:6.0f} m mu {mu:6.3f}: error "
        + " ".join(f"{e:.1e}" for e in error)
    )
    for value, printed, relative in zip(got, expected, (1e-9, 1e-8, 1e-6), strict=True):
        slack = half_a_digit(printed) if float(printed) else 1e-2
        assert_allclose(value, float(printed), rtol=relative, atol=1.01 * slack)


@pytest.mark.parametrize("row", TABLE, ids=NAMES)
def test_transmittances_meet_the_golden_table(
    row: tuple, reference_earth: Callable[..., Planet], solved: Callable[..., MomentsSolution]
) -> None:
    # The same authority, to one unit of its last digit or 1e-5: .106429 is printed where its own
    # columns give .1064296. Next to the tangent point 1e-9 m of radius are 0.1 m of air.
    altitude, mu, _, _, expected = row
    planet = reference_earth(albedo=0.0, aerosol_absorption=0.444e-6)
    solution = solved(planet, quality="preview")
    got = solution.transmittance(altitude=altitude, view_zenith=degrees(acos(mu))).values
    for value, printed in zip(got, expected, strict=True):
        assert_allclose(value, float(printed), rtol=1e-5, atol=2.0 * half_a_digit(printed))


def test_the_table_of_columns_is_good_to_a_thousandth(
    medium: Medium, tell: Callable[[str], None]
) -> None:
    # Second method: quadrature. What counts is the light: transmittance at the three wavelengths,
    # and each column wherever it dims the light by more than a tenth. A few rays that graze the
    # lowest haze are worse: it falls e-fold between two directions of the table.
    table = ColumnTable.build(BOTTOM, TOP, medium.density)
    rng = np.random.default_rng(5)
    altitude = 100e3 * rng.random(4000) ** 2
    r = BOTTOM + altitude
    horizon = -np.sqrt((r - BOTTOM) * (r + BOTTOM)) / r
    mu = horizon + (1.0 - horizon) * rng.random(r.size) ** 2
    mu[:200] = horizon[:200] + 1e-9
    length = -r * mu + np.sqrt((r * mu) ** 2 + (TOP - r) * (TOP + r))
    truth = columns(r, mu, length, BOTTOM, medium.density)
    got, here = np.empty_like(truth), np.empty(3)
    ratios, rows = rational_mean_density(table), column_rows(table, medium.density)
    nodes = medium.density.first_nodes
    for k in range(r.size):
        columns_to_top(r[k], mu[k], BOTTOM, TOP, nodes, rows, ratios, here)
        got[k] = here
    depth = medium.extinction.max(axis=1)
    counts = truth * depth > 0.1
    relative = np.abs(got[counts] / truth[counts] - 1.0)
    light = np.abs(np.exp(-got @ medium.extinction) - np.exp(-truth @ medium.extinction))
    tell(
        f"column table: relative error median {np.median(relative):.1e}, 99 % "
        f"{np.quantile(relative, 0.99):.1e}, max {relative.max():.1e}; transmittance 99 % "
        f"{np.quantile(light, 0.99):.1e}, max {light.max():.1e}"
    )
    assert np.quantile(light, 0.99) < 2e-4
    assert light.max() < 3e-3
    assert np.median(relative) < 2e-4
    assert np.quantile(relative, 0.99) < 1e-3
