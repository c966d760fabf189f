"""CPU rendering of a solution and a scene to a frame of linear radiance.

``airlight.render(solution, scene)`` is the function ``render.render``. Importing this package also
makes it the attribute ``render`` of ``airlight``; hence the package is callable as that function.
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
