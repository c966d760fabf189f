"""The suite of three-dimensional clouds."""

import numpy as np
import pytest

from airlight.validation import boxes
from airlight.validation.boxes import box_consensus, compared, differences
from airlight.validation.i3rc import EXPERIMENTS
from airlight.validation.suite import SuiteRun


def test_differences_are_over_the_mean():
    assert differences(np.array([1.1, 2.1]), np.array([1.0, 2.0])) == pytest.approx(
        (100 * 0.1 / 1.5, 100 * 0.1 / 1.5)
    )


def test_boxes_pass_on_the_step_cloud(monkeypatch):
    monkeypatch.setattr(boxes, "EXPERIMENTS", EXPERIMENTS[:1])
    steps = []
    thresholds, parts = box_consensus(SuiteRun(progress=lambda *told: steps.append(told)))
    assert all(one.passed for one in thresholds), [one for one in thresholds if not one.passed]
    assert len(parts[0].rows) == 2 * len(EXPERIMENTS[0].results)
    assert steps


def test_every_published_quantity_but_absorption_is_compared():
    named = {name for experiment in EXPERIMENTS for name in experiment.results}
    assert named - {"A"} == {"R", "T", "Iu", "I601", "I602", "Id"}
    assert compared.__doc__ is not None
