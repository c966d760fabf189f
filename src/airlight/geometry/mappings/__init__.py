"""Mappings between physical coordinates and tables, each with its inverse."""
