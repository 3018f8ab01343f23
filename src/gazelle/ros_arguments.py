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
    "RosToken",
    "Rule",
    "SplitArguments",
    "read_tokens",
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


class RosToken(NamedTuple):
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
    ros: list[RosToken]
    is_ros2: bool


def split_arguments(arguments: Sequence[str]) -> SplitArguments:
    """Split a program's arguments into its own and ROS's."""
    own: list[str] = []
    ros: list[RosToken] = []
    tokens = iter(arguments)
    is_ros2 = False
    for token in tokens:
        if token == _BEGIN:
            is_ros2 = True
            ros += read_tokens(tokens)
        else:
            own.append(token)
    return SplitArguments(own, ros, is_ros2)


def read_tokens(tokens: Iterable[str]) -> Iterator[RosToken]:
    """Yield the options of a section until its ``--``, which is taken, or the end."""
    tokens = iter(tokens)
    for token in tokens:
        if token == _END:
            return
        if token == _BEGIN:
            # Launch files begin a section in the one that they were given.
            continue
        option = _SHORT.get(token, token)
        if option in _WITH_VALUE:
            yield RosToken(option, next(tokens, None), token)
        else:
            yield RosToken(token if token.startswith(_SWITCHES) else "", None, token)


def value_of(token: RosToken) -> str:
    """Return the value of an option that must have one.

    Raises:
        RosArgumentError: nothing stands after it.
    """
    if token.value is None:
        raise RosArgumentError(
            f"{token.written} has no value after it\n"
            f"  ROS says: Failed to parse {token.written} rule"
        )
    return token.value


def rule_of(token: RosToken) -> Rule:
    """Return the rule after `REMAP` or `PARAM`.

    Raises:
        RosArgumentError: there is none.
    """
    text = value_of(token)
    left, separator, value = text.partition(":=")
    node, colon, name = left.partition(":")
    if left.startswith(_SCHEMES):
        node, name = "", left.partition("://")[2]
    elif not colon:
        node, name = "", left
    if not separator or not name:
        raise RosArgumentError(
            f"'{text}' after {token.written} is no rule\n  fix: write name:=value\n"
            f"  ROS says: Couldn't parse {token.written} rule: '{token.written} {text}'"
        )
    return Rule(node, name, value)


def unknown_word(token: RosToken) -> RosArgumentError:
    """Return the error that says of a word that it is no option of ROS's."""
    from gazelle.diagnostics import did_you_mean

    hint = did_you_mean(token.written, _KNOWN) or "put -- before arguments of your own"
    return RosArgumentError(
        f"'{token.written}' after --ros-args is not known; {hint}\n"
        f"  ROS says: Found unknown ROS arguments: ['{token.written}']"
    )


def yaml_value(text: str) -> Any:
    """Return the value of a parameter: YAML, or the text where it is none."""
    # Most nodes are given no values.
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        return load_yaml(text)
    except YamlError:
        return text
