from __future__ import annotations

import pytest

from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan
from gazelle.errors import GazelleError, UserFileError

SPAN = SourceSpan("robot.urdf", 3, 7, 5)


def test_a_finding_says_where_what_how_and_the_old_phrase():
    found = Diagnostic("xml.malformed", Severity.ERROR, "it broke", SPAN, "mend it", "old words")
    assert str(found) == (
        "robot.urdf:3:7: error: it broke [xml.malformed]\n"
        "  fix: mend it\n"
        "  ROS/Gazebo says: old words"
    )


def test_a_finding_without_place_or_fix_is_one_line():
    assert str(Diagnostic("a.b", Severity.INFO, "so it is")) == "info: so it is [a.b]"


def test_reporting_takes_severity_fix_and_phrase_from_the_catalogue():
    diagnostics = Diagnostics()
    diagnostics.report("xml.malformed", "it broke", SPAN)
    (found,) = diagnostics
    assert (found.severity, found.phrase) == (Severity.ERROR, "XML parsing error")
    assert found.fix == "close the tag or quote the attribute at the place shown"


def test_reporting_can_override_severity_and_fix():
    diagnostics = Diagnostics()
    diagnostics.report("xml.malformed", "x", SPAN, fix="do y", severity=Severity.WARNING)
    (found,) = diagnostics
    assert (found.severity, found.fix) == (Severity.WARNING, "do y")


def test_an_unknown_code_is_a_mistake_of_the_programmer():
    with pytest.raises(KeyError, match=r"no\.such-code"):
        Diagnostics().report("no.such-code", "x")


def test_the_same_finding_is_kept_once():
    diagnostics = Diagnostics()
    for _ in range(3):
        diagnostics.report("xml.unknown-tag", "x", SPAN)
    diagnostics.report("xml.unknown-tag", "x", SourceSpan("robot.urdf", 4))
    assert len(diagnostics) == 2


def test_the_worst_severity_counts():
    diagnostics = Diagnostics()
    assert diagnostics.worst is None
    diagnostics.report("xml.unknown-tag", "x")
    assert diagnostics.worst is Severity.WARNING
    diagnostics.raise_if_errors()
    diagnostics.report("xml.malformed", "y")
    assert diagnostics.worst is Severity.ERROR


def test_all_findings_are_raised_at_once():
    diagnostics = Diagnostics()
    diagnostics.report("xml.unknown-tag", "first", SPAN)
    diagnostics.report("xml.malformed", "second", SPAN)
    diagnostics.report("xml.bad-number", "third", SPAN)
    with pytest.raises(UserFileError) as caught:
        diagnostics.raise_if_errors()
    assert [item.message for item in caught.value.diagnostics] == ["first", "second", "third"]
    assert all(word in str(caught.value) for word in ("first", "second", "third"))
    assert isinstance(caught.value, GazelleError)


def test_collections_can_be_joined_and_asked_by_code():
    one, two = Diagnostics(), Diagnostics()
    one.report("xml.unknown-tag", "x")
    two.report("xml.unknown-tag", "x")
    two.report("xml.malformed", "y")
    one.extend(two)
    assert len(one) == 2
    assert [item.message for item in one.by_code("xml.malformed")] == ["y"]
    assert [item.message for item in one.errors] == ["y"]
