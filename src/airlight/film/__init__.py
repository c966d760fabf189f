"""Films: key frames, exposure curve and parallel rendering of frames."""

from __future__ import annotations

from airlight.film.animate import Animated, animate
from airlight.film.film import Film
from airlight.film.finish import Finish
from airlight.film.frame_spec import Quality
from airlight.film.reading import load_film

__all__ = ["Animated", "Film", "Finish", "Quality", "animate", "load_film"]
