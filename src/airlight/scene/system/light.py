"""Light of a scene: star, or reflecting body."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.planets.parameters import MISSING, parameters, replace
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.star import Star
from airlight.scene.system.vectors import POSITION, unit

FloatArray = npt.NDArray[np.float64]


@parameters
class Light(TomlModel):
    """Star at a finite or infinite distance, or a body that reflects starlight.

    Exactly one of ``star`` and ``body`` is given.

    Parameters
    ----------
    name : str, optional
        Name of a star, by which the camera refers to it; ``sun`` by default.
    star : Star, optional
        Spectrum and size of a star.
    direction : tuple of float, optional
        Direction towards a star that is far away: its irradiance and angular radius are those of
        ``star`` everywhere.
    position : tuple of float, optional
        Centre of a star at a finite distance, on which its irradiance depends. [m]
    ephemeris : str, optional
        ``sun``: the position of the sun at the time of the scene file, instead of a direction or a
        position.
    body : str, optional
        Name of a body that reflects starlight: a moon or a planet.
    corona : str, optional
        ``baumbach``: the solar corona around the star's disc.
    """

    name: str = key(
        label="name",
        help="Name of a star.",
        kind="text",
        range=(1, 60),
        example="sun",
        default="sun",
    )
    star: Star | None = key(
        label="star",
        help="Spectrum and size of a star, as in a planet file.",
        kind="table",
        table=Star,
        example="a table such as { spectrum = 'astm-g173' }",
        default=None,
    )
    direction: tuple[float, ...] | None = key(
        label="direction",
        help="Direction towards a star.",
        range=(-1e12, 1e12),
        listed=True,
        example="[1, 0, 0]",
        default=None,
    )
    position: tuple[float, ...] | None = key(POSITION, default=None)
    ephemeris: str | None = key(
        label="ephemeris",
        help="The sun, at its position at the scene's time.",
        kind="choice",
        choices=lambda: ("sun",),
        default=None,
    )
    body: str | None = key(
        label="body",
        help="Body that shines by reflected light.",
        kind="text",
        range=(1, 60),
        example="moon",
        default=None,
    )

    corona: str | None = key(
        label="corona",
        help="Corona around the star: the mean solar corona.",
        kind="choice",
        choices=lambda: ("baumbach",),
        default=None,
    )

    def __post_init__(self) -> None:
        if (self.star is None) == (self.body is None):
            given = MISSING if self.star is None else "star and body"
            raise ParameterError("star", given, "one of star and body")
        if self.body is not None:
            for name in ("direction", "position", "ephemeris", "corona"):
                if getattr(self, name):
                    raise ConflictError(name, "cannot be combined with body")
            return
        ways = [name for name in ("direction", "position", "ephemeris") if getattr(self, name)]
        if len(ways) != 1:
            given = " and ".join(ways) if ways else MISSING
            raise ParameterError("direction", given, "one of direction, position, ephemeris")
        if self.ephemeris is not None:
            return
        if self.direction is not None:
            unit(self.direction, "direction")
        elif len(self.position or ()) != 3:
            raise ParameterError("position", self.position, "three lengths")
        elif self.star is not None and (
            self.star.irradiance is not None or self.star.angular_radius is not None
        ):
            raise ConflictError(
                "position", "cannot be combined with an irradiance or angular radius"
            )

    def towards(self, points: FloatArray) -> FloatArray:
        """Directions of a star from points, shape (..., 3). [1]

        Parameters
        ----------
        points : array, shape (..., 3)
            Positions. [m]
        """
        if self.direction is not None:
            return np.broadcast_to(unit(self.direction, "direction"), np.shape(points))
        offset = np.asarray(self.position, float) - points
        return np.asarray(offset / np.linalg.norm(offset, axis=-1, keepdims=True))

    def star_at(self, point: FloatArray) -> Star:
        """Star with its irradiance and angular radius at a point.

        Parameters
        ----------
        point : array, shape (3,)
            Position. [m]
        """
        assert self.star is not None
        if self.position is None:
            return self.star
        distance = float(np.linalg.norm(np.asarray(self.position) - point))
        return replace(self.star, distance=distance)
