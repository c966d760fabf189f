"""Density profiles of a constituent, one class each."""

from __future__ import annotations

from typing import Final

from airlight.planets.matter.profiles.formulas import BulkGas, Exponential, Tent, Uniform
from airlight.planets.matter.profiles.layered import Layer, Layered
from airlight.planets.matter.profiles.layers import Layers
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.matter.profiles.sounding import Sounding
from airlight.planets.matter.profiles.tabulated import Tabulated
from airlight.planets.schema.tagged_union import TaggedUnion

__all__ = [
    "PROFILES", "BulkGas", "Exponential", "Layer", "Layered", "Layers", "Profile", "Sounding",
    "Tabulated", "Tent", "Uniform",
]  # fmt: skip

#: Kinds of ``profile = { kind = … }``.
PROFILES: Final[TaggedUnion[Profile]] = TaggedUnion(
    (
        Exponential,
        Tent,
        Layered,
        Tabulated,
        Layers,
        Sounding,
        Uniform,
    ),
    label="profile",
    help="Shape of the density profile.",
)
