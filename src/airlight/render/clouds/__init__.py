"""Three-dimensional clouds in pictures."""

from __future__ import annotations

from typing import Final

#: Largest number of kinds of clouds in a picture.
MOST_KINDS: Final = 3
