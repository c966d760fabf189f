"""One side of a session's comparison, as observed by its solver thread."""

from __future__ import annotations

from collections.abc import Callable

from airlight.viewer.session.session import Session
from airlight.viewer.session.solve_request import SolveRequest, Versions


class SessionSide:
    """Solve requests of a session for one side, independent of the side shown.

    Parameters
    ----------
    session : Session
        Session that holds the sides.
    side : str
        Side, ``A`` or ``B``.
    """

    def __init__(self, session: Session, side: str) -> None:
        self._session = session
        self._side = side

    @property
    def solve_request(self) -> SolveRequest:
        """Request to solve; that of the current side while there is only one."""
        if self._session.showing == self._side:
            return self._session.solve_request
        return self._session.solve_request_other or self._session.solve_request

    def subscribe(self, observer: Callable[[Versions], None]) -> Callable[[], None]:
        """See ``Session.subscribe``."""
        return self._session.subscribe(observer)
