"""Gallery of the presets: their families, and a small picture of each."""
