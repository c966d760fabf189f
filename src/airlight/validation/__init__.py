"""Validation against independent authorities, and the report that shows it."""
