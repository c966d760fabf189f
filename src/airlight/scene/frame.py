"""Frame: the light at each pixel, before exposure and tone mapping."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class Frame:
    """Result of ``render``.

    Attributes
    ----------
    rgb : array, shape (height, width, 3), float32
        Linear sRGB of the radiance, weighted by the colour-matching functions; channels outside
        the sRGB gamut may be negative. 683 lm/W times its luminance is in cd m⁻². [W m⁻² sr⁻¹]
    metadata : dict
        Description of how it was made, as text.
    """

    rgb: NDArray[np.float32]
    metadata: dict[str, str] = field(default_factory=dict)
