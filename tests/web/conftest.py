"""Headless Chromium with WebGPU and WebGL2 in software; tests are skipped without it."""

from __future__ import annotations

import functools
import http.server
import os
import shutil
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any, NoReturn

import pytest
from chromium_flags import FLAGS

#: Time limit of a page on two busy cores. [ms]
PATIENCE = 300_000


def missing(reason: str) -> None:
    """Skip, or fail where a skip would hide an error."""
    if os.environ.get("AIRLIGHT_REQUIRE_GPU") or os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """Running browser."""
    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    if program is None:
        missing("no chromium (on Debian: apt-get install chromium libegl1 libgl1-mesa-dri)")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("no playwright (pip install playwright)")
    with sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=program, headless=True, args=list(FLAGS), timeout=PATIENCE
        )
        yield browser
        browser.close()


@contextmanager
def offline_pages(
    chromium: Any, width: int = 960, height: int = 540
) -> Iterator[Callable[..., Any]]:
    """Open files from disk in offline pages; fails at the end on any error in a page."""
    context = chromium.new_context(viewport={"width": width, "height": height})
    context.set_offline(True)
    faults: list[str] = []

    def open_file(file: Path, fragment: str = "") -> Any:
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
        page.on("requestfailed", lambda request: faults.append(f"asked for {request.url[:80]}"))
        page.goto(file.as_uri() + fragment)
        return page

    yield open_file
    context.close()
    assert faults == []


@pytest.fixture
def opened(chromium: Any) -> Iterator[Callable[..., Any]]:
    """Open a file from disk in an offline page."""
    with offline_pages(chromium) as open_file:
        yield open_file


@pytest.fixture
def opened_small(chromium: Any) -> Iterator[Callable[..., Any]]:
    """As ``opened``, for pages that are drawn often: half as many pixels, beside the panel."""
    with offline_pages(chromium, 720, 405) as open_file:
        yield open_file


@pytest.fixture(scope="module")
def kept_open(chromium: Any) -> Iterator[Callable[..., Any]]:
    """As ``opened``, in small, for pages whose shaders several tests of a file need compiled."""
    with offline_pages(chromium, 480, 270) as open_file:
        yield open_file


@pytest.fixture(scope="module")
def kept_wide(chromium: Any) -> Iterator[Callable[..., Any]]:
    """As ``opened``, for a page that all tests of a file use in turn."""
    with offline_pages(chromium) as open_file:
        yield open_file


class _Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *arguments: Any) -> None:
        pass


@pytest.fixture(scope="session")
def served_pages(chromium: Any) -> Callable[[Path], AbstractContextManager[Callable[[str], Any]]]:
    """Pages of a folder by HTTP: ``with served_pages(folder) as open_page: open_page(name)``.

    Fails at the end on any error in a page.
    """

    @contextmanager
    def serve(folder: Path) -> Iterator[Callable[[str], Any]]:
        handler = functools.partial(_Quiet, directory=str(folder))
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        context = chromium.new_context(viewport={"width": 320, "height": 180})
        context.set_default_timeout(PATIENCE)
        faults: list[str] = []

        def open_page(name: str) -> Any:
            page = context.new_page()
            page.on("pageerror", lambda error: faults.append(str(error)))
            page.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
            page.goto(f"http://127.0.0.1:{server.server_port}/{name}")
            return page

        yield open_page
        context.close()
        server.shutdown()
        server.server_close()
        assert faults == []

    return serve


@pytest.fixture(scope="session")
def npm_install(lacking: Callable[[str], NoReturn]) -> Callable[[Path], None]:
    """``npm_install(folder)``: what its package.json asks for, without optional peers."""
    if shutil.which("npm") is None:
        lacking("no npm (on Debian: apt-get install npm)")

    def install(folder: Path) -> None:
        asked = ["npm", "install", "--silent", "--no-audit", "--no-fund", "--legacy-peer-deps"]
        subprocess.run(asked, cwd=folder, check=True, timeout=300)

    return install


@pytest.fixture
def modules(opened: Callable[..., Any], tmp_path: Path) -> Callable[..., Any]:
    """Open an empty page in which exports of the viewer's web folder are global objects.

    Called with the names to import from each file: ``modules({"state/state": ("State",)})``.
    """
    from airlight.viewer.browser.modules import join_modules, web_file

    def open_modules(names: dict[str, tuple[str, ...]]) -> Any:
        lines = [f'import {{ {", ".join(n)} }} from "./{f}.js";' for f, n in names.items()]
        lines.append(f"Object.assign(window, {{ {', '.join(sum(names.values(), ()))} }});")
        text = "\n".join(lines)
        joined = join_modules("test.js", lambda f: text if f == "test.js" else web_file(f))
        file = tmp_path / "modules.html"
        file.write_text(
            '<!doctype html><meta charset="utf-8"><body><script type="module">\n'
            f"{joined}\n</script>",
            encoding="utf-8",
        )
        return opened(file)

    return open_modules


@pytest.fixture(scope="session")
def gpu() -> Any:
    """Software device without a browser."""
    from airlight.render.gpu.device.device import NoDevice, open_device

    try:
        return open_device()
    except NoDevice as reason:
        missing(str(reason))
