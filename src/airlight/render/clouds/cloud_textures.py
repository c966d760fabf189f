"""Textures of shaders that hold the tables of clouds."""

from __future__ import annotations

from typing import Final

from airlight.kernel.shader_fields import InTexture

#: Tables of numbers with one, two and three axes.
LINE: Final = InTexture("cloud_cells")
PLANE: Final = InTexture("cloud_cells", 2)
VOLUME: Final = InTexture("cloud_cells", 3)
#: Tables of four wavelengths with one and two axes, and multiple scattering, of the box and of
#: the finer one, with its terms one after another in the columns.
SPECTRUM: Final = InTexture("cloud_light", 1, spectral=True)
LIGHT: Final = InTexture("cloud_light", 2, spectral=True)
SOURCE: Final = InTexture("cloud_source", 3, spectral=True, halved=True)
INNER: Final = InTexture("cloud_inner", 3, spectral=True, halved=True)
