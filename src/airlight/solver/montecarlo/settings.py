"""Settings and quality levels of the Monte Carlo solver: target error and limit of histories."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

from airlight.errors import ParameterError
from airlight.solver.quality import settings_by_name


@dataclass(frozen=True, kw_only=True)
class MonteCarloSettings:
    """Stopping rule of a Monte Carlo estimate.

    Attributes
    ----------
    relative_error : float
        Target of the standard error over radiance, at every wavelength; 1e-6 to 1. [1]
    most_histories : int
        Largest number of histories per line of sight and wavelength, 1000 to 1e12; the report
        counts the lines that did not reach the error.
    seed : int
        Seed of the random numbers, 0 to 2⁶⁴ - 1.
    kept_orders : int
        Number of orders of scattering that are recorded separately, 1 to 64.
    exact_first_order : bool
        Whether the first order is computed by quadrature rather than sampled.
    polarisation : bool
        Whether transfer is polarised rather than scalar, with Q and U 0.
    """

    relative_error: float = 0.005
    most_histories: int = 4_000_000
    seed: int = 1
    kept_orders: int = 8
    exact_first_order: bool = True
    polarisation: bool = True

    def __post_init__(self) -> None:
        limits = {
            "relative_error": (1e-6, 1.0),
            "most_histories": (1000, 10**12),
            "seed": (0, 2**64 - 1),
            "kept_orders": (1, 64),
        }
        for name, (low, high) in limits.items():
            value = getattr(self, name)
            whole = name == "relative_error" or isinstance(value, int)
            if isinstance(value, bool) or not (whole and low <= value <= high):
                kind = "" if name == "relative_error" else "a whole number, "
                raise ParameterError(name, value, f"{kind}{low:g} to {high:.10g}")

    def as_text(self) -> str:
        """Settings on one line, for reports."""
        return " ".join(f"{name}={value}" for name, value in asdict(self).items())


QUALITIES: Final = {
    "preview": MonteCarloSettings(relative_error=0.03, most_histories=200_000),
    "default": MonteCarloSettings(relative_error=0.005, most_histories=4_000_000),
    "fine": MonteCarloSettings(relative_error=0.001, most_histories=50_000_000),
}


def settings_for(quality: str | MonteCarloSettings) -> MonteCarloSettings:
    """Settings of a named quality level; settings are returned unchanged."""
    return settings_by_name(quality, QUALITIES)
