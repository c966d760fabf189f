"""Gauss-Legendre rules are exact for the polynomials that they promise."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.quadrature import gauss_legendre


@pytest.mark.parametrize("count", [1, 2, 5, 10, 24, 64, 200])
def test_rule_integrates_powers_to_twice_its_nodes(count: int) -> None:
    # ∫₀¹ x^k dx = 1/(k+1), for k up to 2n - 1.
    rule = gauss_legendre(count)
    powers = np.arange(2 * count)
    assert_allclose(
        rule.nodes[None, :] ** powers[:, None] @ rule.weights, 1.0 / (powers + 1.0), rtol=5e-12
    )


@pytest.mark.parametrize("count", [1, 2, 5, 10, 24, 64])
def test_running_integrals_are_exact_below_the_number_of_nodes(count: int) -> None:
    # ∫₀ˣ t^k dt = x^(k+1)/(k+1), for k up to n - 1.
    rule = gauss_legendre(count)
    for power in range(count):
        expected = rule.nodes ** (power + 1) / (power + 1)
        assert_allclose(rule.running @ rule.nodes**power, expected, rtol=0, atol=2e-14)


def test_rules_cannot_be_changed_by_those_who_share_them() -> None:
    rule = gauss_legendre(4)
    assert gauss_legendre(4) is rule
    with pytest.raises(ValueError, match="read-only"):
        rule.nodes[0] = 0.5
