"""Export targets: programs that load folders of files, one lazily imported module each."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Final

from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.engines.targets.target import Target

#: Modules of the programs by the names of their layouts; each has a ``TARGET``.
MODULES: Final[dict[str, str]] = {
    "takram": "takram",
    "bruneton-demo": "bruneton_demo",
    "openspace": "openspace",
    "unreal": "unreal",
    "celestia": "celestia",
    "cosmoscout": "cosmoscout",
}


def target_of(name: str) -> Target:
    """Export target by the name of its layout."""
    if name not in MODULES:
        raise ParameterError("layout", name, ", ".join(MODULES))
    found: Target = import_module(f"airlight.engines.targets.{MODULES[name]}").TARGET
    return found
