"""Error bars that hold: parameters of synthetic skies are within them as often as they say."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from synthetic_sky import PLANET, clean_sky, noisy

from airlight.studies.fit.fit_sky import fit_radiances
from airlight.studies.fit.settings import FitSettings

#: Parameters of the truth, far from those of the planet that the fit begins with.
FREE = ("aerosol.optical_depth", "aerosol.phase_function.asymmetry", "ozone.optical_depth",
        "ground.albedo")  # fmt: skip
CHANGES = {"aerosol.amount": 20.0, "aerosol.phase_function.asymmetry": 0.7, "ozone.amount": 1.5,
           "ground.albedo": 0.3}  # fmt: skip


def truth() -> np.ndarray:
    """True values, by the columns that the file declares."""
    from airlight.planets import Medium, load_planet

    medium = Medium.from_planet(load_planet(PLANET, CHANGES), [550.0])
    depth = medium.vertical_optical_depth[:, 0]
    names = list(medium.names)
    return np.array([depth[names.index("aerosol")], 0.7, depth[names.index("ozone")], 0.3])


def pulls(seeds: range) -> np.ndarray:
    """Distances from the truth in error bars, shape (draws, parameters)."""
    clean, right = clean_sky(CHANGES), truth()
    found = []
    for seed in seeds:
        sky = fit_radiances(PLANET, noisy(clean, seed), FitSettings(free=FREE, quality="preview"))
        found.append((sky.fitted.values - right) / sky.fitted.errors.standard)
    return np.array(found)


@pytest.mark.validation
def test_error_bars_cover_the_truth_in_68_of_100_skies(tell: Callable[[str], None]) -> None:
    # A law: a Gaussian is within one standard deviation of its mean in 68.3 % of all cases. Of 100
    # draws that count errs by 4.7 %, so that 10 % is the bound for each parameter.
    got = pulls(range(100))
    inside = (np.abs(got) < 1.0).mean(axis=0)
    for name, share, mean, width in zip(FREE, inside, got.mean(0), got.std(0), strict=True):
        tell(f"fit, {name}: {share:.0%} within the error bar, pull {mean:+.2f} ± {width:.2f}")
    assert_allclose(inside, 0.683, atol=0.1)
    assert_allclose(got.std(axis=0), 1.0, atol=0.2)
