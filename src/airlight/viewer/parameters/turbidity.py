"""Turbidity of an atmosphere, and the haze of a given turbidity.

In the Python subset that is emitted as JavaScript for the page.
"""

from __future__ import annotations


def turbidity_of(gas: float, haze: float) -> float:
    """Turbidity of an atmosphere: T = (τ_gas + τ_haze) / τ_gas. [1]

    Parameters
    ----------
    gas, haze : float
        Vertical optical depths of gas and haze, here at 550 nm. [1]

    References
    ----------
    Preetham, A. J., Shirley, P. & Smits, B. (1999), A Practical Analytic Model for Daylight,
    SIGGRAPH 99, section 3.1, after McCartney, E. J. (1976), Optics of the Atmosphere.

    Examples
    --------
    >>> turbidity_of(0.1, 0.2)
    3.0
    """
    return 1.0 + haze / gas


def haze_of(turbidity: float, gas: float) -> float:
    """Haze optical depth of a turbidity; inverse of ``turbidity_of``. [1]

    Examples
    --------
    >>> haze_of(3.0, 0.1)
    0.2
    """
    return (turbidity - 1.0) * gas
