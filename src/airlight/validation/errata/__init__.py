"""Errata of the source documents, computed."""
