"""Files of pictures and of baked tables, written atomically."""

from __future__ import annotations

from airlight.render.picture import write_picture

__all__ = ["write_picture"]
