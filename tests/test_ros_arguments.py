from __future__ import annotations

import re

import pytest

from gazelle.ros_arguments import (
    LOG_LEVEL,
    PARAM,
    PARAMS_FILE,
    REMAP,
    RosArgumentError,
    RosToken,
    Rule,
    rule_of,
    split_arguments,
    unknown_word,
    value_of,
    yaml_value,
)


def test_ros_has_the_words_between_ros_args_and_two_dashes() -> None:
    words = "prog -r --ros-args -r a:=b --ros-args -p c:=1 -- --own --ros-args --params-file f"
    split = split_arguments(words.split())
    assert split.own == ["prog", "-r", "--own"]
    assert split.ros == [
        RosToken(REMAP, "a:=b", "-r"),
        RosToken(PARAM, "c:=1", "-p"),
        RosToken(PARAMS_FILE, "f", "--params-file"),
    ]
    assert split.is_ros2
    assert not split_arguments(["a", "--"]).is_ros2


@pytest.mark.parametrize(
    "option", ["--log-level", "--log-config-file", "--log-file-name", "-e", "--enclave"]
)
def test_an_option_takes_the_next_word(option: str) -> None:
    (word, rest) = split_arguments(["--ros-args", option, "x", "y"]).ros
    assert (word.value, rest) == ("x", RosToken("", None, "y"))
    assert (word.option == LOG_LEVEL) is (option == LOG_LEVEL)


def test_switches_have_no_value() -> None:
    words = ["--ros-args", "--disable-rosout-logs", "--enable-stdout-logs", "-r", "a:=b"]
    assert [word.value for word in split_arguments(words).ros] == [None, None, "a:=b"]
    assert all(word.option for word in split_arguments(words).ros)


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("a:=b", Rule("", "a", "b")),
        ("n:a:=b", Rule("n", "a", "b")),
        ("n:__ns:=/s", Rule("n", "__ns", "/s")),
        ("rostopic://a:=b", Rule("", "a", "b")),
        ("rosservice:///a:=/b:=c", Rule("", "/a", "/b:=c")),
        ("a:=", Rule("", "a", "")),
    ],
)
def test_a_rule_may_be_one_nodes(text: str, rule: Rule) -> None:
    assert rule_of(RosToken(REMAP, text, "-r")) == rule


@pytest.mark.parametrize("text", ["ab", ":=b", "n::=b", ""])
def test_what_is_no_rule_is_told_in_the_words_of_ros(text: str) -> None:
    wanted = (
        f"'{text}' after --remap is no rule\n  fix: write name:=value\n"
        f"  ROS says: Couldn't parse --remap rule: '--remap {text}'"
    )
    with pytest.raises(RosArgumentError, match=f"^{re.escape(wanted)}$"):
        rule_of(RosToken(REMAP, text, "--remap"))


def test_an_option_at_the_end_lacks_its_value() -> None:
    (word,) = split_arguments(["--ros-args", "-p"]).ros
    with pytest.raises(RosArgumentError, match=r"^-p has no value after it\n"):
        value_of(word)


def test_an_unknown_word_is_told_with_the_nearest() -> None:
    assert "did you mean '--param'" in str(unknown_word(RosToken("", None, "--parm")))
    assert "put -- before arguments of your own" in str(unknown_word(RosToken("", None, "mine")))


@pytest.mark.parametrize(
    ("text", "value"), [("1", 1), ("true", True), ("'1'", "1"), ("[a, b]", ["a", "b"]), ("[", "[")]
)
def test_values_are_yaml_where_they_can_be(text: str, value: object) -> None:
    assert yaml_value(text) == value
