"""Editable state of planet, view and display, with undo, files and comparison. No window."""
