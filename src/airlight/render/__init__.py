"""A solution seen by a camera becomes a frame."""

from airlight.render.frame import Frame
from airlight.render.render import render

__all__ = ["Frame", "render"]
