"""Descriptions and configs read as real clients read them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    enum_edit_method,
)
from gazelle.graph.dynamic_reconfigure.messages import (
    config_message,
    description_message,
    enum_values,
    group_from_message,
    values_from_message,
)
from gazelle.interfaces import from_ros1, message_type, to_ros1

SIZES = (EnumConstant("Small", 0, "A small one"), EnumConstant("Large", 2, "It's large"))
ENUM = enum_edit_method(SIZES, "Sizes to choose from")
GROUP = DynamicGroup(
    "Default",
    (
        DynamicParameter("p", "double", 1.5, "Gain.", -100.0, 100.0),
        DynamicParameter("size", "int", 2, "Size.", 0, 3, ENUM, 4),
        DynamicParameter("free", "double", 0, "No limits."),
    ),
    (
        DynamicGroup(
            "Inner",
            (DynamicParameter("name", "str", "foo", "Name."),),
            (DynamicGroup("Deep", (DynamicParameter("on", "bool", True, "Switch."),)),),
            "collapse",
            False,
        ),
        DynamicGroup("Other", (DynamicParameter("count", "int", 7, "Count."),)),
    ),
)

# The definitions as ros.org publishes them (dynamic_reconfigure/msg, noetic).
DEFINITIONS = {
    "BoolParameter": "string name\nbool value",
    "IntParameter": "string name\nint32 value",
    "StrParameter": "string name\nstring value",
    "DoubleParameter": "string name\nfloat64 value",
    "GroupState": "string name\nbool state\nint32 id\nint32 parent",
    "ParamDescription": "string name\nstring type\nuint32 level\nstring description\n"
    "string edit_method",
    "Group": "string name\nstring type\nParamDescription[] parameters\nint32 parent\nint32 id",
    "Config": "BoolParameter[] bools\nIntParameter[] ints\nStrParameter[] strs\n"
    "DoubleParameter[] doubles\nGroupState[] groups",
    "ConfigDescription": "Group[] groups\nConfig max\nConfig min\nConfig dflt",
}


@pytest.fixture(scope="module")
def oracle() -> Any:
    """Another implementation's codec with the real definitions."""
    store = get_typestore(Stores.EMPTY)
    types: dict[str, Any] = {}
    for name, text in DEFINITIONS.items():
        types.update(get_types_from_msg(text, f"dynamic_reconfigure/msg/{name}"))
    store.register(types)
    return store


def _decoded(oracle: Any, message: Any, name: str) -> Any:
    return oracle.deserialize_ros1(bytes(to_ros1(message)), f"dynamic_reconfigure/msg/{name}")


def test_description_decodes_with_the_real_definitions(oracle: Any) -> None:
    found = _decoded(oracle, description_message(GROUP), "ConfigDescription")
    assert [(g.name, g.type, g.id, g.parent) for g in found.groups] == [
        ("Default", "", 0, 0),
        ("Inner", "collapse", 1, 0),
        ("Deep", "", 2, 1),
        ("Other", "", 3, 0),
    ]
    assert [row.name for row in found.groups[0].parameters] == ["p", "size", "free"]
    size = found.groups[0].parameters[1]
    assert (size.type, size.level, size.description) == ("int", 4, "Size.")
    assert [(one.name, one.value) for one in found.max.doubles] == [
        ("p", 100.0),
        ("free", math.inf),
    ]
    assert [one.value for one in found.min.doubles] == [-100.0, -math.inf]
    assert [one.value for one in found.min.ints] == [0, -(2**31)]
    assert [one.value for one in found.max.ints] == [3, 2**31 - 1]
    assert [one.value for one in found.dflt.strs] == ["foo"]
    assert [one.value for one in found.max.bools] == [True]
    assert [(g.name, g.state, g.id, g.parent) for g in found.dflt.groups][1] == (
        "Inner",
        False,
        1,
        0,
    )


def test_enum_is_the_literal_that_clients_evaluate(oracle: Any) -> None:
    found = _decoded(oracle, description_message(GROUP), "ConfigDescription")
    edit = eval(found.groups[0].parameters[1].edit_method)  # as rqt_reconfigure does
    assert edit["enum_description"] == "Sizes to choose from"
    assert [(one["name"], one["type"], one["value"]) for one in edit["enum"]] == [
        ("Small", "int", 0),
        ("Large", "int", 2),
    ]
    with pytest.raises(ValueError, match="Inconsistent types in enum"):
        enum_edit_method((EnumConstant("a", 1), EnumConstant("b", "x")), "")


def test_config_decodes_with_the_real_definitions_and_back(oracle: Any) -> None:
    values = {"p": 2.0, "size": 3, "name": "bar", "on": False, "count": 1}
    message = config_message(GROUP, values, {"Inner": True})
    found = _decoded(oracle, message, "Config")
    assert values_from_message(found) == values
    assert [one.state for one in found.groups] == [True, True, True, True]
    again = from_ros1(message_type("dynamic_reconfigure/Config"), to_ros1(message))
    assert again == message
    foreign = bytes(oracle.serialize_ros1(found, "dynamic_reconfigure/msg/Config"))
    assert foreign == bytes(to_ros1(message))


def test_group_survives_the_message() -> None:
    found = group_from_message(description_message(GROUP))
    assert [row.name for row in found.every_parameter()] == [
        row.name for row in GROUP.every_parameter()
    ]
    assert found.groups[0].groups[0].name == "Deep"
    assert not found.groups[0].state
    assert group_from_message(description_message(found)) == found
    assert enum_values(found.parameters[1]) == {"Small": 0, "Large": 2}


def test_edit_methods_of_others_are_never_run(tmp_path: Path) -> None:
    trap = tmp_path / "trap"
    for text in (f"open({str(trap)!r}, 'w')", "{'enum': 3}", "[", "[1]"):
        assert enum_values(DynamicParameter("x", "int", 0, "", edit_method=text)) == {}
    assert not trap.exists()


def test_values_are_cut_to_the_limits_in_their_type() -> None:
    rate = DynamicParameter("rate", "int", 5, "", 1, 10)
    assert (rate.clamped(50), rate.clamped(0), rate.clamped(3)) == (10, 1, 3)
    gain = DynamicParameter("gain", "double", 1, "")
    assert gain.clamped(7) == 7.0 and isinstance(gain.clamped(7), float)
    assert gain.accepts(3) and not gain.accepts(True) and not gain.accepts("3")
    assert rate.accepts(3) and not rate.accepts(3.0)
    assert DynamicParameter("s", "str", "", "").clamped("x") == "x"
