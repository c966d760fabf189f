"""From a planet and a scene to a frame: choice of solver, renderer and wavelengths."""
