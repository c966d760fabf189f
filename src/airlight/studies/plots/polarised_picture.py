"""Pictures of the degree and of the angle of linear polarisation, with their colour bar below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.image.encoding import srgb_encode
from airlight.image.oklab import oklab_to_rgb
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.solver.stokes_frame import angle_of_polarisation, degree_of_polarisation
from airlight.studies.plots.figure import require_matplotlib

if TYPE_CHECKING:
    from matplotlib.colors import Colormap

    from airlight.scene.frame import Frame

FloatArray = NDArray[np.float64]

#: Luminance below which a pixel counts as dark: the order of the eye's absolute threshold. [cd m⁻²]
DARK: Final = 1e-6
#: Luminance below which a pixel counts as dark, relative to the brightest polarised pixel: that of
#: moonlit ground beside sunlit. City lights on a night side are fainter. [1]
DARK_BESIDE: Final = 1e-6
#: Degree of polarisation below which colours of angles fade to black, as the angle is undefined.
#: [1]
FADING: Final = 0.02
#: Lightness and chroma of the colours of angles: the largest within sRGB at all hues.
_LIGHTNESS, _CHROMA, _FIRST_HUE = 0.75, 0.12, 20.0
#: Height of the strip below a picture, its minimum and the minimum width of a picture. [pixel]
_STRIP, _LEAST_STRIP, _LEAST_WIDTH = 0.075, 44, 240


class ColorBar(NamedTuple):
    """Quantity of a picture.

    Attributes
    ----------
    label : str
        Name with the unit.
    low, high : float
        Ends of the colour bar, in this unit.
    ticks : tuple of float
        Labelled values.
    """

    label: str
    low: float
    high: float
    ticks: tuple[float, ...]


#: Quantities: the degree in per cent, the angle in degrees.
COLOR_BARS: Final = {
    "dolp": ColorBar("degree of linear polarisation [%]", 0.0, 100.0, tuple(range(0, 101, 20))),
    "aolp": ColorBar(
        "angle of polarisation from the vertical plane, counterclockwise [°]",
        *(-90.0, 90.0, tuple(range(-90, 91, 45))),
    ),
}


def angle_colors(angle: ArrayLike) -> FloatArray:
    """Colours of angles: constant lightness and chroma, a full circle of hue in 180 deg.

    Parameters
    ----------
    angle : array, shape (...)
        Angles of polarisation, modulo 180. [deg]

    Returns
    -------
    array, shape (..., 3)
        sRGB, 0 to 1.
    """
    hue = np.radians(_FIRST_HUE + 2.0 * np.asarray(angle, np.float64))
    lab = np.stack(
        [np.full_like(hue, _LIGHTNESS), _CHROMA * np.cos(hue), _CHROMA * np.sin(hue)], axis=-1
    )
    return np.asarray(srgb_encode(np.clip(oklab_to_rgb(lab), 0.0, 1.0)), np.float64)


def color_map(show: Literal["dolp", "aolp"]) -> Colormap:
    """Colour map over the range of ``COLOR_BARS``: viridis for degrees, a cyclic one for angles."""
    require_matplotlib()
    import matplotlib
    from matplotlib.colors import ListedColormap

    if show == "dolp":
        return matplotlib.colormaps["viridis"]
    middles = np.linspace(-90.0, 90.0, 257)[:-1] + 90.0 / 256.0
    return ListedColormap(angle_colors(middles), name="angles")


def polarised_picture(frame: Frame, show: Literal["dolp", "aolp"]) -> NDArray[np.uint8]:
    """Picture of the polarisation of a frame's luminance, with a colour bar below.

    Parameters
    ----------
    frame : Frame
        Frame with Q and U, ``render(..., stokes=True)``.
    show : "dolp" or "aolp"
        Degree of linear polarisation, or its angle from the meridian plane.

    Returns
    -------
    array, shape (h + strip, w, 3), uint8
        sRGB; dark pixels (``is_lit``) are black, and angles fade to black below a degree of 2 %.
    """
    if show not in COLOR_BARS:
        raise ParameterError("show", show, ", ".join(COLOR_BARS))
    width = frame.rgb.shape[1]
    check_width(width)
    stokes = frame.stokes
    degree, angle = degree_of_polarisation(stokes), angle_of_polarisation(stokes)
    if show == "dolp":
        colors = np.asarray(color_map(show)(np.clip(degree, 0.0, 1.0)))[..., :3]
    else:
        colors = angle_colors(angle) * np.clip(degree / FADING, 0.0, 1.0)[..., None]
    colors = np.where(is_lit(stokes)[..., None], colors, 0.0)
    strip = _legend(show, width, max(_LEAST_STRIP, round(_STRIP * width)))
    return np.concatenate([np.round(255.0 * colors).astype(np.uint8), strip])


def is_lit(stokes: ArrayLike) -> NDArray[np.bool_]:
    """Whether pixels are bright enough for degree and angle.

    Parameters
    ----------
    stokes : array, shape (3, ...)
        I, Q and U of the luminance. [W m⁻² sr⁻¹]

    Examples
    --------
    >>> is_lit([[10.0, 1e-3, 1e-6], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    array([ True,  True, False])
    """
    i, q, u = np.asarray(stokes, np.float64)
    # The disc of a star is unpolarised: it does not make the sky beside it dark.
    brightest = float(np.hypot(q, u).max(initial=0.0))
    return np.asarray(i > max(DARK / LUMINOUS_EFFICACY, DARK_BESIDE * brightest))


def check_width(width: int) -> None:
    """Raise an error for a picture too narrow for the labels of a legend. [pixel]"""
    if width < _LEAST_WIDTH:
        raise ParameterError("width", width, f"{_LEAST_WIDTH} pixels or more, for the legend")


def _legend(show: Literal["dolp", "aolp"], width: int, height: int) -> NDArray[np.uint8]:
    """Colour bar with labels, shape (height, width, 3)."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    shown, dpi = COLOR_BARS[show], 100.0
    size = 72.0 / dpi * 0.24 * height  # of the letters [point]
    figure = Figure(figsize=(width / dpi, height / dpi), dpi=dpi, facecolor="black")
    canvas = FigureCanvasAgg(figure)
    axes: Any = figure.add_axes((0.08, 0.66, 0.84, 0.22))
    values = np.linspace(shown.low, shown.high, 1024)[None]
    extent, colors = (shown.low, shown.high, 0.0, 1.0), color_map(show)
    axes.imshow(values, cmap=colors, aspect="auto", extent=extent, interpolation="nearest")
    axes.set(yticks=[], xticks=shown.ticks)
    axes.set_xlabel(shown.label, color="white", fontsize=size, labelpad=0.12 * size)
    axes.tick_params(colors="white", labelsize=size, pad=0.15 * size, length=0.25 * size)
    axes.spines[:].set_visible(False)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
