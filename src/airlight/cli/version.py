"""What ``airlight --version`` prints."""

from __future__ import annotations

import subprocess
from pathlib import Path

__all__ = ["version_line"]

#: Written into distributions by ``builders/distribution_contents.py``.
COMMIT_FILE = Path(__file__).parent.parent / "commit.txt"


def version_line() -> str:
    """Version, with the commit that the code was built from, or that is checked out, if known."""
    from airlight import __version__

    commit = _commit()
    return f"airlight {__version__}" + (f" ({commit})" if commit else "")


def _commit() -> str:
    if COMMIT_FILE.is_file():
        return COMMIT_FILE.read_text(encoding="utf-8").strip()
    checkout = COMMIT_FILE.parents[2]
    if not (checkout / ".git").exists():
        return ""
    try:
        command = ["git", "-C", str(checkout), "describe", "--always", "--abbrev=12", "--exclude=*"]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""
