"""Observables: disc-integrated spectra, transmission spectra and limb radiance of a planet."""

from airlight.studies.observables.observe import KINDS, observe

__all__ = ["KINDS", "observe"]
