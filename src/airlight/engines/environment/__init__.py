"""Environment maps for other renderers, with the sun as a separate light."""
