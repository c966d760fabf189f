"""Density in layers, each the sum of an exponential and a linear term (Bruneton)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.physics.optics import density_profile
from airlight.physics.optics.density_profile import LayerTerms, Row
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, always, key
from airlight.planets.schema.measures import text_of
from airlight.planets.schema.toml_model import TomlModel

#: Largest number of layers of a profile.
MOST_LAYERS = 1000
#: Scale height of a new layer, over the shell's thickness.
_FRESH_SHARE = 0.08


#: Factor and constant of a layer.
_FACTOR: Final = Field(
    label="exponential term",
    help="Factor of the exponential.",
    range=(-1e6, 1e6),
    slider=(-2.0, 2.0),
    offered=always,
)
#: Exponent and slope of a layer.
_SLOPE: Final = Field(
    label="exponential scale",
    help="Growth of the exponential upwards.",
    unit="1/m",
    range=(-1.0, 1.0),
    slider=(-1.0, 1.0),
    shown="/km",
    offered=always,
)


@parameters
class Layer(TomlModel):
    """Bruneton layer: exp_term·e^(exp_scale·h) + linear_term·h + constant_term.

    The sum is clamped to [0, 1].

    Parameters
    ----------
    width : float
        Thickness; ignored for the topmost layer. [m]
    exp_term, constant_term : float
        Factor of the exponential, and constant. [1]
    exp_scale, linear_term : float
        Exponent and slope per metre of altitude. [m⁻¹]
    """

    width: float = key(
        label="thickness",
        help="Thickness of the layer; the topmost extends to the top of the atmosphere.",
        unit="m",
        range=(0.0, 1e9),
        shown="km",
        slider=(0.0, 100.0),
        default=0.0,
    )
    exp_term: float = key(_FACTOR, default=0.0)
    exp_scale: float = key(_SLOPE, default=0.0)
    linear_term: float = key(
        _SLOPE, label="linear term", help="Factor of the altitude.", default=0.0
    )
    constant_term: float = key(
        _FACTOR,
        label="constant term",
        help="Added to the others; the sum is held to 0 to 1.",
        default=0.0,
    )


@parameters
class Layered(Profile):
    """Layers stacked from the ground; the last one extends to the top of the shell.

    Parameters
    ----------
    layers : tuple of Layer
        At least one layer; all but the last have a width.
    """

    keyword = "layered"

    layers: tuple[Layer, ...] = key(
        label="layer",
        help="Layers, from the ground up.",
        note="Each is exp_term·e^(exp_scale·h) + linear_term·h + constant_term, clamped to"
        " [0, 1]; what is left out is 0.",
        table=Layer,
        example="a list of tables such as [{ constant_term = 1 }]",
    )

    def __post_init__(self) -> None:
        if not 1 <= len(self.layers) <= MOST_LAYERS:
            raise ParameterError("layers", len(self.layers), f"1 to {MOST_LAYERS} layers")
        for index, layer in enumerate(self.layers[:-1]):
            if layer.width <= 0.0:
                raise ParameterError(f"layers[{index}].width", layer.width, "more than 0 m")

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        terms = [
            LayerTerms(
                width=layer.width,
                exp_term=layer.exp_term,
                exp_scale=layer.exp_scale,
                linear_term=layer.linear_term,
                constant_term=layer.constant_term,
            )
            for layer in self.layers
        ]
        return density_profile.layered(terms, thickness)

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Table of one exponential layer; see ``TomlModel.default_table``."""
        per_km = float(f"{-1e3 / (_FRESH_SHARE * thickness):.4g}")
        return {"layers": [{"exp_term": 1.0, "exp_scale": text_of(per_km, "/km")}]}
