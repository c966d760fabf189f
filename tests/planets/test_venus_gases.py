"""What absorbs in the lower air of Venus: amounts by hand, bands beside a second source."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import load_planet
from airlight.physics.spectra.tables import read_spectrum
from airlight.planets.constituent import Constituent

#: Molecules above the ground: p/(m g), 92.1 bar, 43.45 u, 8.87 m/s² (NASA's fact sheet), more by
#: 1 % for gravity that falls within the scale height. [m⁻²]
COLUMN = 92.1e5 / (43.45 * 1.66053907e-27 * 8.87)


@pytest.fixture(scope="module")
def parts() -> dict[str, Constituent]:
    return {one.name: one for one in load_planet("venus").constituents}


@pytest.mark.parametrize(("name", "fraction"), [("air", 0.965), ("water vapour", 30e-6)])
def test_columns_are_the_weight_of_the_air(
    parts: dict[str, Constituent], name: str, fraction: float
) -> None:
    # 96.5 % of carbon dioxide (von Zahn et al. 1983), 30 ppm of water (Ignatiev et al. 1997)
    part = parts[name]
    nm = np.array([926.0])
    depth = float(part.absorption_coefficients(nm, 100e3)[0] * part.profile.column(100e3))
    cross_section = float(part.absorption.cross_sections(nm)[0])  # type: ignore[union-attr]
    assert cross_section > 0.0
    assert_allclose(depth / cross_section, fraction * COLUMN, rtol=0.02)


@pytest.mark.parametrize(("kilometres", "ppt"), [(5.0, 11.0), (15.0, 18.0)])
def test_sulphur_is_as_much_as_venera_11_saw(
    parts: dict[str, Constituent], kilometres: float, ppt: float
) -> None:
    # Krasnopolsky (2013): 11 ppt of S3 from 3 to 10 km, 18 ppt from 10 to 19 km. S4 absorbs nothing
    # at 400 nm, S3 5.7e-17 cm² (Billmers & Smith 1991).
    at = 1e3 * kilometres
    part, air = parts["sulphur vapour"], parts["air"]
    given = dict(zip(part.profile.altitudes, part.profile.densities, strict=True))  # type: ignore[attr-defined]
    beside = dict(zip(air.profile.altitudes, air.profile.densities, strict=True))  # type: ignore[attr-defined]
    local = part.absorption_coefficients(np.array([400.0]), 100e3)[0] * given[at]
    assert_allclose(local / (5.7e-21 * 9.072e26 * beside[at]), 1e-12 * ppt, rtol=0.01)


def test_water_absorbs_more_than_on_earth_by_as_much_as_pressure_does(
    parts: dict[str, Constituent],
) -> None:
    # Bird & Riordan's table is a mean over lines of a bar. Under tens of bars lines overlap and
    # shade each other less: more in each strong band, but by less than three times.
    table = read_spectrum("water-vapour-bands")
    for low, high in ((692.0, 751.0), (783.0, 842.0), (892.0, 961.0)):
        nm = np.arange(low, high)
        ours = parts["water vapour"].absorption.cross_sections(nm).mean()  # type: ignore[union-attr]
        assert 1.0 < ours / table.at(nm).mean() < 3.0


def test_bands_of_carbon_dioxide_lie_where_venus_is_dark(parts: dict[str, Constituent]) -> None:
    # The band at 869 nm, by which carbon dioxide has long been measured on Venus, is the strongest
    # below a micrometre, that at 782 nm is weaker; the source has none below 690 nm.
    at = np.array([600.0, 767.0, 867.0])
    strength = parts["air"].absorption.cross_sections(at)  # type: ignore[union-attr]
    assert strength[0] == 0.0
    assert 0.0 < strength[1] < 0.5 * strength[2]
