"""Validation against independent authorities, and its report."""
