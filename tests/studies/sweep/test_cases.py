"""The CSV of many observers: every bad cell is named, every column is kept."""

from __future__ import annotations

import csv
import io
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from airlight.errors import AirlightError, FileError
from airlight.studies.sweep.cases import COLUMNS, Cases, read_cases, write_cases

HEADER = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg"


def written(tmp_path: Path, text: str, encoding: str = "utf-8") -> str:
    path = tmp_path / "cases.csv"
    path.write_bytes(text.encode(encoding))
    return str(path)


def test_columns_are_found_by_name_in_any_order_among_others(tmp_path: Path) -> None:
    text = "site,azimuth_deg,view_zenith_deg,sun_zenith_deg,altitude_m\nroof,90,30,60,2.5e1\n"
    cases = read_cases(written(tmp_path, text))
    assert_array_equal(cases.values, [[25.0, 60.0, 30.0, 90.0]])
    assert cases.rows == [["roof", "90", "30", "60", "2.5e1"]]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_files_of_spreadsheets_are_read(tmp_path: Path, encoding: str, newline: str) -> None:
    text = newline.join(["# a note", HEADER, "0,60,30,90", "", "400000,85,110,-180"])
    cases = read_cases(written(tmp_path, text, encoding))
    assert_array_equal(cases.values, [[0, 60, 30, 90], [400000, 85, 110, -180]])
    assert cases.comments == ["# a note"]


def test_a_table_without_rows_is_a_table(tmp_path: Path) -> None:
    assert read_cases(written(tmp_path, HEADER + "\n")).values.shape == (0, 4)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("low,60,30,90", "line 3, altitude_m is 'low'; allowed: 0 to 1e+12"),
        ("-1,60,30,90", "line 3, altitude_m is '-1'; allowed: 0 to 1e+12"),
        ("0,nan,30,90", "line 3, sun_zenith_deg is 'nan'; allowed: 0 to 180"),
        ("0,60,,90", "line 3, view_zenith_deg is ''; allowed: 0 to 180"),
        ("0,60,200,90", "line 3, view_zenith_deg is '200'; allowed: 0 to 180"),
        ("0,60,30,inf", "line 3, azimuth_deg is 'inf'; allowed: -360 to 360"),
        ("0,60,30", "line 3 is '3 cells'; allowed: 4, as in the header"),
        ("0,60,30,90,5", "line 3 is '5 cells'; allowed: 4, as in the header"),
    ],
)
def test_a_bad_cell_is_named_with_file_line_column_value_and_range(
    tmp_path: Path, row: str, message: str
) -> None:
    path = written(tmp_path, f"{HEADER}\n0,60,30,90\n{row}\n")
    with pytest.raises(AirlightError) as refusal:
        read_cases(path)
    assert str(refusal.value) == f"{path}: {message}"


def test_the_line_is_the_editor_s_line(tmp_path: Path) -> None:
    # comments, empty lines and a cell of two lines stand before it
    text = f'# note\n{HEADER},note\n\n0,60,30,90,"two\nlines"\n0,60,30,x,\n'
    with pytest.raises(AirlightError, match="line 6, azimuth_deg is 'x'"):
        read_cases(written(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "has no column altitude_m"),
        ("# only a note\n", "has no column altitude_m"),
        ("altitude_m,azimuth_deg\n", "has no column sun_zenith_deg, view_zenith_deg"),
        (f"{HEADER},azimuth_deg\n", "has the column azimuth_deg more than once"),
        (f"{HEADER}\n0,0,\0,0\n", "is not text"),
    ],
)
def test_a_file_that_is_no_table_of_observers_is_refused(
    tmp_path: Path, text: str, reason: str
) -> None:
    with pytest.raises(AirlightError, match=reason):
        read_cases(written(tmp_path, text))


@given(data=st.binary(max_size=200))
def test_any_bytes_give_a_table_or_one_line(
    data: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("bytes") / "cases.csv"
    path.write_bytes(HEADER.encode() + b"\n" + data)
    try:
        cases = read_cases(str(path))
    except AirlightError as error:
        assert "\n" not in str(error)
    else:
        assert np.isfinite(cases.values).all()


def test_what_is_written_is_what_was_read_with_answers_of_nine_digits(tmp_path: Path) -> None:
    text = f'# a note\n{HEADER},site\n0,60,30,90,"roof, north"\n1e3,0,0,0,\n'
    cases = read_cases(written(tmp_path, text))
    answers = np.array([[1.0 / 3.0, 2.0], [3e-12, 0.0]])
    write_cases(str(tmp_path / "out.csv"), cases, [680.0, 550.5], answers)
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[0] == "# a note"
    assert lines[1] == f"{HEADER},site,radiance_680nm,radiance_550.5nm"
    assert lines[2] == '0,60,30,90,"roof, north",3.33333333e-01,2.00000000e+00'
    assert lines[3] == "1e3,0,0,0,,3.00000000e-12,0.00000000e+00"


@given(
    values=st.lists(
        st.tuples(*(st.floats(low, high) for low, high in COLUMNS.values())), max_size=5
    )
)
def test_every_number_in_range_is_read_as_it_was_written(
    values: list[tuple[float, ...]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    stream = io.StringIO()
    csv.writer(stream).writerows([HEADER.split(","), *values])
    path = tmp_path_factory.mktemp("numbers") / "cases.csv"
    path.write_text(stream.getvalue(), newline="")
    assert_array_equal(read_cases(str(path)).values, np.array(values).reshape(-1, 4))


def test_a_dash_is_the_standard_stream(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{HEADER}\n0,60,30,90\n"))
    cases = read_cases("-")
    write_cases("-", cases, [550.0], np.array([[1.0]]))
    out = capsys.readouterr().out
    assert out == f"{HEADER},radiance_550nm\n0,60,30,90,1.00000000e+00\n"


def test_a_bad_cell_of_the_standard_input_is_named_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{HEADER}\n0,60,30,west\n"))
    with pytest.raises(AirlightError, match="standard input: line 2, azimuth_deg is 'west'"):
        read_cases("-")


def test_too_few_answers_never_leave_a_file(tmp_path: Path) -> None:
    cases = Cases(comments=[], header=["a"], rows=[["1"], ["2"]], values=np.zeros((2, 4)))
    with pytest.raises(ValueError, match="zip"):
        write_cases(str(tmp_path / "out.csv"), cases, [550.0], np.array([[1.0]]))
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "in.csv")
    with pytest.raises(FileError, match=r"in\.csv: is not a regular file, so it cannot be read"):
        read_cases(str(tmp_path / "in.csv"))
