"""Planets from users' own tables: profiles, optical properties, surfaces and stars."""
