"""``scripts/test`` fails when any of its checks does, and says which."""

from __future__ import annotations

import hashlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "scripts" / "test"
#: Programs of the checks; ``python`` runs pytest, and the site's builder.
PROGRAMS = ("ruff", "mypy", "lint-imports", "airlight", "python")

#: Limit of any wait here, generous for a busy machine. [s]
LONG = 300.0

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
            f'case "{name} $*" in $LASTING) echo $$ >>"$0.pid"; exec sleep 3600;; esac\n'
        )  # fmt: skip
        (programs / name).chmod(0o755)
    # what the script writes after an installation: it installs nothing now
    said = subprocess.run([sys.executable, "-VV"], capture_output=True, text=True, check=True)
    text = f"{said.stdout}{ROOT}\n{(ROOT / 'pyproject.toml').read_text()}"
    (venv / "airlight-installed").write_text(hashlib.sha256(text.encode()).hexdigest())
    (tmp_path / "apt-get").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "apt-get").chmod(0o755)
    return venv


def variables(environment: Path, failing: str = "none", lasting: str = "none") -> dict[str, str]:
    """Environment of the script; patterns of what programs that fail or last are called with."""
    return {
        **os.environ,
        "AIRLIGHT_VENV": str(environment),
        "PYTHON": sys.executable,
        "FAILING": failing,
        "LASTING": lasting,
        "PATH": f"{environment.parent}:{os.environ['PATH']}",
    }


def run(environment: Path, failing: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the script; ``failing`` is a pattern of what a failing program is called with."""
    return subprocess.run(
        ["bash", str(SCRIPT), *arguments], env=variables(environment, failing), cwd="/",
        capture_output=True, text=True, timeout=600, check=False,
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
        ("lint-imports *", (), "lint-imports (the layers)"),
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
    assert done.stderr.splitlines()[-1] == "scripts/test: failed: lint-imports (the layers)"
    assert "No such file" in done.stdout


def test_the_fast_part_builds_no_site(environment: Path) -> None:
    done = run(environment, "none", "--fast")
    assert done.returncode == 0, done.stderr
    assert "sphinx" not in done.stdout
    assert "not slow and not browser and not gpu" in done.stdout


def test_files_that_the_fast_part_leaves_out_exist_and_each_folder_keeps_others() -> None:
    left_out = (ROOT / "tests" / "slow_files.txt").read_text("utf-8").split()
    assert left_out == sorted(set(left_out))
    files = {path.relative_to(ROOT / "tests") for path in (ROOT / "tests").rglob("test_*.py")}
    assert {Path(name) for name in left_out} <= files
    kept = files - {Path(name) for name in left_out}
    assert {path.parts[0] for path in files if len(path.parts) > 1} == {
        path.parts[0] for path in kept if len(path.parts) > 1
    }


def test_what_touches_a_module_is_its_doctests_and_the_tests_that_import_it(
    environment: Path,
) -> None:
    done = run(environment, "none", "--touching", "src/airlight/physics/optics/air_mass.py")
    assert done.returncode == 0, done.stderr
    (line,) = [one for one in done.stdout.splitlines() if one.startswith("ran python -m pytest")]
    named = [word for word in line.split() if word.endswith(".py")]
    assert named[0] == "src/airlight/physics/optics/air_mass.py"
    importing = [
        str(path.relative_to(ROOT))
        for path in sorted((ROOT / "tests").rglob("*.py"))
        if "from airlight.physics.optics.air_mass import" in path.read_text("utf-8")
    ]
    assert named[1:] == importing
    assert run(environment, "none", "--touching", "README.md").returncode != 0


def test_an_interrupt_ends_the_checks_beside_too(environment: Path) -> None:
    # Ctrl-C goes to the script and to pytest; mypy and the site's builder are not the terminal's
    lasting = variables(environment, lasting="[pm]y*")
    with subprocess.Popen(
        ["bash", str(SCRIPT)], env=lasting, cwd="/", stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as script:  # fmt: skip
        notes = [environment / "bin" / f"{name}.pid" for name in ("mypy", "python")]
        wait(lambda: all(note.is_file() and note.read_text().strip() for note in notes))
        os.killpg(script.pid, signal.SIGINT)
        assert script.wait(LONG) == 130
    for note in notes:
        wait(lambda note=note: not alive(int(note.read_text())))


def wait(condition: Callable[[], bool]) -> None:
    until = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.05)


def alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True
