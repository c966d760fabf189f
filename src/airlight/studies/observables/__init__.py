"""Observables: irradiance at a place, and what is seen of a planet from afar."""

from airlight.studies.observables.irradiance import irradiance
from airlight.studies.observables.observe import KINDS, observe
from airlight.studies.observables.plane_irradiance import Plane

__all__ = ["KINDS", "Plane", "irradiance", "observe"]
