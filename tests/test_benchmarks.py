"""The benchmarks are there to be run, and what they compare airlight with is right."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import pytest
from numpy.testing import assert_allclose

import openspace_tests
from airlight.render.gpu.device.device import NoDevice, open_device
from airlight.solver.tables.columns import columns
from baseline import checks, compiled, plain, work

ROOT = Path(__file__).parents[1]


@pytest.fixture(params=["C", "NumPy"])
def baseline(request: pytest.FixtureRequest, tmp_path: Path) -> Any:
    if request.param == "NumPy":
        return plain
    if compiled.compiler() is None:
        pytest.skip("no C compiler: there is no cc, and CC names none")
    return compiled.Classic(tmp_path)


def test_columns_of_the_baseline_meet_the_golden_table(baseline: Any) -> None:
    # an authority converged to 1e-13; the tolerances are the trapezoid's own error
    checks.columns_are_golden(baseline)


def test_columns_of_the_baseline_are_airlights(baseline: Any) -> None:
    # a second method; the longest ray's steps are a tenth of the aerosol's scale height
    rays = work.rays(50)
    expected = columns(*rays, work.BOTTOM, work.whole_air().density)
    assert_allclose(baseline.columns(*rays, work.AIR, 20_000), expected, rtol=1e-4, atol=0.01)


def test_look_ups_of_the_baseline_are_airlights(baseline: Any) -> None:
    # a second method for the same interpolation
    checks.look_ups_are_the_tables(baseline)


def test_gathers_of_the_baseline_are_exact_in_even_light(baseline: Any) -> None:
    # a law: the addition theorem gives twice Rayleigh's phase function
    checks.gathers_are_exact_in_even_light(baseline)


def test_gathers_of_the_baseline_converge_to_the_marched_first_order() -> None:
    # A second method: the first order marched, on another rule. What is left at so many directions
    # is the small table's interpolation; 512 directions are off by 6 %.
    table, positions = work.first_order((32, 64, 16, 8)), work.positions(3, lit_air=True)
    scattering = work.whole_air().scattering[0]
    got = plain.gather(
        table.values, positions, table.layout.grid, scattering, work.AIR[1], (256, 64)
    )  # fmt: skip
    assert_allclose(got, work.true_gather(positions, 24), rtol=0.03)


@pytest.mark.validation  # 22 s of CPU, most of it shaders; tests/render/gpu has what is timed
def test_the_tests_of_the_openspace_paper_run_small(
    tmp_path: Path, lacking: Callable[[str], NoReturn]
) -> None:
    # a row for each test, with times; the numbers are those of a machine
    try:
        open_device()
    except NoDevice as reason:
        lacking(str(reason))
    small = ["--frames", "2", "--size", "32x18", "--dome", "32", "--quality", "preview"]
    openspace_tests.main([*small, "--markdown", str(tmp_path / "table.md")])
    rows = (tmp_path / "table.md").read_text(encoding="utf-8").splitlines()[4:10]
    names = [line.split(" | ")[0].removeprefix("| ") for line in rows]
    flights = (
        f"flight, {air}" for air in ("1 atmosphere", "without", "2 atmospheres", "3 atmospheres")
    )
    assert names == [*flights, "dome", "edit to its light"]
    assert all(float(line.split(" | ")[2]) > 0.0 for line in rows)


@pytest.mark.slow
def test_every_benchmark_is_collected() -> None:
    # each bench_*.py gives at least one; the command is the one in benchmarks/README.md
    # of their own process, whoever runs this test: a worker of xdist would have them disabled
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "benchmarks", "--collect-only", "-q"],
        cwd=ROOT, env=own, capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    for file in sorted((ROOT / "benchmarks").glob("bench_*.py")):
        assert f"benchmarks/{file.name}::test_" in done.stdout
    assert done.stdout.count("::test_") > 30
