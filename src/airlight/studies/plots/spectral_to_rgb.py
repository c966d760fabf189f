"""Display colours of monochromatic light, by three normalisations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.image.encoding import srgb_encode
from airlight.image.spectral_color import Normalization, wavelength_color
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure, wavelength_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Description of each normalisation.
_WORDS: Final[dict[Normalization, str]] = {
    "none": "none: the matching functions themselves",
    "sum": "sum: XYZ divided by X + Y + Z",
    "peak": "peak: RGB divided by its largest channel",
}
#: Channels, with line styles and colours that also differ without colour.
_CHANNELS: Final = (
    ("R", PALETTE[1], "-"),
    ("G", PALETTE[2], "--"),
    ("B", PALETTE[0], "-."),
)


def spectral_to_rgb(wavelengths: tuple[float, ...] = (680.0, 550.0, 440.0)) -> Figure:
    """Linear sRGB of monochromatic light, and display colours.

    Parameters
    ----------
    wavelengths : tuple of float
        Wavelengths to mark. [nm]

    Returns
    -------
    Figure
        A panel for each normalisation: curves of the three channels from 360 to 830 nm, and colours
        clamped to the gamut.

    References
    ----------
    Atmosphere Plus notes 2, section 1.1.3.
    """
    figure = new_figure(
        "From wavelength to RGB: three normalisations",
        "CIE 1931 2° observer to linear sRGB; the strips are clamped to 0…1 and sRGB-encoded.\n"
        f"Marked: {wavelength_words(wavelengths)}.",
        size=(8.0, 8.0),
    )
    nm = np.arange(360.0, 831.0)
    panels = figure.subplots(6, 1, sharex=True, height_ratios=[5.0, 1.0] * 3)
    for index, (normalization, words) in enumerate(_WORDS.items()):
        curves, strip = panels[2 * index], panels[2 * index + 1]
        rgb = wavelength_color(nm, normalization)
        grid(curves)
        curves.axhline(0.0, color=GREY, linewidth=0.8)
        for (name, color, style), channel in zip(_CHANNELS, rgb.T, strict=True):
            curves.plot(nm, channel, color=color, linestyle=style, linewidth=1.8, label=name)
        for at in wavelengths:
            if nm[0] <= at <= nm[-1]:
                curves.axvline(at, color=GREY, linewidth=0.8, linestyle=":")
        curves.set_title(words, loc="left", fontsize=10)
        curves.set_ylabel("linear sRGB [1]")
        shown = srgb_encode(np.clip(rgb, 0.0, 1.0))
        strip.imshow(
            shown[None, :, :], extent=(359.5, 830.5, 0.0, 1.0), aspect="auto",
            interpolation="nearest",
        )  # fmt: skip
        strip.set_yticks([])
    panels[0].legend(loc="upper right", ncols=3, framealpha=1.0)
    panels[-1].set_xlabel("wavelength [nm]")
    panels[-1].set_xlim(nm[0], nm[-1])
    return figure
