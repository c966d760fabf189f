"""Observables: disc-integrated spectra, transmission spectra and limb radiance of a planet."""

from airlight.observables.observe import KINDS, observe

__all__ = ["KINDS", "observe"]
