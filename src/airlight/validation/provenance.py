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
    """Provenance of a run: version, date, machine, as texts by name."""
    return {
        "airlight": _version("airlight"),
        "date": datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "machine": f"{_cpu_name()}, {thread_count()} of {os.cpu_count()} cores used",
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


def _cpu_name() -> str:
    """Name of the CPU, if known."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()
