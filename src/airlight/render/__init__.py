"""CPU rendering of a solution and a scene to a frame of linear radiance.

``airlight.render`` is the function ``render.render``; as the import of this package replaces it,
the package is callable.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from airlight.render.render import render
from airlight.scene.frame import Frame

__all__ = ["Frame", "render"]


class _CallablePackage(ModuleType):
    """Package that is callable as its function."""

    def __call__(self, *arguments: Any, **options: Any) -> Frame:
        return render(*arguments, **options)


sys.modules[__name__].__class__ = _CallablePackage
