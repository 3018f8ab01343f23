"""Names and conditions that depend on parameters."""

from __future__ import annotations

import pytest

from gazelle.node_specs.parameter_substitution import expanded, holds


def _value_of(name: str, default: str) -> str:
    return {"~scan_topic": "/laser", "~publish_tf": "False"}.get(name, default)


def test_a_name_takes_a_parameter_or_its_default() -> None:
    assert expanded("{~scan_topic|scan}", _value_of) == "/laser"
    assert expanded("{odom_frame|odom}/{x|y}", _value_of) == "odom/y"
    assert expanded("cmd_vel", _value_of) == "cmd_vel"


@pytest.mark.parametrize(
    ("when", "met"),
    [
        ("", True),
        ("~publish_tf|true", False),
        ("!~publish_tf|true", True),
        ("~stamped|false", False),
        ("!~stamped|false", True),
        ("~tf_broadcast|true", True),
    ],
)
def test_a_condition_is_a_parameter_that_is_true_or_false(when: str, met: bool) -> None:
    assert holds(when, _value_of) is met
