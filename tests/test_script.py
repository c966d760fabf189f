"""``scripts/test`` fails when any of its checks does, and says which."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "scripts" / "test"
#: Programs of the checks; ``python`` runs pytest, and the site's builder.
PROGRAMS = ("ruff", "mypy", "lint-imports", "airlight", "python")

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the script is for a Unix shell")


@pytest.fixture
def environment(tmp_path: Path) -> Path:
    """Virtual environment whose programs only say their names, and fail where they shall."""
    venv = tmp_path / "venv"
    programs = venv / "bin"
    programs.mkdir(parents=True)
    for name in PROGRAMS:
        (programs / name).write_text(
            "#!/bin/sh\n"
            f'echo "ran {name} $*"\n'
            f'case "{name} $*" in $FAILING) exit 3;; esac\n'
        )  # fmt: skip
        (programs / name).chmod(0o755)
    # what the script writes after an installation: it installs nothing now
    said = subprocess.run([sys.executable, "-VV"], capture_output=True, text=True, check=True)
    text = f"{said.stdout}{ROOT}\n{(ROOT / 'pyproject.toml').read_text()}"
    (venv / "airlight-installed").write_text(hashlib.sha256(text.encode()).hexdigest())
    (tmp_path / "apt-get").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "apt-get").chmod(0o755)
    return venv


def run(environment: Path, failing: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the script; ``failing`` is a pattern of what a failing program is called with."""
    named = {
        "AIRLIGHT_VENV": str(environment),
        "PYTHON": sys.executable,
        "FAILING": failing,
        "PATH": f"{environment.parent}:{os.environ['PATH']}",
    }
    return subprocess.run(
        ["bash", str(SCRIPT), *arguments], env={**os.environ, **named}, cwd="/",
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip


def test_all_checks_run_and_pass(environment: Path) -> None:
    done = run(environment, "none")
    assert done.returncode == 0, done.stderr
    for said in ("ran ruff check", "ran ruff format --check", "ran mypy", "ran lint-imports",
                 "ran python -m sphinx", "ran python -m pytest"):  # fmt: skip
        assert said in done.stdout
    assert "failed" not in done.stderr


@pytest.mark.parametrize(
    ("failing", "arguments", "named"),
    [
        ("ruff check", (), None),
        ("ruff format*", (), None),
        ("mypy *", (), "mypy"),
        ("mypy *", ("--fast",), "mypy"),
        ("mypy *", ("-k", "horizon"), "mypy"),
        ("lint-imports *", (), "lint-imports (the floors)"),
        ("python -m sphinx*", (), "scripts/docs (the site, without a warning)"),
        ("python -m pytest*", (), "pytest"),
        ("python -m pytest*", ("--fast",), "pytest"),
        ("python -m pytest*", ("-k", "horizon"), "pytest"),
        ("[pm]y*", (), "pytest,mypy,scripts/docs (the site, without a warning)"),
    ],
)
def test_each_check_that_fails_fails_the_script(
    environment: Path, failing: str, arguments: tuple[str, ...], named: str | None
) -> None:
    done = run(environment, failing, *arguments)
    assert done.returncode != 0
    if named is None:  # what takes no time ends the script at once
        assert "ran python -m pytest" not in done.stdout
    else:
        assert done.stderr.splitlines()[-1] == f"scripts/test: failed: {named}"
        assert "ran mypy" in done.stdout


def test_a_program_that_is_gone_fails_the_script(environment: Path) -> None:
    (environment / "bin" / "lint-imports").unlink()
    done = run(environment, "none")
    assert done.returncode != 0
    assert done.stderr.splitlines()[-1] == "scripts/test: failed: lint-imports (the floors)"
    assert "No such file" in done.stdout


def test_the_fast_part_builds_no_site(environment: Path) -> None:
    done = run(environment, "none", "--fast")
    assert done.returncode == 0, done.stderr
    assert "sphinx" not in done.stdout
    assert "not slow and not browser and not gpu" in done.stdout
