"""--ros-args in front of built-in nodes."""

from __future__ import annotations

import re

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.arguments import read_arguments


def test_rules_parameters_and_own_words_are_told_apart() -> None:
    words = "a b --ros-args -r /x:=/y -r __ns:=/r1 -p rate:=5 -p wheels.radius:=0.1 -- c"
    found = read_arguments([*words.split(), "--ros-args", "--remap", "__node:=n"], "default")
    assert found.rest == ("a", "b", "c")
    assert found.remappings == {"/x": "/y"}
    assert (found.name, found.namespace) == ("n", "/r1")
    assert found.params == {"rate": 5, "wheels/radius": 0.1}
    assert found.ros_version == 2


def test_node_name_before_a_rule_is_left_out() -> None:
    found = read_arguments(["--ros-args", "-r", "sim:a:=b", "-p", "sim:k:=1"], "sim")
    assert (found.remappings, found.params) == ({"a": "b"}, {"k": 1})


def test_rules_of_ros1_after_the_section_count_too() -> None:
    found = read_arguments(["--ros-args", "-p", "k:=1", "__name:=n"], "default")
    assert (found.name, found.params) == ("n", {"k": 1})


def test_parameter_file_counts_for_its_node_only(tmp_path) -> None:
    path = tmp_path / "params.yaml"
    path.write_text(
        "/r1/sim:\n  ros__parameters:\n    background_r: 7\n    a: {b: 2}\n"
        "other:\n  ros__parameters:\n    background_g: 8\n"
    )
    words = ["--ros-args", "--params-file", str(path), "-r", "__ns:=/r1", "-p", "a.b:=3"]
    assert read_arguments(words, "sim").params == {"background_r": 7, "a/b": 3}


def test_names_with_dots_in_a_parameter_file_are_those_of_branches(tmp_path) -> None:
    path = tmp_path / "params.yaml"
    path.write_text("/**: {ros__parameters: {a.b: 1, a: {c.d: 2}}}")
    words = ["--ros-args", "--params-file", str(path)]
    assert read_arguments(words, "n").params == {"a/b": 1, "a/c/d": 2}


def test_section_may_begin_anew_within_itself() -> None:
    words = ["a", "--ros-args", "-p", "x:=1", "--ros-args", "-r", "__node:=n", "--", "b"]
    found = read_arguments(words, "other")
    assert (found.name, found.params, found.rest) == ("n", {"x": 1}, ("a", "b"))


def test_generation_is_the_environments_without_the_section(monkeypatch) -> None:
    monkeypatch.delenv("ROS_VERSION", raising=False)
    assert read_arguments([], "n").ros_version == 1
    monkeypatch.setenv("ROS_VERSION", "2")
    assert read_arguments([], "n").ros_version == 2


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["-p"], "-p has no value after it"),
        (["-r", "ab"], "'ab' after -r is no rule"),
        (["-p", ":=3"], "':=3' after -p is no rule"),
        (["--foo"], "Found unknown ROS arguments: ['--foo']"),
        (["--log-level", "loud"], "there are debug, info, warn, error, fatal"),
    ],
)
def test_what_is_not_understood_is_told_in_ros_words(words: list[str], text: str) -> None:
    with pytest.raises(LaunchError, match=re.escape(text)):
        read_arguments(["--ros-args", *words], "n")


def test_parameters_may_have_topics_in_their_names(tmp_path) -> None:
    name = "qos_overrides./model/blue.subscriber.reliability"
    path = tmp_path / "params.yaml"
    path.write_text(f"/**: {{ros__parameters: {{{name}: reliable, a: {{/b: 1}}}}}}")
    expected = {"qos_overrides/model/blue/subscriber/reliability": "reliable"}
    words = ["--ros-args", "-p", f"{name}:=reliable"]
    assert read_arguments(words, "n").params == expected
    words = ["--ros-args", "--params-file", str(path)]
    assert read_arguments(words, "n").params == {**expected, "a/b": 1}


def test_who_started_a_node_is_unknown_in_a_bare_shell(monkeypatch) -> None:
    monkeypatch.delenv("ROS_VERSION", raising=False)
    assert read_arguments([], "n").started_by == 0
    assert read_arguments(["--ros-args"], "n").started_by == 2
    monkeypatch.setenv("ROS_VERSION", "1")
    assert read_arguments([], "n").started_by == 1
