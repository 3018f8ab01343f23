"""Findings that are errors of a run here and none of the user's files: a ROS may have the part.

Gazelle compiles the C++ of nodes and brings a part of ROS's programs along. A run without the rest
fails, and so tells an error; a package that needs it is right all the same, and is only warned.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan

__all__ = ["as_warnings_of_parts_elsewhere"]

_PARTS_ELSEWHERE = frozenset({"engine.unreadable-terrain", "launch.compiled-node"})
_NODE_PACKAGE = re.compile(r"in package \[([^]]+)\]")
_CLASS_PACKAGE = re.compile(r"Could not load class '(\w+)/")
_COMPILED = " is compiled code "
_LEFT_OUT = "; missing packages may define it"


def as_warnings_of_parts_elsewhere(
    findings: Iterable[Diagnostic], own_packages: Iterable[str]
) -> list[Diagnostic]:
    """Return findings with errors made warnings that a ROS with everything installed has not.

    Args:
        findings: in the order found.
        own_packages: names of the packages of the user's workspace.
    """
    own, kept = frozenset(own_packages), list(findings)
    has_own_hardware = any(item.code == "control.robot-sim-type" for item in kept)
    lowered = {
        id(item)
        for item in kept
        if item.severity is Severity.ERROR and _is_elsewhere(item, own, has_own_hardware)
    }
    files = [place.file for item in kept if id(item) in lowered for place in _places(item)]
    return [
        replace(item, severity=Severity.WARNING)
        if id(item) in lowered or _is_command_of(item, files)
        else item
        for item in kept
    ]


def _places(item: Diagnostic) -> tuple[SourceSpan, ...]:
    return (item.span, *item.span.via) if item.span is not None else ()


def _is_command_of(item: Diagnostic, files: Iterable[str]) -> bool:
    """Tell a description that could not be made for what is only left out in one of its files."""
    is_command = item.code == "launch.param-command-failed" and item.severity is Severity.ERROR
    return is_command and any(f"'{file}'" in item.message for file in files)


def _is_elsewhere(item: Diagnostic, own: frozenset[str], has_own_hardware: bool) -> bool:
    if item.code in {"xacro.undefined-name", "xacro.unknown-macro"}:
        return _LEFT_OUT in item.message
    if item.code == "launch.executable-missing":
        # ROS's own package has more programs than Gazelle brings; one that is nearly another of
        # its names is a slip.
        return not item.fix.startswith("did you mean") and _named(item, _NODE_PACKAGE) not in own
    if item.code == "doctor.controller-fails":
        # Classes in the user's C++, or joints of hardware that is; ROS's own are known by name.
        is_own = has_own_hardware or _named(item, _CLASS_PACKAGE) in own
        return is_own or _COMPILED in item.message
    return item.code in _PARTS_ELSEWHERE


def _named(item: Diagnostic, pattern: re.Pattern[str]) -> str:
    found = pattern.search(item.message)
    return found[1] if found else ""
