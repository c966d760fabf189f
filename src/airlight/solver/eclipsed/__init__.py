"""Radiance of an atmosphere in the shadow of a moon: a separate field around the umbra."""
