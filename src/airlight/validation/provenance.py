"""Provenance of a report: version, date, machine."""

from __future__ import annotations

import datetime
import os
import platform
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from airlight.kernel.threads import thread_count

#: Packages whose versions can change a number.
_PACKAGES = ("numpy", "numba", "scipy", "matplotlib", "miepython")


def provenance() -> Mapping[str, str]:
    """Facts needed to judge the times and to repeat the run.

    Returns
    -------
    dict
        Description of each fact, by its name.
    """
    return {
        "airlight": _version("airlight"),
        "date": datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "machine": f"{_processor()}, {thread_count()} of {os.cpu_count()} processors used",
        "system": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
        "packages": ", ".join(
            f"{name} {found}" for name in _PACKAGES if (found := _version(name)) != "unknown"
        ),
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


def _processor() -> str:
    """Name of the CPU, where the system gives it."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()
