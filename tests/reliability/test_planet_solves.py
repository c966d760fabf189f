"""Mutated planets are solved, their light without a NaN, or refused in a line."""

from __future__ import annotations

from pathlib import Path

import pytest
from planet_files import preset_texts
from planet_solves import try_solves


@pytest.mark.slow
@pytest.mark.parametrize("count", [12, pytest.param(400, marks=pytest.mark.validation)])
def test_mutated_planets_are_solved_or_refused(count: int, tmp_path: Path) -> None:
    # the limits of time are those of scripts/soak: here kernels may be compiled, on a busy machine
    tally = try_solves(count, 47, tmp_path, preset_texts(), patience=100.0)
    assert tally.broke == []
    assert tally.tried == count
    assert tally.counts["held"] > count // 2
