"""Light of a planet's air in the shadow of a moon: a field of its own around the umbra."""
