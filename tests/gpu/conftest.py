"""A device for the tests: any adapter, one in software too."""

from __future__ import annotations

import os

import pytest

from airlight.gpu.device import Device, NoDevice, open_device


@pytest.fixture(scope="session")
def device() -> Device:
    """The device; without one the tests skip with the reason, in CI they fail."""
    try:
        return open_device()
    except NoDevice as reason:
        if os.environ.get("CI") or os.environ.get("AIRLIGHT_REQUIRE_GPU"):
            pytest.fail(str(reason))
        pytest.skip(str(reason))
