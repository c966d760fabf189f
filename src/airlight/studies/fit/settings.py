"""Settings of a fit: free parameters with their bounds, priors and starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from airlight.errors import ParameterError
from airlight.physics.units import Measure, quantity
from airlight.studies.fit.parameter import FitParameter, Prior


@dataclass(frozen=True, kw_only=True)
class FitSettings:
    """Settings of a fit.

    Attributes
    ----------
    free : sequence of str
        Free parameters: names for ``free_parameter``; of the instrument ``scale``,
        ``pointing.azimuth``, ``pointing.zenith``; of a camera ``white_balance.red``,
        ``white_balance.blue``.
    per_scan : sequence of str
        Parameters of the instrument that are fitted per scan.
    bounds : mapping of str to (float, float)
        Narrower bounds by name.
    priors : mapping of str to Prior
    starts : mapping of str to float
        Initial values; default: the planet's. Like bounds and priors, numbers in the parameter's
        unit, texts with a unit or quantities.
    uncertainty : float, optional
        Relative standard deviation of all values; default: that of the data, or estimated. [1]
    loss : str
        Name from ``airlight.studies.fit.loss.LOSSES``.
    quality : str
        Quality of the solver.
    overrides : mapping
        Changes of the planet's file.
    keep : bool
        Whether to cache predictions on disk, so that an interrupted fit resumes.
    """

    free: Sequence[str]
    per_scan: Sequence[str] = ()
    bounds: Mapping[str, tuple[Measure, Measure]] = field(default_factory=dict)
    priors: Mapping[str, Prior] = field(default_factory=dict)
    starts: Mapping[str, Measure] = field(default_factory=dict)
    uncertainty: float | None = None
    loss: str = "linear"
    quality: str = "default"
    overrides: Mapping[str, Any] = field(default_factory=dict)
    keep: bool = True

    def __post_init__(self) -> None:
        if self.uncertainty is not None:
            share = quantity(self.uncertainty, "1", "uncertainty")
            object.__setattr__(self, "uncertainty", share)


def check_names(settings: FitSettings, always: Sequence[str] = ()) -> None:
    """Raise an error for bounds, priors and starts of fixed parameters, and repeated names."""
    free = [*settings.free, *settings.per_scan]
    free += [name for name in always if name not in free]
    for name in free:
        if free.count(name) > 1:
            raise ParameterError("free", name, "each parameter once")
    tables = {"bounds": settings.bounds, "prior": settings.priors, "start": settings.starts}
    for word, given in tables.items():
        for name in given:
            if name not in free:
                raise ParameterError(word, name, f"one of the free parameters: {', '.join(free)}")


def adapted(parameter: FitParameter, settings: FitSettings) -> FitParameter:
    """Parameter with the start, bounds and prior of the settings."""
    name = parameter.name
    low, high = parameter.low, parameter.high
    if name in settings.bounds:
        low, high = (parameter.number(one, f"bounds of {name}") for one in settings.bounds[name])
        if not parameter.low <= low < high <= parameter.high:
            raise ParameterError(f"bounds of {name}", f"{low:g}..{high:g}", parameter.range_text)
    start = parameter.number(
        settings.starts.get(name, min(max(parameter.start, low), high)), f"start of {name}"
    )
    prior = settings.priors.get(name)
    if prior is not None:
        mean, sigma = prior.mean, prior.sigma
        mean, sigma = (parameter.number(one, f"prior of {name}") for one in (mean, sigma))
        prior = Prior(mean=mean, sigma=sigma)
    return replace(parameter, low=low, high=high, start=start, prior=prior)
