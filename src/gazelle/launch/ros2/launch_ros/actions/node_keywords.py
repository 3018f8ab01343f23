"""Arguments of nodes that people get wrong, or that were called otherwise up to Foxy."""

from __future__ import annotations

import inspect
import shlex
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.deprecation import warn_once
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.substitution import Substitution

__all__ = ["check_keywords", "check_lists", "newer_names", "unknown_keywords"]

# Names of XML, of roslaunch and of haste.
_MEANT = {
    "args": "arguments",
    "exec": "executable",
    "node": "executable",
    "ns": "namespace",
    "param": "parameters",
    "params": "parameters",
    "pkg": "package",
    "remap": "remappings",
    "remaps": "remappings",
    "type": "executable",
}

_BY_NAME = frozenset({inspect.Parameter.KEYWORD_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD})


def newer_names(
    owner: str, given: dict[str, Any], kwargs: dict[str, Any], old_names: Mapping[str, str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return arguments by their names of today, and those that are left.

    Args:
        owner: the class, for messages.
        given: by the names of today, None where nothing is given.
        kwargs: all others.
        old_names: old names and those of today.

    Raises:
        TypeError: an argument is given by both names.
    """
    found, rest = dict(given), dict(kwargs)
    for old, new in old_names.items():
        if old not in rest:
            continue
        if found.get(new) is not None:
            raise TypeError(f"{owner}: both '{old}' and '{new}' are given; leave out '{old}'")
        found[new] = rest.pop(old)
        warn_once(
            f"The parameter '{old}' of {owner} is deprecated, use '{new}' (Foxy was the last to "
            "have it)",
            FutureWarning,
            stacklevel=3,
        )
    return found, rest


def check_keywords(kind: type, kwargs: Mapping[str, Any]) -> None:
    """See that a class, or one that it is made of, takes some arguments.

    Raises:
        TypeError: one is unknown; the message names what it may have been meant for.
    """
    for name, hint in unknown_keywords(kind, kwargs):
        text = f"{kind.__name__}() got an unexpected keyword argument '{name}'"
        raise TypeError(f"{text}; {hint}" if hint else text)


def unknown_keywords(kind: type, names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield names of arguments that neither a class nor one it is made of takes, with a hint."""
    classes = [*kind.__mro__, Executable]
    known = {
        name
        for one in classes
        if "__init__" in vars(one)
        for name, value in inspect.signature(vars(one)["__init__"]).parameters.items()
        if value.kind in _BY_NAME
    }
    for name in names:
        if name not in known:
            usual = f"did you mean '{_MEANT[name]}'?" if name in _MEANT else ""
            yield name, usual or did_you_mean(name, sorted(known - {"self"}))


def check_lists(*, parameters: Any, remappings: Any, arguments: Any) -> None:
    """See that lists are lists; of arguments a text is taken for its characters, as in ROS 2.

    Raises:
        TypeError: parameters or remaps are none; the message says what to write.
    """
    if parameters is not None and not isinstance(parameters, list | tuple):
        raise TypeError(
            f"'Node' expected 'parameters' to be a list, but got {parameters!r} of type "
            f"'{type(parameters).__name__}'; write parameters=[{_short(parameters)}]"
        )
    for one in () if isinstance(remappings, Substitution) else remappings or ():
        if not isinstance(one, tuple):
            ends = one.partition(":=") if isinstance(one, str) else ("from", "", "to")
            raise TypeError(
                f"Expected 'remap_rule' to be a tuple, but got {one!r}; write "
                f"remappings=[({ends[0]!r}, {ends[2]!r})]"
            )
    if isinstance(arguments, str) and len(arguments) > 1:
        launch_logging.get_logger("launch_ros.actions.node").warning(
            f"arguments of a Node is the text {arguments!r}: each character becomes a word, as in "
            f"ROS 2; write arguments={shlex.split(arguments)!r}"
        )


def _short(value: Any) -> str:
    return "{…}" if isinstance(value, Mapping) else repr(value)
