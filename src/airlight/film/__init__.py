"""Films: key frames, exposure and frames of a planet or a scene, rendered by many processes."""

from __future__ import annotations

from airlight.film.animate import Animated, animate
from airlight.film.film import Film
from airlight.film.finish import Finish
from airlight.film.frame_spec import Quality
from airlight.film.reading import load_film

__all__ = ["Animated", "Film", "Finish", "Quality", "animate", "load_film"]
