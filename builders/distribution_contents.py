"""Hook of the builds: the commit in a distribution, and compiled code in a wheel for one system."""

from __future__ import annotations

import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

CODE = "src/airlight/compiled"


class CustomBuildHook(BuildHookInterface):
    """Take in the commit, where git knows it, and what ``builders/compiled_code.py`` has made."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            return
        describe = ["git", "-C", self.root, "describe", "--always", "--abbrev=12", "--exclude=*"]
        if (Path(self.root) / ".git").exists():  # an unpacked source distribution has the file
            commit = subprocess.run(describe, capture_output=True, text=True, check=True).stdout
            self.folder = tempfile.TemporaryDirectory()
            file = Path(self.folder.name) / "commit.txt"
            file.write_text(commit, encoding="utf-8")
            inside = "src/airlight" if self.target_name == "sdist" else "airlight"
            build_data["force_include"][str(file)] = f"{inside}/commit.txt"
        if self.target_name == "wheel" and Path(self.root, CODE).is_dir():
            build_data["artifacts"].append(f"/{CODE}/**")
            build_data["pure_python"] = False
            if sys.platform == "linux":  # LLVM's code needs the C library's mathematics alone
                python = f"cp{sys.version_info.major}{sys.version_info.minor}"
                build_data["tag"] = f"{python}-{python}-manylinux_2_17_{platform.machine()}"
            else:
                build_data["infer_tag"] = True
