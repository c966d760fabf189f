"""Fifteen measured skies: scans, planets, rows and pictures."""
