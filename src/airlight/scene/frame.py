"""``Frame``: linear radiance of each pixel, before exposure and tone mapping."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.image.exposure import MOST_EXPOSURE, automatic_exposure
from airlight.image.xyz import luminance
from airlight.scene.camera import Camera
from airlight.scene.metering import FILTER, scene_exposure
from airlight.scene.scene import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class Frame:
    """Result of ``render``.

    Attributes
    ----------
    rgb : array, shape (height, width, 3), float32
        Linear sRGB of the radiance, weighted by the colour-matching functions; channels outside
        the sRGB gamut may be negative. 683 lm/W times its luminance is in cd m⁻². [W m⁻² sr⁻¹]
    polarised : array, shape (2, height, width, 3), float32, or None
        Stokes Q and U in the meridian plane of each line of sight; None if not rendered.
        [W m⁻² sr⁻¹]
    metadata : dict
        Description of the computation, as text.
    pixel_angle : float
        Angle of a pixel on the optical axis, for glare; 0 for the faces of a cube. [rad]
    circle : (int, int) or None
        Size of the uncropped frame of a projection with an image circle. [pixel]
    scene : Scene or None
        Rendered scene.
    star_radius : float
        Angular radius of the star. [rad]
    star_white : (float, float) or None
        Chromaticity x, y of the star's light outside the air, for the white balance; None if
        unknown. [1]
    white : float
        Luminance of a white surface that faces the star, for metering; 0 if unknown. [W m⁻² sr⁻¹]
    unfiltered : Frame or None
        Small frame without the camera's polariser, which is metered; None without one.
    origin : (int, int)
        First column and row of the frame in the uncropped frame. [pixel]

    Examples
    --------
    >>> Frame(rgb=np.zeros((9, 16, 3), np.float32))
    <Frame: 16 x 9 pixels of linear sRGB, W m⁻² sr⁻¹>
    """

    rgb: NDArray[np.float32]
    polarised: NDArray[np.float32] | None = None
    metadata: dict[str, str] = field(default_factory=dict)
    pixel_angle: float = 0.0
    circle: tuple[int, int] | None = None
    scene: Scene | None = None
    star_radius: float = 0.0
    star_white: tuple[float, float] | None = None
    white: float = 0.0
    unfiltered: Frame | None = None
    origin: tuple[int, int] = (0, 0)

    @classmethod
    def seen_by(
        cls,
        camera: Camera,
        rgb: NDArray[np.float32],
        wavelengths: NDArray[np.float64],
        metadata: dict[str, str],
        *,
        device: str | None = None,
        **more: Any,
    ) -> Frame:
        """Frame of a camera, described by wavelengths [nm], unit and device."""
        described = {
            **metadata,
            "wavelengths": ", ".join(f"{nm:g}" for nm in wavelengths) + " nm",
            "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931",
            **({} if device is None else {"device": device}),
        }
        return cls(
            rgb=rgb,
            metadata=described,
            pixel_angle=camera.glare_angle,
            circle=camera.circle,
            origin=(camera.left, camera.top),
            **more,
        )

    def __repr__(self) -> str:
        height, width = self.rgb.shape[:2]
        of = f" of {self.metadata['planet']}" if "planet" in self.metadata else ""
        return f"<Frame{of}: {width} x {height} pixels of linear sRGB, W m⁻² sr⁻¹>"

    @property
    def lens(self) -> dict[str, Any]:
        """Arguments of ``airlight.image.to_display`` about lens and star, also if cropped."""
        names = ("pixel_angle", "circle", "origin", "star_white")
        return {name: getattr(self, name) for name in names}

    @property
    def stokes(self) -> NDArray[np.float64]:
        """I, Q and U of the luminance, shape (3, height, width). [W m⁻² sr⁻¹]

        Raises
        ------
        ParameterError
            If the frame has no Q and U.
        """
        if self.polarised is None:
            raise ParameterError("frame.polarised", None, "Q and U: render(..., stokes=True)")
        return luminance(np.stack([self.rgb, *self.polarised]).astype(np.float64))

    @cached_property
    def exposure(self) -> float:
        """Automatic exposure; ``scene_exposure`` if the scene is known. [EV]

        Behind a polariser it is that of the unfiltered frame and one stop, see
        ``airlight.scene.metering.unfiltered``.

        Examples
        --------
        >>> grey = np.full((2, 2, 3), 10.0, dtype=np.float32)
        >>> f"{Frame(rgb=grey).exposure:.2f}"
        '-4.58'
        """
        if self.unfiltered is not None:
            return min(self.unfiltered.exposure + FILTER, MOST_EXPOSURE)
        if self.scene is None:
            return automatic_exposure(self.rgb, white=self.white)
        return scene_exposure(self.rgb, self.scene, self.star_radius, self.white)
