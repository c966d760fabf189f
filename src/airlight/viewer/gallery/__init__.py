"""Preset gallery: families and thumbnails."""
