"""Frame, colours and file of figures.

Figures use matplotlib's object interface, not ``pyplot``, and thus no global state.
"""

from __future__ import annotations

import textwrap
import warnings
from typing import IO, TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import AirlightError
from airlight.image.encoding import srgb_encode
from airlight.image.spectral_color import wavelength_color
from airlight.physics.units import values_in
from airlight.plain_text import plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

#: Colours distinguishable with every kind of colour vision; Okabe & Ito (2008), Color Universal
#: Design, without black and yellow.
PALETTE: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
#: Line styles distinguishable in black and white.
LINE_STYLES: Final = ("-", "--", "-.", ":", (0, (6, 1.5, 1, 1.5, 1, 1.5)), (0, (2, 1)))
#: Colour of annotations and guide lines.
GREY: Final = "#555555"

#: Range of wavelengths in which the eye is reasonably sensitive. [nm]
VISIBLE: Final = (380.0, 750.0)
#: Luminance to which a wavelength's colour is darkened for contrast with white paper. [1]
_INK: Final = 0.28

#: Characters of a title on an inch.
_TITLE: Final = 9.0

#: File formats of a figure.
FORMATS: Final = ("png", "svg", "pdf")
#: Metadata without dates, so that the same figure gives the same file.
_METADATA: Final[dict[str, dict[str, Any]]] = {
    "png": {"Software": "airlight"},
    "svg": {"Date": None, "Creator": "airlight"},
    "pdf": {"CreationDate": None, "Creator": "airlight", "Producer": None},
}


def require_matplotlib() -> None:
    """Import matplotlib, which is an optional dependency."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError as error:
        raise AirlightError("plots need matplotlib: pip install 'airlight[plots]'") from error


def new_figure(title: str, caption: str = "", size: tuple[float, float] = (8.0, 5.0)) -> Figure:
    """Empty figure with title and caption.

    Parameters
    ----------
    title : str
        Subject of the figure, with the planet.
    caption : str
        Settings and explanation.
    size : (float, float)
        Width and height. [inch]
    """
    require_matplotlib()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    lines = textwrap.fill(words(title), int(_TITLE * size[0]))
    figure.suptitle(lines, fontsize=13, fontweight="bold")
    if caption:
        figure.supxlabel(caption, fontsize=9, color=GREY)
    return figure


def words(text: str) -> str:
    r"""Text escaped for matplotlib, without mathtext or hidden legend entries.

    Parameters
    ----------
    text : str
        Title, or label of a curve.

    Examples
    --------
    >>> print(words("haze $x_{$")), print(repr(words("_dust")))
    haze \$x_{\$
    '\u2009_dust'
    (None, None)
    """
    shown = plain(text).replace("$", r"\$")
    return f"\u2009{shown}" if shown.startswith("_") else shown  # a legend omits labels with "_"


def grid(axes: Axes) -> None:
    """Draw light lines behind the data, and no frame on the open sides."""
    axes.grid(True, color="#dddddd", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def wavelength_ink(wavelengths: ArrayLike) -> list[tuple[float, float, float]]:
    """Colours of wavelengths, dark enough for lines; grey outside the visible.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths. [nm]

    Returns
    -------
    list of (float, float, float), length n
        sRGB, 0 to 1.

    Examples
    --------
    >>> red, green, blue = wavelength_ink([680.0, 550.0, 440.0])
    >>> red.index(max(red)), green.index(max(green)), blue.index(max(blue))
    (0, 1, 2)
    """
    inks = []
    for nm in np.atleast_1d(values_in(wavelengths, "nm", "wavelengths")):
        if not VISIBLE[0] <= nm <= VISIBLE[1]:
            inks.append((0.45, 0.45, 0.45))
            continue
        linear = np.clip(wavelength_color(nm, "peak"), 0.0, 1.0)
        bright = float(linear @ [0.2126, 0.7152, 0.0722])
        red, green, blue = srgb_encode(linear * min(1.0, _INK / bright)).tolist()
        inks.append((red, green, blue))
    return inks


def wavelength_strip(wavelengths: ArrayLike) -> FloatArray:
    """Colours of wavelengths weighted by the eye's response, dark at both ends, for filled areas.

    Parameters
    ----------
    wavelengths : array, shape (n,)
        Wavelengths, 350 to 840. [nm]

    Returns
    -------
    array, shape (n, 3)
        sRGB, 0 to 1.
    """
    linear = np.clip(wavelength_color(wavelengths, "none"), 0.0, None)
    return np.asarray(srgb_encode(np.clip(linear / 1.2, 0.0, 1.0)), dtype=np.float64)


def chosen(wavelengths: ArrayLike, most: int) -> list[int]:
    """Indices of at most ``most`` equidistant items of a list, including both ends.

    Examples
    --------
    >>> chosen([680.0, 550.0, 440.0], 4), chosen(range(410, 700, 19), 3)
    ([0, 1, 2], [0, 8, 15])
    """
    count = np.size(np.asarray(wavelengths))
    if count <= most:
        return list(range(count))
    return [int(k + 0.5) for k in np.linspace(0, count - 1, most)]


def look(index: int, color: Any, label: str | None) -> dict[str, Any]:
    """Keywords of a curve: its colour and label, and the style of the given number."""
    style = LINE_STYLES[index % len(LINE_STYLES)]
    return {"color": color, "linestyle": style, "linewidth": 1.8, "label": label}


def wavelength_curves(wavelengths: ArrayLike, most: int) -> dict[int, dict[str, Any]]:
    """Indices of at most ``most`` wavelengths, each with the look of its curve."""
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    inks = wavelength_ink(nm)
    return {k: look(n, inks[k], f"{nm[k]:.4g} nm") for n, k in enumerate(chosen(nm, most))}


def wavelength_words(wavelengths: ArrayLike) -> str:
    """Format a list of wavelengths for a caption.

    Examples
    --------
    >>> wavelength_words([680.0, 550.0, 440.0])
    '680, 550, 440 nm'
    >>> wavelength_words([410.0 + 19.0 * k for k in range(16)])
    '16 wavelengths, 410 to 695 nm'
    """
    nm = np.atleast_1d(values_in(wavelengths, "nm", "wavelengths"))
    if nm.size > 4:
        return f"{nm.size} wavelengths, {nm.min():.4g} to {nm.max():.4g} nm"
    return ", ".join(f"{value:.4g}" for value in nm) + " nm"


def write_figure(
    figure: Figure,
    file: IO[bytes],
    format: str = "png",
    dpi: float = 150.0,
) -> None:
    """Write a figure reproducibly: without dates and random names.

    Parameters
    ----------
    file : binary file
        File open for writing.
    dpi : float
        Resolution of PNG, and of pictures within the other formats. [pixel/inch]
    """
    import matplotlib

    with warnings.catch_warnings(), matplotlib.rc_context({"svg.hashsalt": "airlight"}):
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)  # a box is drawn
        figure.savefig(file, format=format, dpi=dpi, metadata=_METADATA[format])
