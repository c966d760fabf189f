"""Rendering and display of a solution on the GPU."""
