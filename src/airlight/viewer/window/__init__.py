"""Desktop window of the viewer."""
