"""Reading a controller's parameters: types, defaults, what is unknown."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Diagnostics
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

TABLE = ParameterTable(
    "test",
    "A table.",
    ("test/Test",),
    (
        Parameter("joint", "text", None, "the joint"),
        Parameter("joints", "texts", (), "joints"),
        Parameter("publish_rate", "number", 50.0, "rate", "Hz"),
        Parameter("depth", "integer", 3, "depth"),
        Parameter("limits.has_limits", "flag", False, "limits", aliases=("limited",)),
        Parameter("gains.<joint>.p", "number", 0.0, "gain"),
        Parameter("covariance", "numbers", (0.0, 0.0), "covariance"),
        Parameter("old", "refused", None, "removed long ago"),
    ),
)


def _parameters(tree: dict[str, Any]) -> tuple[ParameterReader, Diagnostics]:
    found = Diagnostics()
    named = controller_parameters("c", tree, TABLE, found, full_name=lambda key: f"/c/{key}")
    return named, found


def test_values_and_defaults() -> None:
    parameters, found = _parameters(
        {"joint": "j", "gains.j.p": 2, "limited": "true", "covariance": [1, 2.5], "joints": "one"}
    )
    assert parameters.text("joint") == "j"
    assert parameters.texts("joints") == ("one",)
    assert parameters.number("publish_rate") == 50.0
    assert parameters.number("publish_rate", 10.0) == 10.0
    assert parameters.integer("depth") == 3
    assert parameters.flag("limits.has_limits") is True
    assert parameters.number("gains.j.p") == 2.0
    assert parameters.number("gains.k.p") == 0.0
    assert parameters.numbers("covariance") == (1.0, 2.5)
    assert not list(found)


@pytest.mark.parametrize(
    ("key", "value", "read", "used"),
    [
        ("publish_rate", "fast", "number", 50.0),
        ("publish_rate", True, "number", 50.0),
        ("depth", 2.5, "integer", 3),
        ("depth", float("inf"), "integer", 3),
        ("limits", {"has_limits": "maybe"}, "flag", False),
        ("covariance", ["x"], "numbers", (0.0, 0.0)),
        ("joint", ["a"], "text", ""),
    ],
)
def test_wrong_types_are_reported_and_the_default_is_used(
    key: str, value: Any, read: str, used: Any
) -> None:
    parameters, found = _parameters({key: value})
    name = "limits.has_limits" if key == "limits" else key
    assert getattr(parameters, read)(name) == used
    (only,) = found
    assert only.code == "parameter.bad-value"
    assert f"parameter '/c/{name}' is " in only.message


def test_number_written_as_text_is_taken_and_told() -> None:
    parameters, found = _parameters({"publish_rate": "1e-3"})
    assert parameters.number("publish_rate") == 1e-3
    (only,) = found
    assert only.code == "parameter.number-as-text"
    assert only.fix == "write 0.001"


def test_unknown_and_idle_keys_are_reported() -> None:
    parameters, found = _parameters(
        {"type": "test/Test", "publish_rat": 1, "old": {"x": 1}, "gains": {"j": {"q": 1}}}
    )
    parameters.report_unknown()
    by_code = {(item.code, item.message) for item in found}
    assert {code for code, _ in by_code} == {"parameter.unknown", "parameter.idle"}
    unknown = [item for item in found if item.code == "parameter.unknown"]
    assert unknown[0].fix == "did you mean 'publish_rate'?"
    assert len(unknown) == 2


def test_missing_key_is_an_error_with_the_nearest_one() -> None:
    parameters, _ = _parameters({"joit": "j"})
    with pytest.raises(ControllerError, match=r"no 'joint' given .*did you mean 'joit'"):
        parameters.require("joint")
    with pytest.raises(ControllerError, match=r"no 'limits\.has_limits' or 'limited' given"):
        parameters.require("limits.has_limits")


def test_missing_section_is_asked_for() -> None:
    """ROS 2 files that spell a controller's name differently leave it without any parameter."""
    named = controller_parameters("arm", {}, TABLE, Diagnostics(), full_name=lambda key: key)
    with pytest.raises(ControllerError) as caught:
        named.require("joint")
    assert str(caught.value) == (
        "controller 'arm': no 'joint' given (parameter of node arm); it has no parameters at all: "
        "is its section named 'arm'?"
    )


def test_fallback_controllers_are_told_to_have_no_effect() -> None:
    parameters, found = _parameters({"fallback_controllers": ["hold"]})
    parameters.report_unknown()
    (only,) = found
    assert only.code == "parameter.idle"
    assert "a controller that fails is stopped, no other takes its place" in only.message
