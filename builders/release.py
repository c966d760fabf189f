"""A release: distributions built and tried in empty environments, the site, notes and the tag.

    pip install '.[release]'
    python builders/release.py 0.1.0 --home https://example.org/airlight
    python builders/release.py 0.1.0 --only wheel

The first, from a clean checkout whose ``pyproject.toml``, ``CITATION.cff`` and ``CHANGELOG.md``
state the version and whose checks pass, fills ``dist`` and sets the tag; ``--no-tag`` leaves that
out. ``--home`` is the address of the repository, for the page of the package index and its links.
The second builds and tries the wheel of this system, as each machine of
``.github/workflows/release.yml`` does.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import tomllib
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parent.parent
#: Largest wheel, and what is in it but compiled code. [MB]
WHEEL, INSTALLED = 15.0, 30.0
#: Largest time of the first picture after the wheel was installed, on two idle cores. [s]
FIRST_PICTURE = 10.0


@contextmanager
def step(name: str) -> Iterator[None]:
    """Name of a step, then the time that it took."""
    print(f"== {name}", flush=True)
    began = time.monotonic()
    yield
    print(f"   {time.monotonic() - began:.1f} s", flush=True)


def run(*command: str | Path, **keywords: object) -> None:
    """Run a command, which must succeed; ``env`` is added to the environment."""
    own = {"env": {**os.environ, **keywords.pop("env", {})}}  # type: ignore[dict-item]
    subprocess.run([str(word) for word in command], check=True, **own, **keywords)  # type: ignore[call-overload]


def require(holds: bool, otherwise: str) -> None:
    if not holds:
        sys.exit(f"release: {otherwise}")


def stated(version: str) -> str:
    """Section of the changelog; the tree must be clean and state the version everywhere."""
    dirty = subprocess.check_output(["git", "status", "--porcelain"], cwd=ROOT, text=True)
    require(not dirty, "the checkout has changes; commit them")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    require(
        project["version"] == version,
        f"version is {project['version']} in pyproject.toml; allowed: {version}",
    )
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    require(f"\nversion: {version}\n" in citation, f"CITATION.cff lacks 'version: {version}'")
    final = re.fullmatch(r"[\d.]+", version) is not None
    require(not final or "\ndate-released:" in citation, "CITATION.cff lacks 'date-released'")
    heading = re.escape(re.sub(r"\.?(dev|a|b|rc)\d+$", "", version))
    day = r"\d{4}-\d\d-\d\d" if final else ".*"
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    found = re.search(rf"^## \[{heading}\] - {day}\n(.*?)(?=^## |\Z)", changes, re.M | re.S)
    if found is None:
        sys.exit(f"release: CHANGELOG.md lacks '## [{version}] - YYYY-MM-DD'")
    return found[1].strip()


def with_addresses(text: str, home: str, version: str) -> str:
    """Markdown of the README whose links lead to the repository at the tag of the version."""

    def absolute(link: re.Match[str]) -> str:
        kind = "raw" if link[1] == "!" else "blob"
        return f"{link[1]}[{link[2]}]({home}/{kind}/v{version}/{link[3]})"

    return re.sub(r"(!?)\[([^\]]*)\]\((?!https?://|#)([^)]+)\)", absolute, text)


def exported(folder: Path, home: str | None, version: str) -> Path:
    """A clone of the checkout's commit, with the addresses of ``home`` if there is one."""
    run("git", "clone", "--quiet", ROOT, folder)
    if home is None:
        return folder
    home = home.rstrip("/")
    urls = {
        "Homepage": home,
        "Source": home,
        "Issues": f"{home}/issues",
        "Changelog": f"{home}/blob/v{version}/CHANGELOG.md",
    }
    lines = "".join(f'{name} = "{url}"\n' for name, url in urls.items())
    project = folder / "pyproject.toml"
    project.write_text(project.read_text("utf-8") + f"\n[project.urls]\n{lines}", encoding="utf-8")
    readme = folder / "README.md"
    readme.write_text(with_addresses(readme.read_text("utf-8"), home, version), encoding="utf-8")
    return folder


def built(source: Path, place: Path, *, only_wheel: bool) -> Path:
    """The wheel with compiled code; beside it in ``place`` the source distribution."""
    shutil.rmtree(place, ignore_errors=True)
    with step("compiled code"):
        own = {"PYTHONPATH": str(source / "src")}  # absolute: it compiles in another folder
        run(sys.executable, "builders/compiled_code.py", cwd=source, env=own)
    with step("build"):
        kinds = ["--wheel"] if only_wheel else ["--wheel", "--sdist"]
        run(sys.executable, "-m", "build", *kinds, "-o", place, cwd=source)
        run(sys.executable, "-m", "twine", "check", "--strict", *place.iterdir())
    (wheel,) = place.glob("*.whl")
    with step("contents"), zipfile.ZipFile(wheel) as archive:
        sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
        unpacked = sum(n for name, n in sizes.items() if "/compiled/" not in name) / 1e6
        size = wheel.stat().st_size / 1e6
        print(f"   {wheel.name}: {size:.1f} MB, {len(sizes)} files, {unpacked:.1f} MB but code")
        require(size <= WHEEL, f"the wheel has {size:.1f} MB; allowed: {WHEEL}")
        require(unpacked <= INSTALLED, f"the package has {unpacked:.1f} MB; allowed: {INSTALLED}")
        for name in ("py.typed", "commit.txt", "planets/presets/earth.toml"):
            require(f"airlight/{name}" in sizes, f"the wheel lacks airlight/{name}")
    for file in place.glob("*.tar.gz"):
        with tarfile.open(file) as archive:
            names = {name.partition("/")[2] for name in archive.getnames()}
        for name in ("src/airlight/commit.txt", "LICENSE", "CITATION.cff"):
            require(name in names, f"the source distribution lacks {name}")
    return wheel


def tried(source: Path, wheel: Path, *, lowest: bool) -> None:
    """The README's first command and its Python, in an empty environment with empty caches."""
    readme = (source / "README.md").read_text("utf-8")
    picture = re.search(r"airlight (render earth .*?-o earth\.png)", readme, re.S)
    python = re.search(r"```python\n(import airlight\n.*?)```", readme, re.S)
    require(picture is not None and python is not None, "README.md lacks its command or its Python")
    assert picture is not None
    assert python is not None
    words = shlex.split(picture[1].replace("\\\n", " "))
    uv: list[str | Path] = [sys.executable, "-m", "uv", "--quiet"]
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        env = {
            "AIRLIGHT_CACHE": str(place / "cache"),
            "PYTHONPATH": "",
        }  # the wheel, not a checkout
        run(*uv, "venv", place / "venv", "--python", sys.executable)
        bin = place / "venv" / ("Scripts" if os.name == "nt" else "bin")
        install = [*uv, "pip", "install", "--python", bin / "python", wheel]
        if lowest:
            bounds = [str(source / "pyproject.toml"), "--output-file", str(place / "lowest.txt")]
            resolve = [*uv, "pip", "compile", *bounds, "--resolution", "lowest-direct"]
            run(*resolve, stdout=subprocess.DEVNULL)
            install += ["-r", place / "lowest.txt"]
        with step("install, with the lowest dependencies" if lowest else "install"):
            run(*install)
            files = [file.stat().st_size for file in (place / "venv").rglob("*") if file.is_file()]
            print(f"   {sum(files) / 1e6:.0f} MB")
        run(bin / "airlight", "--version", env=env)
        for which in ("first picture", "again"):
            began = time.monotonic()
            with step(which):
                run(bin / "airlight", *words, cwd=place, env=env)
            late = time.monotonic() - began > FIRST_PICTURE and not lowest
            if late:
                print(f"   missed: {FIRST_PICTURE:.0f} s on two idle cores")
        with step("ten lines of Python"):
            run(
                bin / "python",
                "-W",
                "ignore::DeprecationWarning",
                "-c",
                python[1],
                cwd=place,
                env=env,
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("version")
    parser.add_argument("--home", metavar="URL", help="of the repository")
    parser.add_argument("--only", choices=["wheel"], help="build and try the wheel of this system")
    parser.add_argument("--tested", action="store_true", help="scripts/test passed, both parts")
    parser.add_argument("--no-tag", action="store_true")
    chosen = parser.parse_args()
    notes = stated(chosen.version)
    place = ROOT / "dist"
    with tempfile.TemporaryDirectory() as folder:
        source = exported(Path(folder) / "airlight", chosen.home, chosen.version)
        if not chosen.only and not chosen.tested:
            with step("every check"):
                run("scripts/test", cwd=source)
                run("scripts/test", "--validation", cwd=source)
        wheel = built(source, place, only_wheel=chosen.only == "wheel")
        tried(source, wheel, lowest=False)
        if chosen.only:
            return
        tried(source, wheel, lowest=True)
        with step("site"):
            run("scripts/docs", cwd=source, env={"AIRLIGHT_VENV": sys.prefix})
            shutil.make_archive(str(place / "site"), "zip", source / "build" / "docs" / "html")
        with step("contact sheets"):
            sheets = Path(folder) / "sheets"
            sheet = [sys.executable, "builders/review_sheets.py", str(sheets), "--size", "640x360"]
            run(*sheet, cwd=source, env={"PYTHONPATH": "src"})
            shutil.make_archive(str(place / "sheets"), "zip", sheets)
    (place / "notes.md").write_text(notes + "\n", encoding="utf-8")
    if not chosen.no_tag:
        tag = f"v{chosen.version}"
        run(
            "git",
            "tag",
            "--annotate",
            tag,
            "--file",
            place / "notes.md",
            "--cleanup=whitespace",
            cwd=ROOT,
        )
        print(f"tagged {tag}; git push origin {tag} && twine upload dist/*.whl dist/*.tar.gz")


if __name__ == "__main__":
    main()
