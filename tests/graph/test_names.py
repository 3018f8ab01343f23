from __future__ import annotations

import re

import pytest

from gazelle.graph import names
from gazelle.graph.errors import IllegalNameError


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("/abs", "/abs"),
        ("rel/x", "/ns/rel/x"),
        ("base", "/ns/base"),
        ("~private", "/ns/node/private"),
        ("~/private", "/ns/node/private"),
        ("", "/ns"),
        ("~", "/ns/node"),
        ("/trailing/", "/trailing"),
    ],
)
def test_names_resolve_as_in_ros1(name: str, expected: str) -> None:
    assert names.resolve(name, "/ns", node="/ns/node") == expected


def test_remapping_applies_to_the_resolved_name() -> None:
    remappings = names.remap({"scan": "/robot/scan", "~out": "cmd"}, "/ns", node="/ns/node")
    assert remappings == {"/ns/scan": "/robot/scan", "/ns/node/out": "/ns/cmd"}
    assert names.resolve("scan", "/ns", remappings=remappings) == "/robot/scan"
    assert names.resolve("/ns/scan", "/other", remappings=remappings) == "/robot/scan"
    assert names.resolve("scan", "/other", remappings=remappings) == "/other/scan"


@pytest.mark.parametrize("name", ["a", "/a/b_1", "~a", "", "a/1b"])
def test_legal_names(name: str) -> None:
    assert names.is_legal(name)


@pytest.mark.parametrize("name", ["1a", "a-b", "a//b", "_a", "a b", "ä", "a\n"])
def test_illegal_names(name: str) -> None:
    assert not names.is_legal(name)


def test_illegal_first_character_is_told_in_ros_words() -> None:
    text = "Character [1] is not valid as the first character in Graph Resource Name [1scan]."
    with pytest.raises(IllegalNameError, match=re.escape(text)):
        names.check_name("1scan", "topic")


def test_illegal_character_is_told_with_its_place() -> None:
    with pytest.raises(ValueError, match=re.escape("Character [-] at element [2] is not valid")):
        names.check_name("my-topic")


def test_node_names_have_no_namespace() -> None:
    with pytest.raises(IllegalNameError, match="namespaces are not allowed in node names"):
        names.check_node_name("a/b")
    with pytest.raises(IllegalNameError, match="must not be empty"):
        names.check_node_name("")
    with pytest.raises(IllegalNameError, match="may not contain '~'"):
        names.check_node_name("~a")


def test_command_line_is_split_as_in_ros1() -> None:
    found = names.parse_command_line(
        ["--flag", "a:=/b", "_rate:=5.0", "_on:=true", "__name:=me", "__ns:=/r", "__log:=x", "z"]
    )
    assert found.remappings == {"a": "/b"}
    assert found.params == {"rate": 5.0, "on": True}
    assert (found.name, found.namespace) == ("me", "/r")
    assert found.special == {"__log": "x"}
    assert found.rest == ["--flag", "z"]


def test_anonymous_names_differ_and_are_legal() -> None:
    one, two = names.anonymous_name("talker"), names.anonymous_name("talker")
    assert one != two
    assert names.is_legal_base(one)


def test_hidden_names_have_a_part_with_underscore() -> None:
    assert names.is_hidden("/a/_b")
    assert not names.is_hidden("/a/b_")


def test_split_and_join_are_inverse() -> None:
    for name in ("/a", "/a/b", "/a/b/c"):
        assert names.join(*names.split(name)) == name
