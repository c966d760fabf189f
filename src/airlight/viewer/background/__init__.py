"""Solving behind the edits, on threads."""
