"""One side of a session's comparison, to be followed by a solver of its own."""

from __future__ import annotations

from collections.abc import Callable

from airlight.viewer.session.session import Session
from airlight.viewer.session.solve_request import Versions, Wanted


class SessionSide:
    """What a session wants to be solved for one side, whichever is shown.

    Parameters
    ----------
    session : Session
    side : str
        ``A`` or ``B``.
    """

    def __init__(self, session: Session, side: str) -> None:
        self._session = session
        self._side = side

    @property
    def wanted(self) -> Wanted:
        """What has to be solved; the shown side's, while there is only one."""
        if self._session.showing == self._side:
            return self._session.wanted
        return self._session.wanted_other or self._session.wanted

    def follow(self, follower: Callable[[Versions], None]) -> Callable[[], None]:
        """See ``Session.follow``."""
        return self._session.follow(follower)
