"""Settings of the direct solver: resolution, and variants of the equations."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

from airlight.errors import ParameterError
from airlight.solver.quality import settings_by_name

#: Mappings of the table of gathered radiance.
MAPPINGS: Final = ("angle", "bruneton", "linear", "power", "weighted-power")
#: Printed forms that differ from the corrected equations and can be selected.
LITERAL: Final = ("", "atmosphere-plus-1", "atmosphere-plus-2")


@dataclass(frozen=True, kw_only=True)
class DirectSettings:
    """Resolution and rules of the direct solver.

    Attributes
    ----------
    mapping : str
        Mapping of the table of gathered radiance. ``bruneton``: the 4-D mapping of (r, mu, mu_s,
        nu); ``angle``: the same with even steps in the angles of view and of sun to view;
        ``linear``, ``power`` and ``weighted-power``: the 3-D mappings of Atmosphere Plus of
        (h, φ, δ), which omit azimuth.
    radii, views, sun_angles, scatter_angles : int
        Shape of the table; the last is 1 for the 3-D mappings.
    power : float
        Exponent of the power and weighted power mappings. [1]
    azimuth : float
        Azimuth of a 3-D table. [deg]
    zenith_steps, azimuth_steps : int
        Steps of the gather over the sphere: in Θ (on each side of the horizon if graded, otherwise
        over all of it), and in Φ over the whole turn.
    steps : int
        Steps of the trapezoid on a line of sight; if graded, on each segment between ends, tangent
        point, breakpoints of the profiles and shadow edges.
    pass_steps : int
        Steps on the lines of the passes.
    graded : bool
        Whether trapezoids are graded and split at the horizon and the tangent point; otherwise they
        have equal steps, as printed.
    logarithmic : bool
        Whether the table is interpolated in the logarithm; otherwise linearly, as printed.
    orders : int
        Largest number of orders.
    tolerance : float
        Relative change by an order below which the iteration stops. [1]
    tail : bool
        Whether further orders are added as a geometric series.
    keep_orders : bool
        Whether each order can be requested separately.
    literal : str
        ``atmosphere-plus-1`` gathers and attenuates each constituent separately, over black ground;
        ``atmosphere-plus-2`` adds the lit ground one order late and omits A⁽²⁾.
    """

    mapping: str = "angle"
    radii: int = 24
    views: int = 32
    sun_angles: int = 40
    scatter_angles: int = 12
    power: float = 2.0
    azimuth: float = 0.0
    zenith_steps: int = 10
    azimuth_steps: int = 32
    steps: int = 16
    pass_steps: int = 10
    graded: bool = True
    logarithmic: bool = True
    orders: int = 30
    tolerance: float = 5e-3
    tail: bool = True
    keep_orders: bool = True
    literal: str = ""

    def __post_init__(self) -> None:
        if self.mapping not in MAPPINGS:
            raise ParameterError("mapping", self.mapping, ", ".join(MAPPINGS))
        if self.literal not in LITERAL:
            raise ParameterError("literal", self.literal, ", ".join(filter(None, LITERAL)))
        for name, low, high in (
            ("radii", 2, 256),
            ("views", 4, 512),
            ("sun_angles", 4, 512),
            ("scatter_angles", 1 if self.flat else 2, 1 if self.flat else 256),
            ("zenith_steps", 3, 200),
            ("azimuth_steps", 4, 400),
            ("steps", 3, 400),
            ("pass_steps", 3, 400),
            ("orders", 1, 1000),
        ):
            value = getattr(self, name)
            if not low <= value <= high:
                raise ParameterError(name, value, f"{low} to {high}")
        if self.views % 2 or self.azimuth_steps % 2:
            name = "views" if self.views % 2 else "azimuth_steps"
            raise ParameterError(name, getattr(self, name), "an even number")
        if not 1.0 <= self.power <= 8.0:
            raise ParameterError("power", self.power, "1 to 8")
        if not 0.0 <= self.azimuth <= 180.0:
            raise ParameterError("azimuth", self.azimuth, "0 to 180 deg")
        if not 0.0 < self.tolerance < 1.0:
            raise ParameterError("tolerance", self.tolerance, "above 0, below 1")

    @property
    def flat(self) -> bool:
        """Whether the table omits azimuth."""
        return self.mapping not in ("angle", "bruneton")

    def as_text(self) -> str:
        """Settings on one line, for reports and fingerprints."""
        return " ".join(f"{name}={value}" for name, value in asdict(self).items() if value != "")


QUALITIES: Final = {
    "preview": DirectSettings(
        radii=16, views=20, sun_angles=28, scatter_angles=8, zenith_steps=8, azimuth_steps=20,
        steps=12, pass_steps=8, tolerance=2e-2,
    ),
    "default": DirectSettings(),
    "fine": DirectSettings(
        radii=26, views=36, sun_angles=72, scatter_angles=16, zenith_steps=20, azimuth_steps=44,
        steps=28, pass_steps=14, keep_orders=False,
    ),
}  # fmt: skip

#: Tables of the Atmosphere Plus notes: 32 heights, 64 view and 32 sun directions, 30 steps.
ATMOSPHERE_PLUS: Final = DirectSettings(
    mapping="weighted-power", radii=32, views=64, sun_angles=32, scatter_angles=1, zenith_steps=12,
    azimuth_steps=24, steps=30, pass_steps=30, graded=False, logarithmic=False, orders=6,
    tail=False,
)  # fmt: skip


def settings_for(quality: str | DirectSettings) -> DirectSettings:
    """Settings of a named quality level; settings are returned unchanged."""
    return settings_by_name(quality, QUALITIES)
