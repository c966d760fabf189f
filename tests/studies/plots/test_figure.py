from __future__ import annotations

import io
import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import AirlightError
from airlight.planets import Planet
from airlight.studies.plots.density import density
from airlight.studies.plots.figure import (
    FORMATS,
    new_figure,
    wavelength_ink,
    wavelength_strip,
    write_figure,
)


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_figure_becomes_the_same_bytes_each_time(
    suffix: str, planet: Planet, monkeypatch: pytest.MonkeyPatch
) -> None:
    # no date and no random name is in the file: drawings of two years are equal to the byte
    # (matplotlib takes its date from SOURCE_DATE_EPOCH, if it writes any)
    drawn = []
    for year in range(2):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", str(year * 31_557_600))
        file = io.BytesIO()
        write_figure(density(planet), file, suffix, 50.0)
        drawn.append(file.getvalue())
    assert len(drawn[0]) > 5000
    assert drawn[0] == drawn[1]


def test_without_matplotlib_one_line_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(AirlightError, match=r"pip install 'airlight\[plots\]'"):
        new_figure("nothing")


def test_lines_of_every_wavelength_stand_out_from_white_paper() -> None:
    # WCAG 2.2, 1.4.11: graphics need a contrast of 3:1, which is a luminance below 0.3
    ink = np.array(wavelength_ink(np.arange(300.0, 900.0, 5.0)))
    linear = np.where(ink <= 0.04045, ink / 12.92, ((ink + 0.055) / 1.055) ** 2.4)
    assert (linear @ [0.2126, 0.7152, 0.0722]).max() < 0.3


def test_the_strip_is_dark_where_the_eye_sees_nothing() -> None:
    # CIE 1931: at 380 and 750 nm no matching function is above 0.0066, which the sRGB curve of
    # 12.92 x shows as 0.08 at most
    strip = wavelength_strip([380.0, 750.0, 550.0])
    assert_allclose(strip[:2], 0.0, atol=0.08)
    assert strip[2].argmax() == 1


def test_a_long_title_has_several_lines() -> None:
    from airlight.studies.plots.figure import new_figure

    title = new_figure("a planet of a long name: " * 6).get_suptitle()
    assert title.count("\n") == 2
