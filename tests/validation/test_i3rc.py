"""Cases of I3RC: their fields and consensus results."""

import pytest
from numpy.testing import assert_allclose

from airlight.validation.i3rc import EXPERIMENTS, QUANTITIES, c1_phase, radar_cloud, step_cloud


def test_fields_have_the_published_columns():
    # Case 1: optical depths 2 and 18; case 2: 640 columns of 50 m, layers of 45 m.
    assert_allclose(
        step_cloud().column_optical_depth[[0, 15, 16, 31], 0], [2, 2, 18, 18], rtol=1e-6
    )
    field = radar_cloud()
    assert field.extinction.shape == (640, 1, 40)
    assert field.west == -16e3
    assert field.top == 40 * 45.0


@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=str)
def test_consensus_conserves_energy(experiment):
    # Mean fluxes add up to the incident one; half a per cent is the spread of the consensus.
    found = experiment.results
    assert set(found) <= set(QUANTITIES)
    assert {len(one) for one in found.values()} == {experiment.field.extinction.shape[0]}
    if {"R", "T"} <= set(found) and ("A" in found or experiment.albedo == 1.0):
        absorbed = found["A"].mean() if "A" in found else 0.0
        ground = (1.0 - experiment.ground_albedo) * found["T"].mean()
        assert found["R"].mean() + ground + absorbed == pytest.approx(1.0, abs=5e-3)


def test_c1_cloud_has_its_published_asymmetry():
    # Deirmendjian's C1 at 0.7 µm: g = 0.848 (Hansen & Travis 1974: 0.845 to 0.85 in the visible).
    assert c1_phase().moments([670.0], 1)[0, 1] == pytest.approx(0.85, abs=0.006)
