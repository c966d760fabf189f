"""The golden suite passes as it is shipped, and fails where a number is wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import Cancelled
from airlight.validation.golden import QUANTITIES, golden
from airlight.validation.golden_numbers import (
    Group,
    compare,
    golden_groups,
    last_digit,
)
from airlight.validation.suite import SuiteRun

#: Groups that take no solution: quick enough to be perturbed one by one.
QUICK = [
    group
    for group in golden_groups()
    if group.name not in ("transmittances", "first-order")
    and not group.name.startswith("single-scattering")
]


def changed(group: Group, row: int, column: int, printed: str) -> Group:
    old = group.rows[row]
    numbers = (*old.printed[:column], printed, *old.printed[column + 1 :])
    rows = (*group.rows[:row], replace(old, printed=numbers), *group.rows[row + 1 :])
    return replace(group, rows=rows)


def test_every_golden_number_is_met():
    # Authorities, named in the file; the suite is one of the project's own checks.
    suite = golden(SuiteRun())
    missed = [threshold.name for threshold in suite.thresholds if not threshold.passed]
    assert not missed
    assert suite.passed
    assert sum(len(part.rows) for part in suite.parts) > 200


@pytest.mark.parametrize("group", QUICK, ids=lambda group: group.name)
def test_a_number_that_is_off_by_ten_times_what_is_allowed_is_missed(group):
    # The reverse of the claim above: no tolerance is so wide that it lets anything pass.
    row = len(group.rows) - 1
    allowed = max(float(group.rows[row].allowed[0]), 1e-6)
    wrong = f"{group.rows[row].expected[0] + 10.0 * allowed:.12e}"
    suite = golden(SuiteRun(), groups=[changed(group, row, 0, wrong)])
    assert not suite.passed
    assert "missed" in str(suite.parts[0].rows)
    assert "fail" in suite.parts[0].marks


def test_the_suns_colour_is_compared_as_float32_bit_for_bit():
    # One unit in the last place of float32 must be seen.
    group = next(group for group in golden_groups() if group.name == "sun-color-float32")
    next_float = np.nextafter(np.float32(213.865952), np.float32(np.inf))
    suite = golden(SuiteRun(), groups=[changed(group, 0, 0, f"{float(next_float):.9f}")])
    assert [threshold.result for threshold in suite.thresholds] == [1]


def test_last_digit_of_a_printed_number():
    # By counting digits.
    printed = ["5.20709e-5", "28.710", "133100", "0"]
    assert_allclose([last_digit(x) for x in printed], [1e-10, 1e-3, 1.0, 0.0], rtol=1e-12)


def test_no_number_is_no_match():
    group = QUICK[0]
    nothing = [np.full(len(row.printed), np.nan) for row in group.rows]
    assert not any(one.passed for one in compare(group, nothing))


def test_every_group_has_a_source_a_reason_and_something_that_computes_it():
    for group in golden_groups():
        assert group.source, group.name
        assert group.reason, group.name
        assert group.name in QUANTITIES


def test_sums_of_single_scattering_follow_from_their_parts():
    groups = {group.name: group for group in golden_groups()}
    parts = [groups[f"single-scattering-{name}"].rows for name in ("gas", "aerosol")]
    for row, gas, aerosol in zip(groups["first-order"].rows, *parts, strict=True):
        assert_allclose(row.expected, gas.expected + aerosol.expected, rtol=1e-6)


def test_golden_stops_when_asked():
    with pytest.raises(Cancelled):
        golden(SuiteRun(cancel=lambda: True))
