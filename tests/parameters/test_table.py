"""Looking rows up by what users write."""

from __future__ import annotations

import pytest

from gazelle.parameters import Parameter, ParameterTable, refused

_EXACT = Parameter("gains.all.p", "number", 1.0, "of all")
_PATTERN = Parameter("gains.<joint>.p", "number", 0.0, "of one")
_GROUP = Parameter("map", "group", None, "below", aliases=("grid",))
_TABLE = ParameterTable("thing", "A thing.", ("pkg/thing",), (_PATTERN, _EXACT, _GROUP))


def test_a_name_that_is_spelled_out_comes_before_patterns() -> None:
    assert _TABLE.row_for("gains.all.p") is _EXACT
    assert _TABLE.row_for("gains.knee.p") is _PATTERN
    assert _TABLE.row_for("grid.size") is _GROUP
    assert _TABLE.row_for("gains.knee.q") is None


def test_a_row_is_asked_for_by_any_of_its_names() -> None:
    assert _TABLE.row("grid") is _TABLE.row("map")
    with pytest.raises(KeyError, match=r"thing has no parameter gains\.knee\.p"):
        _TABLE.row("gains.knee.p")


def test_more_rows_are_looked_up_as_well() -> None:
    more = _TABLE.plus(refused("no such thing", "ghost"))
    assert more.row("ghost").is_refused
    assert more.keys() == _TABLE.keys()
    assert _TABLE.row_for("ghost") is None
