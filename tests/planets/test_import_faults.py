"""What a table may not have is refused in one line: file, line, column, value, what is allowed."""

from __future__ import annotations

from pathlib import Path

import pytest

from airlight import AirlightError, import_table
from airlight.cli import main

AIR = "altitude [km],pressure [hPa],temperature [C]\n0,1013,15\n5,540,-17\n10,265,-50\n"
HAZE = "wavelength [nm],extinction [1/km],ssa,g\n440,0.2,0.9,0.7\n550,0.15,0.92,0.68\n"
SAND = "wavelength [um],reflectance [%]\n0.4,20\n0.5,30\n0.6,40\n"
STAR = "wavelength [nm],irradiance [W/m^2/nm]\n400,1\n500,2\n600,1\n"


TABLES = {"atmosphere": AIR, "aerosol": HAZE, "albedo": SAND, "star": STAR}
#: Kind, text of its table, text instead, and the error.
FAULTS = """
atmosphere|hPa|kg|line 1, unit of pressure is 'kg'; allowed: a unit such as hPa, mbar, Pa
atmosphere| [hPa]||line 1, unit of pressure is missing; allowed: hPa, mbar, Pa, in the header
atmosphere| [C]||line 1, unit of temperature is missing
atmosphere|540|nan|line 3, pressure is 'nan hPa'; allowed: more than 0
atmosphere|540|x|line 3, pressure is 'x hPa'
atmosphere|-17|-300|line 3, temperature is '-300 C'; allowed: 1 to
atmosphere|5,540|12,540|line 4, altitude is '10000 m'; allowed: more
atmosphere|540|1100|line 3, pressure is '110000 Pa'; allowed: less than
atmosphere|540,-17|540|line 3 is '2 cells'; allowed: 3
atmosphere|pressure|presure|has no column pressure in its header (did you mean 'presure'?)
aerosol|0.92|1.02|line 3, single_scattering_albedo (ssa) is '1.02'; allowed: 0 to 1
aerosol|0.15|-0.15|line 3, extinction is '-0.15 1/km'
aerosol|0.15||line 3, extinction is 'an empty cell'
aerosol|1/km|m|line 1, unit of extinction is 'm'
aerosol|0.68|1.2|line 3, asymmetry (g) is '1.2'; allowed: -0.999 to 0.999
aerosol|550|440|line 3, wavelength is '440 nm'; allowed: each wavelength once
aerosol|wavelength|wavelenth|has no column wavelength in its header (did you mean 'wavelenth'?)
aerosol|,g|,q|has no column asymmetry, phase_function or moments
albedo|30|130|line 3, reflectance is '130 %'; allowed: 0 to 1
albedo|0.5|0.7|line 4, wavelength is '600 nm'
star|/nm||line 1, unit of irradiance is 'W/m^2'
star|600,1|600,-1|line 4, irradiance is '-1'; allowed: 0 to 1e+09 W/m^2/nm
"""


@pytest.mark.parametrize("fault", FAULTS.strip().splitlines())
def test_faults_are_said_in_one_line(fault: str, tmp_path: Path) -> None:
    kind, old, new, said = fault.split("|")
    file = tmp_path / "table.csv"
    assert old in TABLES[kind]
    file.write_text(TABLES[kind].replace(old, new), encoding="utf-8")
    with pytest.raises(AirlightError) as caught:
        import_table(kind, file)
    assert str(caught.value).startswith(f"{file}: {said}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("soil t.csv", "kind is 'soil'; allowed: atmosphere, aerosol, profile, albedo, star"),
        ("atmosphere none.csv", "none.csv: cannot be read: No such file"),
        ("atmosphere t.csv --unit pressure", "--unit requires NAME=VALUE"),
        ("atmosphere t.csv --unit p=hPa", "--unit is 'p'; allowed: columns of"),
        ("atmosphere t.csv --optical-depth 1", "details of atmosphere is 'optical_depth'"),
        ("atmosphere t.csv -o x.png", "the name of a planet file ends in .toml"),
        ("atmosphere t.csv --planet erth", "--planet is 'erth'"),
        ("atmosphere t.csv --planet p.toml -o ./p.toml", "--output requires another file"),
    ],
)
def test_the_command_says_what_is_wrong(
    words: str,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("t.csv").write_text(AIR, encoding="utf-8")
    Path("p.toml").touch()
    assert main(["import", *words.split()]) == 2
    line = capsys.readouterr().err
    assert said in line
    assert line.count("\n") == 1


def test_units_may_be_given_and_the_file_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("t.csv").write_text(AIR.replace(" [hPa]", ""), encoding="utf-8")
    assert main(["import", "atmosphere", "t.csv", "--unit", "pressure=hPa"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("# Earth with air of t.csv.\n")
    assert "\n# t.csv: 3 of 3 rows" in text
