"""Density in layers, each the sum of an exponential and a linear term (Bruneton)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from airlight.errors import ParameterError
from airlight.physics.optics import density_profile
from airlight.physics.optics.density_profile import LayerTerms, Row
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, Wavelengths, always
from airlight.planets.schema.measures import text_of
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable

#: Largest number of layers of a profile.
MOST_LAYERS = 1000
#: Scale height of a new layer, over the shell's thickness.
_FRESH_SHARE = 0.08


def _term(label: str, text: str, unit: str = "1") -> Field:
    """Key of a term of a layer, displayed per kilometre if it is per metre."""
    most, end = (1e6, 2.0) if unit == "1" else (1.0, 1.0)
    return Field(label=label, help=text, unit=unit, range=(-most, most), slider=(-end, end),
               shown="" if unit == "1" else "/km", offered=always)  # fmt: skip


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

    width: Annotated[
        float,
        Field(
            label="thickness",
            help="Thickness of the layer; the topmost extends to the top of the atmosphere.",
            unit="m",
            range=(0.0, 1e9),
            shown="km",
            slider=(0.0, 100.0),
        ),
    ] = 0.0
    exp_term: Annotated[float, _term("exponential term", "Factor of the exponential.")] = 0.0
    exp_scale: Annotated[
        float, _term("exponential scale", "Growth of the exponential upwards.", "1/m")
    ] = 0.0
    linear_term: Annotated[float, _term("linear term", "Factor of the altitude.", "1/m")] = 0.0
    constant_term: Annotated[
        float, _term("constant term", "Added to the others; the sum is held to 0 to 1.")
    ] = 0.0


def _layers(section: TomlTable, name: str, wavelengths: Wavelengths) -> tuple[Layer, ...]:
    parts = section.sections(name, "a list of tables such as [{ constant_term = 1 }]")
    return tuple(Layer.read(part) for part in parts)


@parameters
class Layered(Profile):
    """Layers stacked from the ground; the last one extends to the top of the shell.

    Parameters
    ----------
    layers : tuple of Layer
        At least one layer; all but the last have a width.
    """

    keyword = "layered"

    layers: Annotated[
        tuple[Layer, ...],
        Field(
            label="layer",
            help="Layers, from the ground up.",
            note="Each is exp_term·e^(exp_scale·h) + linear_term·h + constant_term, clamped to"
            " [0, 1]; what is left out is 0.",
            kind="table",
            table="layer",
            read=_layers,
        ),
    ]

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
