"""The declared parameters of a planet file and of a view."""
