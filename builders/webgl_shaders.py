"""Remake the GLSL ES 3.00 of all shaders from their WGSL, by the npm package naga-wasm.

Run with ``python builders/webgl_shaders.py`` where node and npm are installed, after any change of
a shader or of a formula that it contains; ``--node-modules DIR`` names a folder in which the
package is already.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from airlight.gpu.emit.translated import entry_points, file_name, with_head
from airlight.gpu.picture.uniforms import struct_text
from airlight.viewer.browser.web_shaders import solver_texts, web_texts
from private_rooms import with_private_rooms

#: Variables of the module: naga sets them to zero first, at which compilers work longest.
_ZEROED = re.compile(r"^((?:float|vec4) \w+\[\d+\]) = \w+\[\d+\]\(.*\);$", re.MULTILINE)
#: Later versions may write other text, and need a newer Node.
TRANSLATOR = "naga-wasm@30.1.0"
ROOT = Path(__file__).parents[1]


def sources() -> list[tuple[Path, str, str, list[tuple[str, str]]]]:
    """Folder of the result, name of the module, its WGSL, its entry points with their stages."""
    folder, package = ROOT / "tests" / "web" / "shaders", ROOT / "src" / "airlight" / "gpu" / "glsl"
    texts = {file.stem: file.read_text(encoding="utf-8") for file in sorted(folder.glob("*.wgsl"))}
    tests = {name: text.replace("//UNIFORMS\n", struct_text()) for name, text in texts.items()}
    ours = {**web_texts(), **solver_texts()}
    return [
        *((folder, name, text, entry_points(text)) for name, text in tests.items()),
        *((package, name, text, entry_points(text)) for name, text in ours.items()),
    ]


def translate(jobs: list[dict[str, Any]], node_modules: Path | None) -> list[dict[str, str]]:
    """Run the translator; stops with its report if a shader cannot be translated."""
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch) if node_modules is None else node_modules.parent
        if node_modules is None:
            (place / "package.json").write_text("{}", encoding="utf-8")
            install = ["npm", "install", "--silent", "--no-audit", "--no-fund", TRANSLATOR]
            subprocess.run(install, cwd=place, check=True)
        script = Path(__file__).with_suffix(".mjs")
        done = subprocess.run(
            ["node", str(script)],
            cwd=place,
            input=json.dumps(jobs),
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
    made: list[dict[str, str]] = json.loads(done.stdout)
    return made


def main() -> None:
    """Write one file for each entry point, and remove those of shaders that are gone."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--node-modules", type=Path, default=None)
    chosen = parser.parse_args()
    shaders = sources()
    jobs = [
        {"module": name, "wgsl": with_private_rooms(wgsl), "entries": entries}
        for _, name, wgsl, entries in shaders
    ]
    texts = {module: (folder, wgsl) for folder, module, wgsl, _ in shaders}
    kept = set()
    for one in translate(jobs, chosen.node_modules):
        folder, wgsl = texts[one["module"]]
        text = with_head(one["module"], wgsl, _ZEROED.sub(r"\1;", one["glsl"]), TRANSLATOR)
        file = folder / file_name(one["module"], one["entry"])
        file.write_text(text, encoding="utf-8")
        kept.add(file)
        print(f"{file.relative_to(ROOT)}: {len(text) / 1e3:.0f} kB")
    for folder in {folder for folder, *_ in shaders}:
        for file in set(folder.glob("*.glsl")) - kept:
            file.unlink()
            print(f"{file.relative_to(ROOT)}: removed")


if __name__ == "__main__":
    main()
