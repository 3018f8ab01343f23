"""Findings that are errors of a run here and none of the user's files: a ROS may have the part.

Gazelle runs no compiled code and brings a part of ROS's programs along. A run without them fails,
and so tells an error; a package that needs them is right all the same, and is only warned of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from gazelle.diagnostics import Diagnostic, Severity

__all__ = ["as_warnings_of_parts_elsewhere"]

_PARTS_ELSEWHERE = frozenset({"engine.unreadable-terrain", "launch.compiled-node"})
_NODE_PACKAGE = re.compile(r"in package \[([^]]+)\]")
_CLASS_PACKAGE = re.compile(r"Could not load class '(\w+)/")
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
    return [
        replace(item, severity=Severity.WARNING)
        if item.severity is Severity.ERROR and _is_elsewhere(item, own, has_own_hardware)
        else item
        for item in kept
    ]


def _is_elsewhere(item: Diagnostic, own: frozenset[str], has_own_hardware: bool) -> bool:
    if item.code in {"xacro.undefined-name", "xacro.unknown-macro"}:
        return _LEFT_OUT in item.message
    if item.code == "launch.executable-missing":
        # ROS's own package has more programs than Gazelle brings; one that is nearly another of
        # its names is a slip.
        return not item.fix.startswith("did you mean") and _named(item, _NODE_PACKAGE) not in own
    if item.code == "doctor.controller-fails":
        # Classes in the user's C++, or joints of hardware that is; ROS's own are known by name.
        return has_own_hardware or _named(item, _CLASS_PACKAGE) in own
    return item.code in _PARTS_ELSEWHERE


def _named(item: Diagnostic, pattern: re.Pattern[str]) -> str:
    found = pattern.search(item.message)
    return found[1] if found else ""
