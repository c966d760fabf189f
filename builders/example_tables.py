"""Write the tables of ``examples/tables``: published layouts, values by formula.

python builders/example_tables.py

Air and ozone: U.S. Standard Atmosphere, 1976, and AFGL-TR-86-0110 as the preset ``earth`` has them;
particles by Henyey-Greenstein's formula; the star a black body.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray

from airlight.physics.constants import BOLTZMANN
from airlight.physics.optics.gas_absorption import ozone_profile_afgl1986
from airlight.physics.spectra.blackbody import star_irradiance
from airlight.planets import load_planet
from airlight.planets.matter.profiles import Layers

FOLDER = Path(__file__).parents[1] / "examples" / "tables"
#: Altitudes of AFGL's tables. [km]
AFGL = [*range(26), 27.5, 30, 32.5, 35, 37.5, 40, 42.5, 45, 47.5, 50, *range(55, 125, 5)]
AERONET = (440, 675, 870, 1020)


def air(altitude):
    """Pressure [Pa], temperature [K] and ozone [m⁻³] at altitudes. [m]"""
    profile = load_planet("earth").constituents[0].profile
    assert isinstance(profile, Layers)
    h, n = ozone_profile_afgl1986()
    ozone = np.exp(np.interp(altitude, h[n > 0], np.log(n[n > 0])))
    ozone *= np.exp(-np.maximum(altitude - h[n > 0][-1], 0.0) / 4e3)
    pressure = 101325.0 * profile.air.pressure_ratio(altitude)
    return pressure, profile.air.temperature(altitude), ozone


def afgl() -> str:
    """Layout of libRadtran's ``data/atmmod/afglus.dat``."""
    z = np.array(AFGL[::-1], float)
    p, t, o3 = air(1e3 * z)
    n = p / (BOLTZMANN * t)
    columns = [p / 100, t, n / 1e6, o3 / 1e6, 0.20948 * n / 1e6, 0 * z, 3.3e-4 * n / 1e6, 0 * z]
    names = ("p(mb)", "T(K)", "air(cm-3)", "o3(cm-3)", "o2(cm-3)", "h2o(cm-3)", "co2(cm-3)")
    lines = ["# Layout of AFGL atmospheric constituent profiles; values by formula"]
    lines.append("#     z(km)  " + "  ".join(f"{name:>11}" for name in (*names, "no2(cm-3)")))
    for k, one in enumerate(z):
        lines.append(f"{one:9.3f} " + " ".join(f"{column[k]:.6e}" for column in columns))
    return "\n".join(lines) + "\n"


def radiosonde() -> str:
    """Layout of weather.uwyo.edu/upperair/sounding.html, text: list."""
    rule = "-" * 77
    names = "   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV"
    units = "    hPa     m      C      C      %    g/kg    deg   knot     K      K      K "
    lines = ["00000 XXX Nowhere Observations at 12Z 01 Jan 2026", "", rule, names, units, rule]
    lines.append(" 1000.0    111")
    for h in np.unique(np.round(np.geomspace(345, 31000, 70))):
        p, t, _ = air(h)
        row = f"{p / 100:7.1f}{h:7.0f}{t - 273.15:7.1f}"
        if h < 12e3:
            theta = t * (1e5 / p) ** 0.286
            row += f"{t - 283.15:7.1f}{45:7.0f}{0.5:7.2f}{270:7.0f}{20:7.0f}" + f"{theta:7.1f}" * 3
        lines.append(row)
    lines += ["Station information and sounding indices", "", "  Station identifier: XXX"]
    return "\n".join(lines) + "\n"


def ozonesonde() -> str:
    """Layout of WOUDC's extended CSV, GAW Report 163."""
    lines = [
        "*values by formula",
        "#CONTENT",
        "Class,Category,Level,Form",
        "WOUDC,OzoneSonde,1.0,1",
    ]
    lines += ["", "#LOCATION", "Latitude,Longitude,Height", "0,0,10", "", "#PROFILE"]
    lines.append("Duration,Pressure,O3PartialPressure,Temperature,LevelCode,GPHeight")
    for h in np.linspace(10, 32000, 160):
        p, t, o3 = air(h)
        partial = 1e3 * o3 * BOLTZMANN * t
        lines.append(f"{h / 5:.0f},{p / 100:.3f},{partial:.4f},{t - 273.15:.2f},0,{h:.1f}")
    return "\n".join([*lines, "", "#FLIGHT_SUMMARY", "IntegratedO3", "300"]) + "\n"


def lobe(g, angle):
    """Henyey-Greenstein phase function, normalised to 4π."""
    return (1 - g * g) / (1 + g * g - 2 * g * np.cos(np.radians(angle))) ** 1.5


def aeronet(columns: dict[str, float], title: str) -> str:
    """Layout of AERONET's version 3 inversions: six lines, names, rows."""
    lines = ["AERONET Version 3;", "Nowhere", f"Version 3: Almucantar Level 1.5 {title}"]
    lines += ["The values are by formula", "Contact: none", "All Points,UNITS can be found at,,,"]
    dates = "Site,Date(dd:mm:yyyy),Time(hh:mm:ss),Day_of_Year,Day_of_Year(Fraction)"
    ends = "Sky_Residual(%),Surface_Albedo[440m],Inversion_Data_Quality_Level"
    lines.append(",".join([dates, *columns, ends]))
    for hour in (8, 9):
        row = [f"{value:.6f}" for value in columns.values()]
        day = f"Nowhere,01:01:2026,{hour:02d}:00:00,1,1.{hour}"
        lines.append(",".join([day, *row, "3.1,0.07,lev15"]))
    absent = ",".join(["-999."] * len(columns))
    lines.append(f"Nowhere,01:01:2026,10:00:00,1,1.4,{absent},3.1,0.07,lev15")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write all tables."""
    FOLDER.mkdir(exist_ok=True)
    texts = {"afgl-layout.dat": afgl(), "radiosonde-layout.txt": radiosonde()}
    texts["ozonesonde-layout.csv"] = ozonesonde()
    aod = {f"AOD_Extinction-Total[{nm}nm]": 0.3 * (550 / nm) ** 1.3 for nm in AERONET}
    ssa = {f"Single_Scattering_Albedo[{nm}nm]": 0.97 - nm / 4e4 for nm in AERONET}
    g = {f"Asymmetry_Factor-Total[{nm}nm]": 0.74 - nm / 1e4 for nm in AERONET}
    texts["aeronet-layout.all"] = aeronet(aod | ssa | g, "Inversion")
    angles = [*np.arange(180, 10, -4.0), *np.arange(10, -0.5, -1.0)]
    phase = {f"{a:.6f}[{nm}nm]": lobe(0.74 - nm / 1e4, a) for nm in AERONET for a in angles}
    texts["aeronet-layout.pfn"] = aeronet(phase, "Phase Function")
    rows = [
        (nm, 0.15 * (550 / nm) ** 0.8, 0.9 + nm / 2e4, 0.72) for nm in (350, 440, 550, 680, 1000)
    ]
    texts["dust.csv"] = "# by formula\nwavelength [nm],extinction [1/km],ssa,g\n" + "".join(
        f"{nm},{e:.4f},{w:.4f},{asymmetry}\n" for nm, e, w, asymmetry in rows
    )
    um = np.linspace(2.5, 0.35, 60)
    head = "Name: Made-up concrete\nType: manmade\nMeasurement: by formula\n"
    head += "First Column: X\nSecond Column: Y\nX Units: Wavelength (micrometers)\n"
    head += "Y Units: Reflectance (percentage)\nNumber of X Values: 60\n\n"
    texts["concrete.spectrum.txt"] = head + "".join(
        f"{w:.4f}\t{12 + 25 * (1 - np.exp(-w)):.4f}\n" for w in um
    )
    nm = np.arange(280.0, 1101.0, 10.0)
    flux = 1e3 * star_irradiance(nm, 3500.0, 2.6e8, 3.5e10)
    texts["star.txt"] = "".join(f"{a:.1f} {b:.4f}\n" for a, b in zip(nm, flux, strict=True))
    lidar = [(z, 0.1 * np.exp(-((z - 2) ** 2)) + 0.05 * (z < 1)) for z in np.arange(0, 6.01, 0.1)]
    texts["lidar.csv"] = "z [km],extinction [1/km]\n" + "".join(
        f"{z:.2f},{e:.6f}\n" for z, e in lidar
    )
    for name, text in texts.items():
        (FOLDER / name).write_text(text, encoding="utf-8")
    angle = np.arange(0.0, 180.5, 2.0)
    p11 = np.stack([lobe(one, angle) for one in (0.6, 0.58, 0.55)])
    mu = np.cos(np.radians(angle))
    axes = ("wavelength", "angle")
    variables = {"p11": (axes, p11), "p12": (axes, -0.5 * p11 * (1 - mu**2) / (1 + mu**2))}
    one = ("wavelength",)
    data = xarray.Dataset(
        variables
        | {
            "extinction": (one, [0.2, 0.15, 0.11], {"units": "km-1"}),
            "ssa": (one, [0.95, 0.94, 0.93]),
        },
        {
            "wavelength": (one, [0.44, 0.55, 0.68], {"units": "um"}),
            "angle": (("angle",), angle, {"units": "degree"}),
        },
    )
    data.to_netcdf(FOLDER / "phase-matrix.nc", engine="scipy")


if __name__ == "__main__":
    main()
