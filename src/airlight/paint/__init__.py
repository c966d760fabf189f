"""From a planet and a scene to a frame: who solves, who draws, at which wavelengths."""
