"""GPU, flat textures, fragment passes and their times."""
