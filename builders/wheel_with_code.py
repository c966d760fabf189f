"""Hook of the wheel's build: a wheel with compiled code is for one system and version of Python."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

CODE = "src/airlight/compiled"


class CustomBuildHook(BuildHookInterface):
    """Take in what ``builders/compiled_code.py`` has made, if it is there."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable" or not Path(self.root, CODE).is_dir():
            return
        build_data["artifacts"].append(f"/{CODE}/**")
        build_data["pure_python"] = False
        build_data["infer_tag"] = True
