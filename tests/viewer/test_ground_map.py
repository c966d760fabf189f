"""Maps that pages carry."""

from __future__ import annotations

import base64
import io

import numpy as np
from numpy.testing import assert_array_equal
from PIL import Image

from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.map_levels import reduced
from airlight.viewer.browser.package import ground_map


def test_lamps_of_a_page_light_no_dark_sea() -> None:
    # a JPEG's error beside towns was light on 4 % of the dark texels, up to 17 of 255
    found = ground_overlay("earth")
    assert found is not None
    data = ground_map(found, overlay=True)
    assert data is not None
    content = base64.b64decode(data["image"].partition(",")[2])
    rows, columns = data["rows"], data["columns"]
    kept = reduced(found.levels[0], rows, columns)[..., 0]
    assert_array_equal(np.asarray(Image.open(io.BytesIO(content)).convert("L")), kept)
    assert len(content) < 250e3
