"""The limb: where the sun is asked for, and lines that miss."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from spheres import RADIUS, sphere

from airlight import ParameterError
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables.limb import limb_radiance


def test_a_limb_lit_from_behind_or_before_shows_the_phase_function(
    solved: Callable[..., MomentsSolution],
) -> None:
    # Thin gas, sun on the tangent point's horizon: scattering angles 0 and 180 look alike and are
    # twice as bright as 90, by Rayleigh's 1 + cos²; at 60 it is 1.25. High up the air is lit on
    # both sides of the tangent point, but for the far end of the line.
    solution = solved(sphere(1e-6, 0.0), (550.0,), "preview")
    azimuths = np.array([0.0, 60.0, 90.0, 180.0])
    radiance = limb_radiance(solution, 60e3, 90.0, azimuths)[:, 0]
    assert_allclose(radiance / radiance[2], [2.0, 1.25, 1.0, 2.0], rtol=2e-3)


def test_a_line_above_the_air_is_refused_with_the_range(
    solved: Callable[..., MomentsSolution],
) -> None:
    solution = solved(sphere(1e-6, 0.0), (550.0,), "preview")
    with pytest.raises(ParameterError, match="a higher line misses the atmosphere"):
        limb_radiance(solution, [0.0, 130e3], 60.0)
    assert limb_radiance(solution, -RADIUS, 60.0).shape == (1,)
