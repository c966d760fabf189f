"""Rendering and probing of a session on the CPU or the GPU, on threads."""
