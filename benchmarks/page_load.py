"""Time until an exported page shows something, is read, and has drawn its first picture.

    python benchmarks/page_load.py earth.html              # on WebGPU and WebGL2, five times each
    python benchmarks/page_load.py old.html new.html       # several pages in turns

Headless Chromium, a fresh profile each time, no network. ``shown`` is the browser's first paint of
anything, ``read`` its DOMContentLoaded, ``picture`` when the status line of the page first names a
picture, all since the page was asked for; ``status`` is that line of the last run. Medians.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from pathlib import Path
from statistics import median
from typing import Any

#: WebGPU by SwiftShader and WebGL2 by Mesa where there is no GPU, as in tests/web.
FLAGS = (
    "--no-sandbox",
    "--enable-unsafe-webgpu",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu-watchdog",
)
DEVICES = ("webgpu", "webgl2")
#: Limit of one load. [ms]
PATIENCE = 600_000
#: Notes when the status line first names a picture, whatever the page's own scripts do.
WATCH = """
window.pictureAt = 0;
const look = () => {
  const line = document.querySelector(".airlight-status");
  if (line && line.textContent.includes(" ms")) window.pictureAt = performance.now();
  else requestAnimationFrame(look);
};
requestAnimationFrame(look);
"""
READ = """() => ({
  shown: performance.getEntriesByName("first-paint")[0]?.startTime ?? NaN,
  read: performance.getEntriesByType("navigation")[0].domContentLoadedEventEnd,
  picture: window.pictureAt,
  status: document.querySelector(".airlight-status").textContent,
})"""


def load(browser: Any, page_file: Path, device: str) -> dict[str, Any]:
    """Times of one load. [ms]"""
    context = browser.new_context(viewport={"width": 960, "height": 540})
    context.set_offline(True)
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.add_init_script(WATCH)
    page.goto(f"{page_file.resolve().as_uri()}?device={device}")
    while not page.evaluate("window.pictureAt"):
        page.wait_for_timeout(50)
    times: dict[str, Any] = page.evaluate(READ)
    context.close()
    if not times["status"].endswith(device):
        raise SystemExit(f"{page_file} drew with {times['status']}, not with {device}")
    return times


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="+", type=Path, metavar="PAGE.html")
    parser.add_argument("--runs", type=int, default=5, help="loads of each page and device")
    asked = parser.parse_args()
    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    if program is None:
        sys.exit("no chromium (on Debian: apt-get install chromium)")
    from playwright.sync_api import sync_playwright

    print("| page | device | shown | read | picture | status |\n|---|---|---|---|---|---|")
    with sync_playwright() as play:
        for device in DEVICES:
            runs: dict[Path, list[dict[str, Any]]] = {page: [] for page in asked.pages}
            for _ in range(asked.runs):
                for page in asked.pages:
                    # a browser of its own each time: shaders that one has compiled are kept
                    browser = play.chromium.launch(
                        executable_path=program, headless=True, args=list(FLAGS), timeout=PATIENCE
                    )
                    runs[page].append(load(browser, page, device))
                    browser.close()
            for page, times in runs.items():
                shown, read, picture = (
                    median(one[name] for one in times) / 1e3
                    for name in ("shown", "read", "picture")
                )
                print(f"| {page.name} | {device} | {shown:.2f} s | {read:.2f} s | {picture:.2f} s "
                      f"| {times[-1]['status']} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
