"""Key and mouse bindings, shared by window, page and notebook.

Each row is a line of the help with its bindings and the hosts that offer it: a browser reserves
Ctrl with a letter, writes no planet files and has one view; a window has no touch screen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

from airlight.geometry.ephemeris.world import WORLDS
from airlight.scene.flight import CLIMB, FOOTING, NOTCH, RATE
from airlight.viewer.navigation.places import menu_name, places_of
from airlight.viewer.navigation.viewpoints import VIEWPOINTS
from airlight.viewer.session.adaptation import BRIGHTEST, TIME_CONSTANT
from airlight.viewer.session.history import MOST_STEPS, TOGETHER

Host = Literal["window", "page"]

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
    "brightest": BRIGHTEST,  # excess of the automatic exposure while it adapts [EV]
    "time": 1800.0,  # initial rate of the sun's time relative to real time [1]
    "longest_step": 0.1,  # limits the distance flown after a pause [s]
    "click": 3.0,  # a press with a smaller movement is a click [logical pixel]
    "steps": MOST_STEPS,  # number of undo steps
    "together": TOGETHER,  # longest time between edits that are one undo step [s]
}

#: Hint while a far planet is outside the picture.
LOST: Final = "the planet is outside the picture: Home shows it"


@dataclass(frozen=True)
class Row:
    """Line of the help and its bindings.

    Attributes
    ----------
    keys, text : str
        Keys or gestures, and their effect, as the help shows them.
    hosts : tuple of str
        Hosts that offer the row.
    held : mapping from str to (str, float)
        Movement while a key is down: axis and sign, by the key's name in lower case.
    factors : mapping from str to float
        Speed factors of keys while they are down. [1]
    once : mapping from str to str
        Commands by key, its name prefixed with ``Control+`` and ``Shift+``.
    """

    keys: str
    text: str
    hosts: tuple[Host, ...] = ("window", "page")
    held: Mapping[str, tuple[str, float]] = field(default_factory=dict)
    factors: Mapping[str, float] = field(default_factory=dict)
    once: Mapping[str, str] = field(default_factory=dict)


_WINDOW: Final[tuple[Host, ...]] = ("window",)
_PAGE: Final[tuple[Host, ...]] = ("page",)


def _moved(axis: str, forwards: str, backwards: str) -> dict[str, tuple[str, float]]:
    """Movements of keys, by their names with a space between."""
    signs = ((forwards, 1.0), (backwards, -1.0))
    return {key: (axis, sign) for keys, sign in signs for key in keys.split()}


#: All rows by their heading, in the order of the help.
TABLE: Final[dict[str, tuple[Row, ...]]] = {
    "Fly": (
        Row("drag", "look around; turn a planet that is seen whole"),
        Row("W S, ↑ ↓", "ahead, back", held=_moved("ahead", "w arrowup", "s arrowdown")),
        Row("A D, ← →", "left, right", held=_moved("right", "d arrowright", "a arrowleft")),
        Row("E Q, Page ↑ ↓", "up, down", held=_moved("up", "e pageup", "q pagedown")),
        Row("wheel", "towards the ground, or away", _WINDOW),
        Row("wheel, pinch", "towards the ground, or away", _PAGE),
        Row(
            "Shift, Alt",
            "four times as fast, as slow, the wheel too",
            factors={"shift": 4.0, "alt": 0.25},
        ),
        Row("Ctrl", "as Alt, once a key is down", _WINDOW, factors={"control": 0.25}),
        Row(
            "I K, J L",
            "look up, down, left, right",
            held=_moved("tilt", "k", "i") | _moved("turn", "l", "j"),
        ),
        Row("N M, Ctrl+wheel", "narrower, wider field of view", held=_moved("widen", "m", "n")),
        Row(
            f"1 … {len(VIEWPOINTS)}",
            ", ".join(one.name for one in VIEWPOINTS),
            once={str(n): f"viewpoint {n}" for n in range(1, len(VIEWPOINTS) + 1)},
        ),
        Row("Home", "the whole planet, over this place", once={"Home": "home"}),
        Row("R", "record a flight, or stop", _WINDOW, once={"r": "record"}),
        Row("Shift+R", "play the flight, or pause", _WINDOW, once={"Shift+r": "play"}),
        Row("Insert", "key frame of the flight here", _WINDOW, once={"Insert": "key frame"}),
    ),
    "Light": (
        Row("right drag", "move the sun; with Ctrl or Shift any drag does"),
        Row("T", "let time pass, or stop it", once={"t": "time"}),
        Row(
            "+ −",
            "brighter, darker by a third of a stop",
            once=dict.fromkeys(("+", "=", "Shift+=", "Shift++"), "brighter") | {"-": "darker"},
        ),
        Row("X", "automatic exposure", once={"x": "automatic exposure"}),
    ),
    "Read and compare": (
        Row("P, click", "probe: spectrum and colour of a point", _WINDOW, once={"p": "probe"}),
        Row("P, click", "probe: light and colour of a point", _PAGE, once={"p": "probe"}),
        Row("B", "keep this planet and view as B", once={"b": "keep as b"}),
        Row("C", "A and B side by side, with a line to drag", _WINDOW, once={"c": "compare"}),
        Row("V", "change A and B over", once={"v": "swap"}),
    ),
    "Edit": (
        Row("G", "gallery of planets", _WINDOW, once={"g": "gallery"}),
        Row("Ctrl+click", "type a number into a slider", _WINDOW),
        Row("Ctrl+Z", "undo", once={"Control+z": "undo"}),
        Row(
            "Ctrl+Y",
            "redo; Ctrl+Shift+Z too",
            once=dict.fromkeys(("Control+y", "Control+Shift+z"), "redo"),
        ),
        Row("Ctrl+S", "save the picture", once={"Control+s": "save picture"}),
        Row(
            "Ctrl+Shift+S", "save the planet file", _WINDOW, once={"Control+Shift+s": "save planet"}
        ),
        Row("U", "copy a link to what is shown", once={"u": "copy link"}),
        Row("O", "film of the moving sun, from here", _WINDOW, once={"o": "film"}),
        Row("O", "film: start, and end", _PAGE, once={"o": "film"}),
        Row("Tab", "hide or show the panels", once={"Tab": "panels"}),
        Row("F, F11", "fullscreen", _WINDOW, once=dict.fromkeys(("f", "F11"), "fullscreen")),
        Row("F", "fullscreen", _PAGE, once={"f": "fullscreen"}),
        Row(
            "Esc", "close what is open, leave fullscreen, show the panels", once={"Escape": "leave"}
        ),
        Row("F1, H", "this help", once=dict.fromkeys(("F1", "h"), "help")),
        Row("Ctrl+Q", "close the window", _WINDOW, once={"Control+q": "close"}),
    ),
}


def rows_of(host: Host) -> tuple[Row, ...]:
    """Rows that a host offers.

    Examples
    --------
    >>> any("compare" in row.once.values() for row in rows_of("page"))
    False
    """
    return tuple(row for rows in TABLE.values() for row in rows if host in row.hosts)


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
    """Table for a page: ``help`` by group, bindings as in ``Row``, ``rates``, ``places``."""
    return {
        "help": [
            [group, [[row.keys, row.text] for row in rows if host in row.hosts]]
            for group, rows in TABLE.items()
        ],
        **{name: _together(name, host) for name in ("held", "factors", "once")},
        "rates": dict(RATES),
        "lost": LOST,
        "places": {
            body: [[menu_name(one), one.latitude, one.longitude] for one in places_of(body)]
            for body in WORLDS
        },
    }


def markdown(host: Host) -> str:
    """Table in Markdown, for the documentation.

    Examples
    --------
    >>> print(markdown("page").splitlines()[2])
    | drag | look around; turn a planet that is seen whole |
    """
    lines = [f"| {row.keys} | {row.text} |" for row in rows_of(host)]
    return "\n".join(["| mouse, key | what it does |", "|---|---|", *lines])
