"""Initial view of window, page and notebook."""

from __future__ import annotations

from collections.abc import Mapping

from airlight.viewer.navigation.viewpoints import FIRST, view_of
from airlight.viewer.session.editing import Editing


def first_view(session: Editing) -> Mapping[str, float]:
    """Values of the first viewpoint, for the planet of a session.

    Parameters
    ----------
    session : Session
        Session; its planet and location are unchanged.
    """
    bottom, top = (1e3 * float(session.value(f"shell.{end}_radius")) for end in ("bottom", "top"))
    return view_of(FIRST, bottom_radius=bottom, top_radius=top)
