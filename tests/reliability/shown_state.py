"""What window and page show, compared with the CPU's picture of the same state."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from airlight.image.display import to_display
from airlight.image.png import write_png
from airlight.render import render
from airlight.render.star_points import add_catalogue
from airlight.scene.frame import Frame
from airlight.viewer.background.solver_thread import SolverThread
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import settings_of
from airlight.viewer.session.session import Session
from airlight.viewer.window.start import Start, opened

#: Side of the blocks whose means are compared: a picture may lie between the display's pixels.
BLOCK = 4
#: Largest difference of a block, and the fraction of blocks that may exceed it: edges of discs and
#: ground that fall into other pixels, and marks over the picture. [1/255], [1]
DIFFERENT, FEW = 6.0, 0.02


@dataclass(frozen=True)
class Expected:
    """Light of a state, rendered by the CPU, and its metered exposure. [EV]"""

    session: Session
    frame: Frame
    metered: float

    def picture(self, exposure: float) -> np.ndarray:
        """Displayed picture at an exposure [EV], shape (height, width, 3). [1/255]"""
        settings = settings_of(self.session.view)
        shown = to_display(self.frame.rgb, exposure, settings=settings, **self.frame.lens)
        return shown.astype(float)

    @property
    def exposure(self) -> float:
        """Exposure that the state asks for. [EV]"""
        view = self.session.view
        metered = self.metered if view["display.automatic"] else 0.0
        return float(view["display.exposure"]) + metered


@lru_cache(maxsize=1)
def expected(
    link: str, size: tuple[int, int], starry: bool, view: tuple[tuple[str, Value], ...] = ()
) -> Expected:
    """Light of a link, solved and rendered in this process.

    Parameters
    ----------
    link : str
        State as the viewer exports it, from ``#`` on.
    view : tuple of (str, value), optional
        Values of the view, which a link rounds: from 1 m above the ground that moves pixels.
    size : (int, int)
        Size of the picture. [pixel]
    starry : bool
        Whether the star catalogue is shown, for planets that have one.

    Raises
    ------
    AirlightError
        If the planet cannot be solved.
    """
    session = opened(Start(planet=link))
    if view:
        session.change_view("exact", dict(view))
    session.resize(*size)
    with SolverThread(session) as solving:
        solving.wait()
        solved, error = solving.latest, solving.status.error
    if error or solved is None:
        raise ValueError(error)
    frame = render(solved.solution, session.scene, orders=session.orders)
    metered = frame.exposure
    if starry and solved.planet.body is not None:
        add_catalogue(frame.rgb, session.scene, solved.solution, solved.planet.body)
    return Expected(session, frame, metered)


def _blocks(picture: np.ndarray) -> np.ndarray:
    rows, columns = (BLOCK * (one // BLOCK) for one in picture.shape[:2])
    split = picture[:rows, :columns].reshape(rows // BLOCK, BLOCK, columns // BLOCK, BLOCK, 3)
    return np.asarray(split.mean(axis=(1, 3)))


def fault_of(shown: np.ndarray, wanted: np.ndarray) -> tuple[str, str]:
    """Class of what is wrong with a shown picture, empty if nothing, and figures.

    Parameters
    ----------
    shown, wanted : array, shape (height, width, 3)
        Displayed picture, and that of the CPU. [1/255]
    """
    if shown.shape != wanted.shape:
        return "size", f"{shown.shape[1::-1]} instead of {wanted.shape[1::-1]}"
    off = np.abs(_blocks(shown) - _blocks(wanted)).max(axis=2)
    part = float(np.mean(off > DIFFERENT))
    figures = (
        f"mean {off.mean():.2f}, {100.0 * part:.1f} % of blocks off, mean light {shown.mean():.0f}"
    )
    if part <= FEW:
        return "", figures
    for name, extreme in (("white", shown.min() > 250.0), ("black", shown.max() < 5.0)):
        if extreme:
            return name, figures
    return "stale", figures


def facts(state: dict[str, Any]) -> str:
    """State of a viewer in a line."""
    words = state["size"], state["exposure"], "EV", state.get("progress", ""), state["link"][:600]
    return " ".join(map(str, words))


def save(path: Path, shown: np.ndarray, wanted: np.ndarray) -> None:
    """Write a shown picture with that of the CPU below it."""
    width = max(shown.shape[1], wanted.shape[1])
    rows = [
        np.pad(one, ((0, 0), (0, width - one.shape[1]), (0, 0))).astype(np.uint8)
        for one in (shown, wanted)
    ]
    write_png(path, np.concatenate(rows), {})
