"""From frames to files: PNG and EXR, whole or not at all."""

from __future__ import annotations

from airlight.exports.picture import write_picture

__all__ = ["write_picture"]
