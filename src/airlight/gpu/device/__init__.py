"""Graphics device, flat textures, fragment passes and their times."""
