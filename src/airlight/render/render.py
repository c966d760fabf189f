"""``render``: rows of pixels on all cores, in blocks that limit the memory."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.errors import ParameterError
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.render.drawing import Drawing
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.solvers.moments.solution import MomentsSolution

#: Pixels in one block of rows: few enough that no core waits long for the last block.
_BLOCK_PIXELS: Final = 1 << 13


def render(
    solution: MomentsSolution,
    scene: Scene,
    *,
    orders: str = "all",
    exact: bool = False,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Frame:
    """Render a camera's view of a planet's air, its ground and its star's disc.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of at least three wavelengths.
    scene : Scene
        Observer, star and camera.
    orders : str
        Light that is drawn: ``"all"``; ``"single"``, scattered or reflected once by the air or the
        ground; or ``"multiple"``, more often. The star's own disc is visible in the first alone.
    exact : bool
        Whether the air is marched for each pixel. Otherwise the light of the air is read from a
        table of the sky around the observer, filled by the same march: see docs/pictures.md for
        its errors. Pictures of few pixels are always marched.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Frame
        Linear sRGB radiance. [W m⁻² sr⁻¹]

    Raises
    ------
    ParameterError
        If the solution is of another solver (pictures march the moments), or ``orders`` has
        another value.
    Cancelled
        If ``cancel`` requested it.
    """
    if not isinstance(solution, MomentsSolution):
        raise ParameterError(
            "solution", solution.report.solver, "a solution of the moments solver: a picture "
            "marches its moments",
        )  # fmt: skip
    drawing = Drawing(solution, scene, orders=orders, exact=exact)
    camera = scene.camera
    rgb = np.zeros((camera.height, camera.width, 3), np.float32)
    step = max(1, _BLOCK_PIXELS // camera.width)
    blocks = -(-camera.height // step)
    # Filling the table counts as much as drawing the rows.
    total = blocks if drawing.window is None else 2 * blocks

    def filling(done: int, count: int, message: str) -> None:
        if progress is not None:
            progress(blocks * done // count, total, message)

    def drawn(done: int, _: int, message: str) -> None:
        if progress is not None:
            progress(total - blocks + done, total, message)

    drawing.fill_sky(cancel=cancel, progress=filling)
    run_blocks(
        lambda k: drawing.draw(k * step, min((k + 1) * step, camera.height), rgb),
        blocks, cancel=cancel, progress=drawn, message="rendering",
    )  # fmt: skip
    wavelengths = ", ".join(f"{nm:g}" for nm in solution.wavelengths)
    return Frame(
        rgb=rgb,
        metadata={
            "solver": str(solution.report),
            "wavelengths": f"{wavelengths} nm",
            "unit": "W m-2 sr-1, linear sRGB weighted by CIE 1931",
        },
    )
