"""Odd command lines end with their result or with one line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from command_lines import try_lines


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks a process for each line")
@pytest.mark.parametrize("count", [8, pytest.param(400, marks=pytest.mark.validation)])
def test_odd_command_lines_hold_or_are_refused_in_a_line(count: int, tmp_path: Path) -> None:
    tally = try_lines(count, 20261, tmp_path, seconds=60.0)
    assert tally.broke == []
    assert tally.tried == count
    assert tally.counts["refused"] > count // 4
