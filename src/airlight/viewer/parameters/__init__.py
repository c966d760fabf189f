"""Declared parameters of a planet file and of a view."""
