"""Old names that work for one release more."""

from __future__ import annotations

from pathlib import Path

import pytest

import gazelle.interfaces
from gazelle.deprecation import warn_renamed
from gazelle.interfaces import RosVersion


def test_a_warning_names_the_new_name_and_the_end_of_the_old_one() -> None:
    def old() -> None:
        warn_renamed("place.Old", "New", gone_in="9.0.0")

    text = r"place\.Old is called New now; the old name goes with Gazelle 9\.0\.0"
    with pytest.warns(DeprecationWarning, match=text) as caught:
        old()
    assert Path(caught[0].filename) == Path(__file__)


def test_generation_of_messages_is_ros_version() -> None:
    with pytest.warns(DeprecationWarning, match=r"Generation is called RosVersion now"):
        assert gazelle.interfaces.Generation is RosVersion
