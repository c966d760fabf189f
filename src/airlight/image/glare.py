r"""Glare: light scattered by a lens around bright points, by a pyramid of coarser pictures.

Lenses and the eye scatter a few per cent of the light with a point-spread function proportional to
the inverse square of the angle. Level k of the pyramid has texels of 2ᵏ pixels, means of the
previous level with the weights 1 3 3 1; blurred by the weights 1 2 1 and upsampled, a point becomes
about a Gaussian with a standard deviation of 2ᵏ pixels. Each level has the weight of its octave of
angles, so that

.. math:: P(θ) = \frac{1}{2π \ln(θ_1/θ_0)} \frac{t}{θ^2}, \quad θ_0 < θ < θ_1

with the total t. Energy is conserved, with mirroring at the edges. Angles are those of the centre
of the picture.

References
----------
Vos, J. J. (1984), Disability glare - a state of the art report, CIE Journal 3/2, 39: the eye's
10 cd m⁻² per lx at 1°, falling with the square of the angle. CIE 146:2002. Spencer et al. (1995),
Physically-based glare effects for digital images, SIGGRAPH 95, 325. doi:10.1145/218380.218466
"""

from __future__ import annotations

from math import log
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.large_arrays import bands, release, zeros
from airlight.kernel.threads import run_blocks

Float32Array = NDArray[np.float32]

#: Fraction of the light that is spread between the two angles: a third of the eye's. [1]
TOTAL: Final = 0.03
#: Angles between which light is spread; the spread light is halved there and falls faster beyond.
#: [rad]
FINEST: Final = 0.1 * np.pi / 180.0
COARSEST: Final = 12.0 * np.pi / 180.0
#: Geometric mean of the angle to which a level spreads light, in its texels. [1]
_SPREAD: Final = 1.06
#: Largest of these angles, relative to the shorter side of the picture. [1]
_LARGEST: Final = 0.25
#: Largest amount of glare.
MOST: Final = 10.0

_HALF = np.float32(0.5)
_EIGHTH, _THREE_EIGHTHS = np.float32(0.125), np.float32(0.375)
_QUARTER, _THREE_QUARTERS = np.float32(0.25), np.float32(0.75)
#: Texels in one block of rows.
_BLOCK: Final = 1 << 16


@kernel
def glare_share(level, pixel_angle, shorter):
    r"""Fraction of the light spread by a level of the pyramid, for an amount of 1.

    .. math:: \frac{t \ln 2}{\ln(θ_1/θ_0)}
              \frac{θ^2}{θ^2 + θ_0^2} \frac{θ_e^2}{θ^2 + θ_e^2}, \quad
              θ = 1.06 · 2^k θ_{px}

    where θₑ is θ₁, or less for a small picture.

    Parameters
    ----------
    level : int
        Level k of the pyramid; the picture itself is level 0.
    pixel_angle : float
        Angle of a pixel; 0 for a picture without angles. [rad]
    shorter : float
        Shorter side of the picture. [pixel]

    Returns
    -------
    float
        Share. [1]

    Examples
    --------
    >>> total = sum(glare_share(k, 1e-3, 1e9) for k in range(-9, 20))
    >>> print(f"{total:.4f}")
    0.0300
    """
    angle = _SPREAD * pixel_angle * 2.0 ** float(level)
    square, inner = angle * angle, FINEST * FINEST
    end = _LARGEST * shorter * pixel_angle
    outer = 1.0 / (1.0 / (COARSEST * COARSEST) + 1.0 / (end * end))
    share = TOTAL * log(2.0) / log(COARSEST / FINEST) * square / (square + inner)
    return share * outer / (square + outer)


@kernel
def glare_levels(pixel_angle, shorter):
    """Number of levels of the pyramid; the last has two to four texels on the shorter side.

    Parameters
    ----------
    pixel_angle, shorter :
        Arguments of ``glare_share``.

    Examples
    --------
    >>> glare_levels(1e-3, 720.0), glare_levels(1e-3, 3.0), glare_levels(0.0, 720.0)
    (8, 0, 0)
    """
    levels = 0
    rest = shorter
    while pixel_angle > 0.0 and rest >= 4.0:
        levels += 1
        rest *= 0.5
    return levels


@inlined
def _mean_across(finer, row, column):
    """Mean of four texels of a row with the weights 1 3 3 1; rows and columns are clamped."""
    y = min(max(row, 0), finer.shape[0] - 1)
    last = finer.shape[1] - 1
    inner = finer[y, 2 * column] + finer[y, min(2 * column + 1, last)]
    outer = finer[y, max(2 * column - 1, 0)] + finer[y, min(2 * column + 2, last)]
    return _THREE_EIGHTHS * inner + _EIGHTH * outer


@inlined
def coarser_texel(finer, row, column):
    """Texel of the next coarser level.

    Parameters
    ----------
    finer : array, shape (h, w)
        Level before, of one channel; in a shader of four.
    row, column : int
        Position in the coarser level, of half as many rows and columns, rounded up.
    """
    inner = _mean_across(finer, 2 * row, column) + _mean_across(finer, 2 * row + 1, column)
    outer = _mean_across(finer, 2 * row - 1, column) + _mean_across(finer, 2 * row + 2, column)
    return _THREE_EIGHTHS * inner + _EIGHTH * outer


@inlined
def finer_texel(coarser, row, column):
    """Level interpolated at a texel of the next finer one, from four texels.

    Parameters
    ----------
    coarser : array, shape (h, w)
        Level, of one channel; in a shader of four.
    row, column : int
        Position in the finer level.
    """
    near, beside = row // 2, column // 2
    far = min(max(near + 2 * (row - 2 * near) - 1, 0), coarser.shape[0] - 1)
    aside = min(max(beside + 2 * (column - 2 * beside) - 1, 0), coarser.shape[1] - 1)
    return _THREE_QUARTERS * (
        _THREE_QUARTERS * coarser[near, beside] + _QUARTER * coarser[near, aside]
    ) + _QUARTER * (_THREE_QUARTERS * coarser[far, beside] + _QUARTER * coarser[far, aside])


@inlined
def _blurred_across(level, row, column):
    """Mean of three texels of a row with the weights 1 2 1; rows and columns are clamped."""
    y = min(max(row, 0), level.shape[0] - 1)
    beside = level[y, max(column - 1, 0)] + level[y, min(column + 1, level.shape[1] - 1)]
    return _HALF * level[y, column] + _QUARTER * beside


@inlined
def blurred_texel(level, row, column):
    """Mean of a texel and its eight neighbours.

    Parameters
    ----------
    level : array, shape (h, w)
        Level, of one channel; in a shader of four.
    row, column : int
        Position in the level.
    """
    beside = _blurred_across(level, row - 1, column) + _blurred_across(level, row + 1, column)
    return _HALF * _blurred_across(level, row, column) + _QUARTER * beside


@inlined
def spread_texel(level, coarser, row, column, share, more):
    """Light spread by a level and all coarser ones, at a texel of the level.

    Parameters
    ----------
    level, coarser : array, shape (h, w)
        Level, and light spread by all coarser ones.
    row, column : int
        Place in the level.
    share : float
        Share of the level, ``glare_share``. [1]
    more : bool
        Whether there is a coarser level.
    """
    if more:
        own = np.float32(share) * blurred_texel(level, row, column)
        return own + finer_texel(coarser, row, column)
    return np.float32(share) * blurred_texel(level, row, column)


@inlined
def beyond_circle(row, column, height, width):
    """Whether a pixel is outside the largest circle of a picture."""
    across, up, diameter = 2 * column + 1 - width, 2 * row + 1 - height, min(width, height)
    return across * across + up * up > diameter * diameter


@inlined
def glared_texel(picture, coarser, row, column, amount, total, circle):
    """Light of a pixel with glare.

    Parameters
    ----------
    picture, coarser : array, shape (h, w)
        Picture, and light spread by its levels, in texels of two pixels.
    row, column : int
        Position in the picture.
    amount : float
        Amount of glare, 1 for that of a lens. [1]
    total : float
        Sum of the shares of all levels. [1]
    circle : bool
        Whether the picture is limited to the largest circle, outside of which it is unchanged.
    """
    beyond = False
    if circle:
        beyond = beyond_circle(row, column, picture.shape[0], picture.shape[1])
    if amount > 0.0 and total > 0.0 and not beyond:
        kept = np.float32(1.0 - amount * total)
        return kept * picture[row, column] + np.float32(amount) * finer_texel(coarser, row, column)
    return picture[row, column]


@compiled_loop
def _coarsen(first, last, finer, out):
    for row in range(first, last):
        for c in range(3):
            channel = finer[:, :, c]
            for column in range(out.shape[1]):
                out[row, column, c] = coarser_texel(channel, row, column)


@compiled_loop
def _spread(first, last, level, coarser, share, more, out):
    for row in range(first, last):
        for c in range(3):
            own, others = level[:, :, c], coarser[:, :, c]
            for column in range(level.shape[1]):
                out[row, column, c] = spread_texel(own, others, row, column, share, more)


@compiled_loop
def _glare(first, last, picture, coarser, amount, total, circle, origin, out):
    for row in range(first, last):
        for c in range(3):
            own, others = picture[:, :, c], coarser[:, :, c]
            for column in range(out.shape[1]):
                share = amount
                if circle[0] > 0 and beyond_circle(
                    origin[1] + row, origin[0] + column, circle[1], circle[0]
                ):
                    share = 0.0
                out[row - first, column, c] = glared_texel(
                    own, others, row, column, share, total, False
                )


class Glare:
    """Glare of a picture.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear light of any unit; values that are not finite are not spread.
    pixel_angle : float
        Angle of the central pixel; 0 for no glare. [rad]
    amount : float
        Amount, 0 to 10: 1 is that of a lens, 0 none. [1]
    circle : (int, int), optional
        Width and height of the whole picture of a dome: no light is spread beyond the circle.
        [pixel]
    origin : (int, int)
        Column and row of the first pixel in the whole picture. [pixel]

    Raises
    ------
    ParameterError
        If the amount is not allowed.

    Examples
    --------
    >>> sky = np.full((60, 80, 3), 2.0, np.float32)
    >>> np.ptp(Glare(sky, 0.01).rows(0, 60))  # a uniform picture has none to be seen
    np.float32(0.0)
    """

    def __init__(
        self,
        rgb: NDArray[np.floating[Any]],
        pixel_angle: float,
        amount: float = 1.0,
        circle: tuple[int, int] | None = None,
        origin: tuple[int, int] = (0, 0),
    ) -> None:
        self._picture, self._amount = rgb, checked_amount(amount)
        self._place = circle or (0, 0), origin
        shorter = float(min(rgb.shape[:2]))
        count = glare_levels(pixel_angle, shorter) if amount > 0.0 else 0
        shares = [glare_share(level, pixel_angle, shorter) for level in range(1, count + 1)]
        self._total = float(sum(shares))
        self._coarser: Float32Array = np.zeros((1, 1, 3), np.float32)
        if count:
            self._coarser = _spread_levels(_finite(rgb), shares)

    @property
    def none(self) -> bool:
        """Whether there is no glare."""
        return self._total == 0.0

    def rows(self, first: int, last: int) -> NDArray[np.floating[Any]]:
        """Rows ``first`` to ``last`` - 1 of the picture with glare.

        Parameters
        ----------
        first, last : int
            Range of rows.

        Returns
        -------
        array, shape (last - first, width, 3)
            Linear light; without glare a view of the picture.
        """
        if self.none:
            return self._picture[first:last]
        out = np.empty_like(self._picture[first:last])
        _glare(
            first, last, self._picture, self._coarser, self._amount, self._total, *self._place, out
        )
        release(self._picture[first:last])
        release(self._coarser[first // 2 : last // 2])
        return out


def checked_amount(amount: float, field: str = "glare") -> float:
    """Validated amount of glare.

    Parameters
    ----------
    amount : float
        Amount. [1]
    field : str
        Name in the error.

    Raises
    ------
    ParameterError
        If it is not 0 to 10.
    """
    if not isinstance(amount, (int, float, np.number)) or not 0.0 <= amount <= MOST:
        raise ParameterError(field, amount, f"0 to {MOST:g}")
    return float(amount)


def _finite(rgb: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """Picture with zeros for values that are not finite."""
    if all(np.isfinite(band.sum()) for band in bands(rgb)):
        return rgb
    finite = zeros(rgb.shape, rgb.dtype)
    for band, copy in zip(bands(rgb), bands(finite), strict=True):
        copy[:] = np.nan_to_num(band, nan=0.0, posinf=0.0, neginf=0.0)
    return finite


def _spread_levels(rgb: NDArray[np.floating[Any]], shares: list[float]) -> Float32Array:
    """Light spread by all levels, shape (height / 2, width / 2, 3)."""
    levels: list[Any] = [rgb]
    for _ in shares:
        height, width = levels[-1].shape[:2]
        levels.append(zeros((-(-height // 2), -(-width // 2), 3), np.float32))
        _in_blocks(_coarsen, levels[-1], levels[-2], levels[-1])
    coarser, more = levels[-1], False
    for level, share in zip(levels[:0:-1], shares[::-1], strict=True):
        spread = zeros(level.shape, np.float32)
        _in_blocks(_spread, spread, level, coarser, share, more, spread)
        coarser, more = spread, True
    return np.asarray(coarser)


def _in_blocks(loop: Any, out: Float32Array, *arguments: Any) -> None:
    """Run a loop over blocks of rows."""
    height, width = out.shape[:2]
    rows = max(1, _BLOCK // width)

    def block(k: int) -> None:
        first, last = k * rows, min((k + 1) * rows, height)
        loop(first, last, *arguments)
        for array in (one for one in arguments if isinstance(one, np.ndarray)):
            scale = len(array) / height
            release(array[int(scale * first) : int(scale * last)])

    run_blocks(block, -(-height // rows))
