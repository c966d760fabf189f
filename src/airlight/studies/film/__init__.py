"""Films: key frames, exposure curve and parallel rendering of frames."""

from __future__ import annotations

from airlight.studies.film.animate import Animated, animate
from airlight.studies.film.film import Film
from airlight.studies.film.finish import Finish
from airlight.studies.film.frame_spec import Quality
from airlight.studies.film.reading import load_film

__all__ = ["Animated", "Film", "Finish", "Quality", "animate", "load_film"]
