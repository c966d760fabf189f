"""Initial state of a window."""

from __future__ import annotations

import pytest

from airlight.errors import ConflictError
from airlight.viewer.session.saved_state import to_fragment
from airlight.viewer.window.start import Start, opened


def test_the_address_of_a_page_is_opened_with_its_edits_and_view() -> None:
    # A URL as a browser shows it; the window starts there, with nothing to undo.
    state = {
        "planet": "mars",
        "air": {"air.amounts[1]": 2.0},
        "view": {"view.altitude": 500.0, "view.heading": 12.0},
    }
    session = opened(
        Start(planet=f"file:///home/me/my page.html?device=webgl2#{to_fragment(state)}")
    )
    assert session.planet.source == "mars"
    assert session.value("dust.amount") == 2.0
    assert session.value("view.altitude") == 500.0
    assert session.value("view.heading") == 12.0
    assert not session.can_undo


def test_a_planet_by_name_begins_aside_from_the_sun() -> None:
    # The first viewpoint's own bearing, 70 degrees to the right of the sun, with nothing to undo.
    session = opened(Start(planet="mars", changes=("dust.amount=3",)))
    assert session.value("dust.amount") == 3.0
    assert session.value("view.heading") == session.value("view.sun_azimuth") + 70.0
    assert not session.can_undo


def test_a_link_of_a_scene_opens_in_its_page_alone() -> None:
    link = f"page.html#{to_fragment({'planet': 'iss', 'view': {}})}"
    with pytest.raises(ConflictError, match="iss is a scene, whose links open in its page alone"):
        opened(Start(planet=link))
