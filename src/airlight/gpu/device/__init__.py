"""A graphics device, its flat textures, its passes of fragments and their times."""
