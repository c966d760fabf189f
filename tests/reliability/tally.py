"""Count of what was tried: how often it held, was refused in a line, or broke, and how."""

from __future__ import annotations

import collections
from dataclasses import dataclass, field


@dataclass
class Tally:
    """Verdicts of one fuzzer.

    Attributes
    ----------
    name : str
        Subject in a line of a report.
    counts : Counter
        Number of each verdict: ``held``, ``refused``, ``stopped`` (out of time, ended by Ctrl-C).
    broke : list of str
        What broke, with what was tried.
    note : str
        Further figure for the report.
    """

    name: str
    counts: collections.Counter[str] = field(default_factory=collections.Counter)
    broke: list[str] = field(default_factory=list)
    note: str = ""

    def add(self, verdict: str, fault: str = "") -> None:
        """Count a verdict; a fault, if there is one, is kept instead."""
        if fault:
            self.broke.append(fault)
        else:
            self.counts[verdict] += 1

    @property
    def tried(self) -> int:
        return sum(self.counts.values()) + len(self.broke)

    def __str__(self) -> str:
        words = ", ".join(f"{count} {word}" for word, count in sorted(self.counts.items()))
        line = f"{self.name}: tried {self.tried}: {words}, broke {len(self.broke)}"
        return f"{line}; {self.note}" if self.note else line
