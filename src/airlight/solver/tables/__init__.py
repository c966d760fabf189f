"""Labelled tables, their layouts and look-up, and columns."""
