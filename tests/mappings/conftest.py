"""Settings of Hypothesis for the mappings."""

from __future__ import annotations

from hypothesis import settings

# The first call compiles, which takes seconds: no deadlines. A run must be repeatable.
settings.register_profile("airlight", deadline=None, derandomize=True, database=None)
settings.load_profile("airlight")
