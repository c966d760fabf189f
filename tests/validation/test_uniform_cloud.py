"""Uniform clouds and their one-dimensional references."""

import numpy as np
from numpy.testing import assert_allclose

from airlight.validation.reference_files import packaged_table
from airlight.validation.suite import SuiteRun
from airlight.validation.uniform_cloud import CASES, FILE, uniform_cloud


def test_references_conserve_energy():
    # Conservative clouds: what enters leaves at the top or is absorbed by the ground; 1e-4 is due
    # to the largest single-scattering albedo that the reference allows.
    table = packaged_table(FILE)
    assert_allclose(table[:, :4], np.array(CASES))
    kept = table[:, 4] + (1.0 - table[:, 3]) * table[:, 5]
    assert_allclose(kept[table[:, 2] == 1.0], 1.0, atol=1e-4)
    assert np.all(kept[table[:, 2] < 1.0] < 1.0)


def test_uniform_fields_are_those_of_one_dimension():
    thresholds, _ = uniform_cloud(SuiteRun())
    assert all(one.passed for one in thresholds), thresholds
