"""Labelled tables, their layouts and look-up; columns; results kept on disk."""
