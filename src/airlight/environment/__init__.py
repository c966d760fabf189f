"""Environment maps for other renderers: the sky as they expect it, and its sun as a light."""
