"""Observables: quantities that a telescope measures of a planet that it cannot resolve, or limb."""

from airlight.observables.observe import KINDS, observe

__all__ = ["KINDS", "observe"]
