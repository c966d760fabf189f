"""Key and mouse bindings, shared by window, page and notebook.

Each row is a line of the help with its bindings and the hosts that offer it: a browser reserves
Ctrl with a letter, writes no planet files and has one view; a window has no touch screen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

from airlight.scene.flight import CLIMB, FOOTING, NOTCH, RATE
from airlight.viewer.navigation.viewpoints import VIEWPOINTS
from airlight.viewer.session.adaptation import TIME_CONSTANT
from airlight.viewer.session.history import MOST_STEPS, TOGETHER

Host = Literal["window", "page"]

#: Hosts of a row that applies to every host.
_ALL: Final[tuple[Host, ...]] = ("window", "page")

#: Speeds, factors and limits of the controls.
RATES: Final[Mapping[str, float]] = {
    "fly": RATE,  # distances to the ground per second [1/s]
    "footing": FOOTING,  # added to that distance [m]
    "turn": 0.5,  # fields of view per second by which keys turn the camera [1/s]
    "widen": 1.0,  # logarithm of the field of view's growth, by keys [1/s]
    "climb": CLIMB,  # growth of the distance to the ground per notch of the wheel [1]
    "notch": NOTCH,  # growth of the field of view per notch of the wheel [1]
    "wheel": 100.0,  # a browser's wheel delta for one notch [pixel]
    "stop": 1.0 / 3.0,  # exposure [EV]
    "adapted": TIME_CONSTANT,  # of the automatic exposure [s]
    "time": 1800.0,  # initial rate of the sun's time relative to real time [1]
    "longest_step": 0.1,  # limits the distance flown after a pause [s]
    "click": 3.0,  # a press with a smaller movement is a click [logical pixel]
    "steps": MOST_STEPS,  # number of undo steps
    "together": TOGETHER,  # longest time between edits that are one undo step [s]
}


@dataclass(frozen=True, kw_only=True)
class Row:
    """Line of the help and its bindings.

    Attributes
    ----------
    group : str
        Heading of the row in the help.
    keys, text : str
        Keys or gestures, and their effect, as the help shows them.
    held : mapping from str to (str, float)
        Movement while a key is down: axis and sign, by the key's name in lower case.
    factors : mapping from str to float
        Speed factors of keys while they are down. [1]
    once : mapping from str to str
        Commands by key, its name prefixed with ``Control+`` and ``Shift+``.
    hosts : tuple of str
        Hosts that offer the row.
    """

    group: str
    keys: str
    text: str
    held: Mapping[str, tuple[str, float]] = field(default_factory=dict)
    factors: Mapping[str, float] = field(default_factory=dict)
    once: Mapping[str, str] = field(default_factory=dict)
    hosts: tuple[Host, ...] = _ALL


_WINDOW: Final[tuple[Host, ...]] = ("window",)
_PAGE: Final[tuple[Host, ...]] = ("page",)

_FLY: Final = (
    Row(group="Fly", keys="drag", text="look around"),
    Row(group="Fly", keys="W S, ↑ ↓", text="ahead, back",
        held={"w": ("ahead", 1.0), "s": ("ahead", -1.0),
              "arrowup": ("ahead", 1.0), "arrowdown": ("ahead", -1.0)}),
    Row(group="Fly", keys="A D, ← →", text="left, right",
        held={"a": ("right", -1.0), "d": ("right", 1.0),
              "arrowleft": ("right", -1.0), "arrowright": ("right", 1.0)}),
    Row(group="Fly", keys="E Q, Page ↑ ↓", text="up, down",
        held={"e": ("up", 1.0), "q": ("up", -1.0),
              "pageup": ("up", 1.0), "pagedown": ("up", -1.0)}),
    Row(group="Fly", keys="wheel", text="towards the ground, or away", hosts=_WINDOW),
    Row(group="Fly", keys="wheel, pinch", text="towards the ground, or away", hosts=_PAGE),
    Row(group="Fly", keys="Shift, Alt", text="four times as fast, as slow, the wheel too",
        factors={"shift": 4.0, "alt": 0.25}),
    Row(group="Fly", keys="Ctrl", text="as Alt, once a key is down",
        factors={"control": 0.25}, hosts=_WINDOW),
    Row(group="Fly", keys="I K, J L", text="look up, down, left, right",
        held={"i": ("tilt", -1.0), "k": ("tilt", 1.0), "j": ("turn", -1.0), "l": ("turn", 1.0)}),
    Row(group="Fly", keys="N M, Ctrl+wheel", text="narrower, wider field of view",
        held={"n": ("widen", -1.0), "m": ("widen", 1.0)}),
    Row(group="Fly", keys=f"1 … {len(VIEWPOINTS)}",
        text=", ".join(one.name for one in VIEWPOINTS),
        once={str(n): f"viewpoint {n}" for n in range(1, len(VIEWPOINTS) + 1)}),
)  # fmt: skip

_LIGHT: Final = (
    Row(group="Light", keys="right drag", text="move the sun; with Ctrl or Shift any drag does"),
    Row(group="Light", keys="T", text="let time pass, or stop it", once={"t": "time"}),
    Row(group="Light", keys="+ −", text="brighter, darker by a third of a stop",
        once={"+": "brighter", "=": "brighter", "Shift+=": "brighter", "Shift++": "brighter",
              "-": "darker"}),
    Row(group="Light", keys="X", text="automatic exposure", once={"x": "automatic exposure"}),
)  # fmt: skip

_READ: Final = (
    Row(group="Read and compare", keys="P, click", text="probe: spectrum and colour of a point",
        once={"p": "probe"}, hosts=_WINDOW),
    Row(group="Read and compare", keys="P", text="probe: light and colour where one points",
        once={"p": "probe"}, hosts=_PAGE),
    Row(group="Read and compare", keys="B", text="keep this planet and view as B",
        once={"b": "keep as b"}),
    Row(group="Read and compare", keys="C", text="A and B side by side, with a line to drag",
        once={"c": "compare"}, hosts=_WINDOW),
    Row(group="Read and compare", keys="V", text="change A and B over", once={"v": "swap"}),
)  # fmt: skip

_EDIT: Final = (
    Row(group="Edit", keys="G", text="gallery of planets", once={"g": "gallery"}, hosts=_WINDOW),
    Row(group="Edit", keys="Ctrl+click", text="type a number into a slider", hosts=_WINDOW),
    Row(group="Edit", keys="Ctrl+Z", text="undo", once={"Control+z": "undo"}),
    Row(group="Edit", keys="Ctrl+Y", text="redo; Ctrl+Shift+Z too",
        once={"Control+y": "redo", "Control+Shift+z": "redo"}),
    Row(group="Edit", keys="Ctrl+S", text="save the picture", once={"Control+s": "save picture"}),
    Row(group="Edit", keys="Ctrl+Shift+S", text="save the planet file",
        once={"Control+Shift+s": "save planet"}, hosts=_WINDOW),
    Row(group="Edit", keys="U", text="copy a link to what is shown", once={"u": "copy link"}),
    Row(group="Edit", keys="O", text="film of the moving sun, from here", once={"o": "film"},
        hosts=_WINDOW),
    Row(group="Edit", keys="O", text="film: start, and end", once={"o": "film"}, hosts=_PAGE),
    Row(group="Edit", keys="Tab", text="hide or show the panels", once={"Tab": "panels"}),
    Row(group="Edit", keys="F, F11", text="fullscreen", hosts=_WINDOW,
        once={"f": "fullscreen", "F11": "fullscreen"}),
    Row(group="Edit", keys="F", text="fullscreen", once={"f": "fullscreen"}, hosts=_PAGE),
    Row(group="Edit", keys="Esc", text="close what is open, leave fullscreen, show the panels",
        once={"Escape": "leave"}),
    Row(group="Edit", keys="F1, H", text="this help", once={"F1": "help", "h": "help"}),
    Row(group="Edit", keys="Ctrl+Q", text="close the window", once={"Control+q": "close"},
        hosts=_WINDOW),
)  # fmt: skip

#: All rows, in the order of the help.
TABLE: Final = (*_FLY, *_LIGHT, *_READ, *_EDIT)


def rows_of(host: Host) -> tuple[Row, ...]:
    """Rows that a host offers.

    Examples
    --------
    >>> any("compare" in row.once.values() for row in rows_of("page"))
    False
    """
    return tuple(row for row in TABLE if host in row.hosts)


def _together(name: str, host: Host) -> dict[str, Any]:
    return {key: value for row in rows_of(host) for key, value in getattr(row, name).items()}


#: Bindings of the window's keys: movements while held, speed factors, commands.
HELD: Final[Mapping[str, tuple[str, float]]] = _together("held", "window")
FACTORS: Final[Mapping[str, float]] = _together("factors", "window")
ONCE: Final[Mapping[str, str]] = _together("once", "window")


def chord(key: str, *, control: bool, shift: bool) -> str:
    """Key with its modifiers, as ``Row.once`` spells it.

    Examples
    --------
    >>> chord("Z", control=True, shift=True), chord("Tab", control=False, shift=False)
    ('Control+Shift+z', 'Tab')
    """
    words = ["Control"] * control + ["Shift"] * shift
    return "+".join([*words, key.lower() if len(key) == 1 else key])


def as_json(host: Host) -> dict[str, Any]:
    """Table for a page: ``help`` by group, bindings as in ``Row``, ``rates``."""
    found: dict[str, list[list[str]]] = {}
    for row in rows_of(host):
        found.setdefault(row.group, []).append([row.keys, row.text])
    return {
        "help": [[group, lines] for group, lines in found.items()],
        **{name: _together(name, host) for name in ("held", "factors", "once")},
        "rates": dict(RATES),
    }


def markdown(host: Host) -> str:
    """Table in Markdown, for the documentation.

    Examples
    --------
    >>> print(markdown("page").splitlines()[2])
    | drag | look around |
    """
    lines = [f"| {row.keys} | {row.text} |" for row in rows_of(host)]
    return "\n".join(["| mouse, key | what it does |", "|---|---|", *lines])
