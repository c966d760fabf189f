"""Random mouse, keys or fingers on a page, whose picture is compared with the CPU's.

The page is that of a planet, opened from disk in a headless Chromium. After some gestures it rests,
and what is open is closed by keys; then it shows the picture of the link that it exports.
"""

from __future__ import annotations

import base64
import io
import os
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from PIL import Image
from shown_state import expected, fault_of, save
from tally import Tally

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "web"))

from chromium_flags import FLAGS
from gestures import Gestures, close_all

from airlight.viewer.browser.page import export_page

#: Planet without a map of the ground, which a page has coarser.
PLANET = "earth-bruneton"
#: Number of gestures between two comparisons, and the longest time to rest. [ms]
TOGETHER, FINISH = 25, 600_000
#: Viewports of a desktop and of a phone. [pixel]
WIDE, PHONE = {"width": 720, "height": 405}, {"width": 390, "height": 844}
#: What is shown at rest: link, size, exposure and complaint.
_STATE = """async () => {
  await airlight.settled();
  const { state, picture, parts } = airlight;
  const { width, height } = parts.canvas;
  const view = Object.entries(state.values).filter(([path]) => /^(view|display)\\./.test(path));
  return {
    link: state.asFragment(),
    size: [width, height],
    exposure: picture.exposure,
    held: state.holdsExposure,
    view: Object.fromEntries(view),
    error: parts.message.textContent,
    working: parts.working.textContent,
  };
}"""
_PICTURE = """async ([width, height]) => {
  const bytes = new Uint8Array(await (await airlight.png(width, height)).arrayBuffer());
  return btoa(Array.from(bytes, (one) => String.fromCharCode(one)).join(""));
}"""


class PageEvents:
    """Gestures of a seed on a page, by mouse and keys or by fingers."""

    def __init__(self, page: Any, seed: int, *, touch: bool) -> None:
        self.page, self.touch = page, touch
        self.gestures = Gestures(page, seed)
        self.chance = self.gestures.chance

    def act(self) -> float:
        """Perform a gesture; time until the page answers. [s]"""
        (self.gestures.by_fingers if self.touch else self.gestures.by_mouse)(1)
        begun = time.monotonic()
        self.page.evaluate("new Promise((done) => requestAnimationFrame(done))")
        return time.monotonic() - begun

    def compare(self, pictures: Path | None) -> tuple[str, str]:
        """Let the page rest; class of what is wrong with its picture, and figures."""
        close_all(self.page)
        begun = time.monotonic()
        state = self.page.evaluate(_STATE)
        seconds = time.monotonic() - begun
        if state["error"]:
            return "refused", state["error"]
        box = self.page.locator("canvas").first.bounding_box()
        size = tuple(state["size"])
        data = base64.b64decode(self.page.evaluate(_PICTURE, state["size"]))
        shown = np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), float)
        link = f"#{unquote(state['link'])}" if state["link"] else self.first_link(state["view"])
        try:
            wanted = expected(link, size, False, tuple(sorted(state["view"].items())))
        except Exception as error:
            return "link", f"{type(error).__name__}: {error}; {link}"
        picture = wanted.picture(state["exposure"])
        fault, figures = fault_of(shown, picture)
        off = abs(state["exposure"] - wanted.exposure)
        if not fault and wanted.session.view["display.automatic"] and not state["held"]:
            fault = "exposure" if off > 0.2 else ""
        if pictures is not None and (fault or shown.max() < 5.0 or shown.min() > 250.0):
            save(pictures, shown, picture)
        figures = f"rest {seconds:.1f} s, {figures}, exposure off {off:.2f}"
        return fault, f"{figures}; {box} {state['exposure']} EV {link[:500]}" if fault else figures

    @staticmethod
    def first_link(view: dict[str, Any]) -> str:
        """Link of a page that nothing was changed on."""
        from airlight.viewer.session.saved_state import to_fragment

        return f"#{to_fragment({'planet': PLANET, 'view': view})}"


def memory(root: int) -> float:
    """Resident memory of a process and all its descendants, shared pages counted in parts. [MB]"""
    parents: dict[int, list[int]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            after = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents.setdefault(int(after[1]), []).append(int(stat.parent.name))
    whole, todo = 0.0, [root]
    while todo:
        one = todo.pop()
        todo += parents.get(one, [])
        try:
            text = Path(f"/proc/{one}/smaps_rollup").read_text()
        except OSError:
            continue
        whole += float(text.split("Pss:")[1].split()[0]) / 1024.0
    return whole


def page_soak(
    seconds: float,
    seed: int,
    folder: Path,
    log: Callable[[str], None] = lambda _: None,
    pictures: Path | None = None,
) -> Tally:
    """Use a page at random for a time, two thirds of it by mouse and keys, then by fingers.

    Parameters
    ----------
    seconds, seed, folder, log, pictures :
        See ``window_events.window_soak``.
    """
    from playwright.sync_api import sync_playwright

    tally = Tally("random gestures on a page, with its picture compared with the CPU's")
    file = folder / "page.html"
    export_page(PLANET, file, quality="preview")
    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    count, sizes = 0, [0.0]
    with sync_playwright() as play:
        for touch, share in ((False, 2.0 / 3.0), (True, 1.0 / 3.0)):
            begun = time.monotonic()
            browser = play.chromium.launch(executable_path=program, args=list(FLAGS))
            view = {"viewport": PHONE if touch else WIDE, "has_touch": touch}
            context = browser.new_context(**view, device_scale_factor=1)
            context.set_offline(True)
            page, said = context.new_page(), []
            page.set_default_timeout(FINISH)
            page.on("pageerror", lambda error, said=said: said.append(str(error)))
            page.on(
                "console",
                lambda m, said=said: said.append(m.text) if m.type == "error" else None,
            )
            page.goto(f"{file.as_uri()}?device=webgl2")
            page.evaluate("airlight.ready")
            events, name = PageEvents(page, seed, touch=touch), "touch" if touch else "mouse"
            try:
                while time.monotonic() - begun < share * seconds:
                    for _ in range(TOGETHER):
                        count += 1
                        log(f"event {count} by {name}: {events.act():.2f} s")
                        page.wait_for_timeout(events.chance.choice((100, 300, 500, 1000)))
                    kept = None if pictures is None else pictures / f"page-{seed}-{count}.png"
                    fault, figures = events.compare(kept)
                    sizes.append(memory(os.getpid()) - memory_of_self())
                    log(f"{'FAULT ' + fault if fault else 'held'} after {count}: {figures}, "
                        f"browser {sizes[-1]:.0f} MB")  # fmt: skip
                    right = fault in ("", "refused")
                    tally.add(fault or "held", "" if right else f"{fault}: {figures}")
                    for line in said:
                        tally.add("", f"console: {line[:400]}")
                        log(f"FAULT console {line[:400]}")
                    said.clear()
            except Exception as error:
                tally.add("", f"ended: {type(error).__name__}: {ascii(str(error))[:600]}")
                log(f"FAULT ended {type(error).__name__}: {ascii(str(error))[:2000]}")
            browser.close()
    tally.note = f"{count} gestures, browser at most {max(sizes):.0f} MB"
    return tally


def memory_of_self() -> float:
    """Resident memory of this process alone. [MB]"""
    text = Path("/proc/self/smaps_rollup").read_text()
    return float(text.split("Pss:")[1].split()[0]) / 1024.0
