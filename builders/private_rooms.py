"""WGSL whose local arrays are variables of the module, so that GLSL need not copy them.

GLSL has no pointers: an array that a function is given to fill is copied in and out, element by
element, at every call, and compilers choke on it (Mesa needed four minutes for one shader). Here
each function that takes such pointers is written once for every set of arrays that it is called
with, and names them. No function of the shaders calls itself, and each array is written before it
is read, so that nothing else changes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_FUNCTION = re.compile(
    r"^(?P<marks>(?:@\w+(?:\([^)]*\))?\s+)*)"
    r"fn (?P<name>\w+)\((?P<params>.*?)\)(?P<result>[^{\n]*)\{\n"
    r"(?P<body>.*?)^\}\n?",
    re.MULTILINE | re.DOTALL,
)
_POINTER = re.compile(r"(\w+): ptr<function, (array<\w+, \d+>)>")
_LOCAL = re.compile(r"^ *var (\w+): (array<\w+, \d+>);\n", re.MULTILINE)


@dataclass(frozen=True)
class _Function:
    marks: str
    name: str
    params: tuple[str, ...]
    pointers: tuple[str | None, ...]  # for each parameter, its name if it is a pointer
    result: str
    body: str


def with_private_rooms(wgsl: str) -> str:
    """The same module with its local arrays as private variables.

    Parameters
    ----------
    wgsl : str
        As the emitter writes it: one statement a line, pointers to function arrays only.

    Examples
    --------
    >>> print(with_private_rooms('''fn fill(room: ptr<function, array<f32, 2>>) {
    ...   (*room)[0] = 1.0;
    ... }
    ... @fragment fn main() {
    ...   var a: array<f32, 2>;
    ...   fill(&a);
    ... }
    ... '''))
    var<private> main_a: array<f32, 2>;
    @fragment fn main() {
      fill_1();
    }
    fn fill_1() {
      main_a[0] = 1.0;
    }
    <BLANKLINE>
    """
    functions = {}
    for found in _FUNCTION.finditer(wgsl):
        params = tuple(_split(found["params"], "([<", ")]>"))
        pointers = tuple(m[1] if (m := _POINTER.fullmatch(one)) else None for one in params)
        functions[found["name"]] = _Function(
            found["marks"], found["name"], params, pointers, found["result"], found["body"]
        )
    rest = _FUNCTION.sub("", wgsl)
    rooms: list[str] = []
    written: list[str] = []
    known: dict[tuple[str, ...], str] = {}
    calls = re.compile(
        r"\b(" + "|".join(n for n, f in functions.items() if any(f.pointers)) + r")\("
    )

    def write(function: _Function, given: tuple[str, ...], name: str) -> None:
        taken = iter(given)
        names = {p: next(taken) for p in function.pointers if p is not None}
        body = function.body
        for local, kind in _LOCAL.findall(body):
            names[local] = f"{name}_{local}"
            rooms.append(f"var<private> {names[local]}: {kind};\n")
        body = _LOCAL.sub("", body)
        body = _calls(body, names)
        for local, room in names.items():
            body = body.replace(f"(*{local})[", f"{room}[")
            body = re.sub(rf"(?<![\w.]){local}\[", f"{room}[", body)
        kept = [
            p for p, pointer in zip(function.params, function.pointers, strict=True) if not pointer
        ]
        head = f"{function.marks}fn {name}({', '.join(kept)}){function.result}"
        written.append(f"{head}{{\n{body}}}\n")

    def _calls(body: str, names: dict[str, str]) -> str:
        if not calls.pattern or calls.pattern == r"\b()\(":
            return body
        out, at = [], 0
        while found := calls.search(body, at):
            end = _closing(body, found.end() - 1)
            callee = functions[found[1]]
            arguments = [_calls(one, names) for one in _split(body[found.end() : end])]
            given = tuple(
                names[one.removeprefix("&")]
                for one, pointer in zip(arguments, callee.pointers, strict=True)
                if pointer
            )
            kept = [o for o, p in zip(arguments, callee.pointers, strict=True) if not p]
            out.append(f"{body[at : found.start()]}{special(callee, given)}({', '.join(kept)})")
            at = end + 1
        return "".join(out) + body[at:]

    def special(function: _Function, given: tuple[str, ...]) -> str:
        key = (function.name, *given)
        if key not in known:
            known[key] = f"{function.name}_{1 + sum(k[0] == function.name for k in known)}"
            waiting.append((function, given, known[key]))
        return known[key]

    waiting = [(f, (), n) for n, f in functions.items() if not any(f.pointers)]
    while waiting:
        write(*waiting.pop(0))
    return rest.rstrip("\n") + ("\n" if rest.strip() else "") + "".join(rooms) + "".join(written)


def _split(text: str, opening: str = "([", closing: str = ")]") -> list[str]:
    """The parts between commas that no bracket encloses."""
    parts, depth, start = [], 0, 0
    for i, letter in enumerate(text):
        depth += letter in opening
        depth -= letter in closing
        if letter == "," and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    last = text[start:].strip()
    return [*parts, last] if last else parts


def _closing(text: str, opening: int) -> int:
    """The place of the bracket that closes the one at a place."""
    depth = 0
    for i in range(opening, len(text)):
        depth += text[i] == "("
        depth -= text[i] == ")"
        if depth == 0:
            return i
    raise ValueError("a bracket is not closed")
