"""Page of a planet or a scene in a browser, and the picture that it draws of a view."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_subject import PlanetPage, ScenePage


def opened_subject(
    subject: PlanetPage | ScenePage, solutions: Any, open_page: Callable[..., Any], folder: Path
) -> Any:
    """Page of a subject, written to a folder and opened with WebGL2."""
    file = folder / "page.html"
    data = subject.data(solutions, "Page", subject.values({}), "three")
    file.write_text(page_text("Page", json.loads(json.dumps(data))), encoding="utf-8")
    return open_page(file, "?device=webgl2")


def page_picture(
    page: Any, view: dict[str, Any], size: tuple[int, int]
) -> tuple[np.ndarray, float]:
    """Picture [0 to 255] of a width and height, and its exposure [EV].

    The view's other values are those with which the page was opened.
    """
    url, exposure = page.evaluate(
        """async ([values, width, height]) => {
          await airlight.ready;
          airlight.state.reset();
          airlight.state.set(values);
          const blob = await airlight.png(width, height);
          const { exposure } = airlight.picture;
          const reader = new FileReader();
          await new Promise((resolve) => { reader.onload = resolve; reader.readAsDataURL(blob); });
          return [reader.result, exposure];
        }""",
        [view, *size],
    )
    image = Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2])))
    return np.asarray(image.convert("RGB"), np.float64), exposure
