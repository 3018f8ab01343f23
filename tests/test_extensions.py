"""Parts of other people's packages are found by their entry points."""

from __future__ import annotations

import sys
from pathlib import Path

from tests.installed_packages import installed

from gazelle.extensions import ExtensionGroup, entry_points_of, find_entry_point, load_extensions

_GROUP = ExtensionGroup.PLANNERS
_SOURCE = """
    NUMBER = 3
    WORD = "three"
"""


def _points(**values: str) -> dict[str, dict[str, str]]:
    return {"gazelle.planners": values}


def test_nothing_is_imported_before_it_is_asked_for(tmp_path: Path) -> None:
    with installed(tmp_path, "odd_parts", _SOURCE, _points(three="odd_parts:NUMBER")):
        (point,) = (one for one in entry_points_of(_GROUP) if one.name == "three")
        assert find_entry_point(_GROUP, "three") == point
        assert find_entry_point(_GROUP, "four") is None
        assert "odd_parts" not in sys.modules
        (found,) = load_extensions(_GROUP, int).parts
        assert found.part == 3
        assert found.origin == (
            "entry point 'three = odd_parts:NUMBER' of odd_parts 1.2 (gazelle.planners)"
        )


def test_a_broken_part_is_told_and_the_others_go_on(tmp_path: Path) -> None:
    points = _points(a="odd_parts:MISSING", b="odd_parts:WORD", c="odd_parts:NUMBER", d="no_such:X")
    with installed(tmp_path, "odd_parts", _SOURCE, points):
        found = load_extensions(_GROUP, int)
        assert [one.name for one in found.parts] == ["c"]
        assert found.problems == (
            "entry point 'a = odd_parts:MISSING' of odd_parts 1.2 (gazelle.planners) cannot be "
            "loaded: AttributeError: module 'odd_parts' has no attribute 'MISSING'",
            "entry point 'b = odd_parts:WORD' of odd_parts 1.2 (gazelle.planners) is a str, not a "
            "builtins.int",
            "entry point 'd = no_such:X' of odd_parts 1.2 (gazelle.planners) cannot be loaded: "
            "ModuleNotFoundError: No module named 'no_such'",
        )
