"""``--ros-args``: which words of a command line are ROS 2's own, and what they say, by rcl's rules.

Words between ``--ros-args`` and ``--``, or the end, are ROS's
(https://design.ros2.org/articles/ros_command_line_arguments.html and ``rcl/src/rcl/arguments.c``).
What a word then does is a matter of whoever asked: a program of rclpy, a node of Gazelle's own, a
controller or a plug-in.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from gazelle.errors import GazelleError

__all__ = [
    "LOG_LEVEL",
    "PARAM",
    "PARAMS_FILE",
    "REMAP",
    "RosArgumentError",
    "RosWord",
    "Rule",
    "SplitArguments",
    "read_words",
    "rule_of",
    "split_arguments",
    "unknown_word",
    "value_of",
    "yaml_value",
]

REMAP = "--remap"
PARAM = "--param"
PARAMS_FILE = "--params-file"
LOG_LEVEL = "--log-level"

_ENCLAVE = "--enclave"
_BEGIN, _END = "--ros-args", "--"
_SHORT = {"-r": REMAP, "-p": PARAM, "-e": _ENCLAVE}
_WITH_VALUE = frozenset(
    {REMAP, PARAM, PARAMS_FILE, LOG_LEVEL, _ENCLAVE, "--log-config-file", "--log-file-name"}
)
# --enable-rosout-logs, --disable-stdout-logs and so on have no value.
_SWITCHES = ("--enable-", "--disable-")
_SCHEMES = ("rostopic://", "rosservice://")
_KNOWN = (REMAP, PARAM, PARAMS_FILE, LOG_LEVEL, _ENCLAVE)


class RosArgumentError(GazelleError):
    """One of ROS's arguments is not understood."""


class RosWord(NamedTuple):
    """An option of ROS's with its value.

    Attributes:
        option: in its long form, such as `REMAP`; empty for a word that is no option.
        value: what stands after it, None where nothing does; a switch has none either.
        written: the option, or the word, as it was written.
    """

    option: str
    value: str | None
    written: str


class Rule(NamedTuple):
    """``node:name:=value``: a remapping or a parameter.

    Attributes:
        node: whose it is, empty for every node.
        name: of a topic, service or parameter, or ``__node`` and ``__ns``.
        value: as it was written.
    """

    node: str
    name: str
    value: str


class SplitArguments(NamedTuple):
    """A command line.

    Attributes:
        own: the words that are not ROS's.
        ros: those that are.
        is_ros2: whether there was a ``--ros-args``.
    """

    own: list[str]
    ros: list[RosWord]
    is_ros2: bool


def split_arguments(arguments: Sequence[str]) -> SplitArguments:
    """Split a program's arguments into its own and ROS's."""
    own: list[str] = []
    ros: list[RosWord] = []
    words = iter(arguments)
    is_ros2 = False
    for word in words:
        if word == _BEGIN:
            is_ros2 = True
            ros += read_words(words)
        else:
            own.append(word)
    return SplitArguments(own, ros, is_ros2)


def read_words(words: Iterable[str]) -> Iterator[RosWord]:
    """Yield the options of a section until its ``--``, which is taken, or the end."""
    words = iter(words)
    for word in words:
        if word == _END:
            return
        if word == _BEGIN:
            # Launch files begin a section in the one that they were given.
            continue
        option = _SHORT.get(word, word)
        if option in _WITH_VALUE:
            yield RosWord(option, next(words, None), word)
        else:
            yield RosWord(word if word.startswith(_SWITCHES) else "", None, word)


def value_of(word: RosWord) -> str:
    """Return the value of an option that must have one.

    Raises:
        RosArgumentError: nothing stands after it.
    """
    if word.value is None:
        raise RosArgumentError(
            f"{word.written} has no value after it\n  ROS says: Failed to parse {word.written} rule"
        )
    return word.value


def rule_of(word: RosWord) -> Rule:
    """Return the rule after `REMAP` or `PARAM`.

    Raises:
        RosArgumentError: there is none.
    """
    text = value_of(word)
    left, separator, value = text.partition(":=")
    node, colon, name = left.partition(":")
    if left.startswith(_SCHEMES):
        node, name = "", left.partition("://")[2]
    elif not colon:
        node, name = "", left
    if not separator or not name:
        raise RosArgumentError(
            f"'{text}' after {word.written} is no rule\n  fix: write name:=value\n"
            f"  ROS says: Couldn't parse {word.written} rule: '{word.written} {text}'"
        )
    return Rule(node, name, value)


def unknown_word(word: RosWord) -> RosArgumentError:
    """Return the error that says of a word that it is no option of ROS's."""
    from gazelle.diagnostics import did_you_mean

    hint = did_you_mean(word.written, _KNOWN) or "put -- before arguments of your own"
    return RosArgumentError(
        f"'{word.written}' after --ros-args is not known; {hint}\n"
        f"  ROS says: Found unknown ROS arguments: ['{word.written}']"
    )


def yaml_value(text: str) -> Any:
    """Return the value of a parameter: YAML, or the text where it is none."""
    # Most nodes are given no values.
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        return load_yaml(text)
    except YamlError:
        return text
