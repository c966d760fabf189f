"""Effective medium approximation: refractive index of particles with inclusions."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError

ComplexArray = npt.NDArray[np.complex128]


def maxwell_garnett(
    matrix: npt.ArrayLike, inclusions: npt.ArrayLike, fraction: float
) -> ComplexArray:
    r"""Effective refractive index of a matrix with small spherical inclusions (Maxwell Garnett).

    .. math:: \varepsilon = \varepsilon_m \frac{1 + 2f\beta}{1 - f\beta}, \qquad
              \beta = \frac{\varepsilon_i - \varepsilon_m}{\varepsilon_i + 2\varepsilon_m},
              \qquad \varepsilon = (n + ik)^2

    Parameters
    ----------
    matrix, inclusions : complex array, shape (...)
        Refractive index n + ik of each. [1]
    fraction : float
        Volume fraction of the inclusions, 0 to 1. [1]

    Returns
    -------
    complex array, shape (...)
        Refractive index n + ik. [1]

    Raises
    ------
    ParameterError
        If the fraction is not between 0 and 1.

    Notes
    -----
    Valid for inclusions much smaller than the wavelength and a small fraction; at 0 and 1 it gives
    the pure substances.

    References
    ----------
    Bohren & Huffman (1983), Absorption and Scattering of Light by Small Particles, eq. 8.50.

    Examples
    --------
    >>> complex(maxwell_garnett(1.5, 1.5, 0.3))  # nothing added
    (1.5+0j)
    """
    if not 0.0 <= fraction <= 1.0:
        raise ParameterError("fraction", fraction, "0 to 1")
    host = np.asarray(matrix, dtype=np.complex128) ** 2
    guest = np.asarray(inclusions, dtype=np.complex128) ** 2
    beta = (guest - host) / (guest + 2.0 * host)
    root = np.sqrt(host * (1.0 + 2.0 * fraction * beta) / (1.0 - fraction * beta))
    return np.asarray(root)
