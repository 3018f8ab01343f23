"""Which findings follow from others: whoever mends the cause mends them too.

One mistake shows in many places. A robot whose file is no XML cannot be spawned, so it has no
controllers, so nobody publishes its joints. The first of these is the one to read.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from gazelle.diagnostics import Diagnostic

__all__ = ["causes_first"]

_QUOTED = re.compile(r"'([^'\n]+)'")
# What makes a description unreadable, or leaves something of it out.
_DESCRIPTION = ("limits.", "load.", "urdf.", "xacro.", "xml.")


class _Rule(NamedTuple):
    """What follows from what.

    Attributes:
        consequence: a code.
        causes: codes, or beginnings of codes that end with a dot.
        by_name: both name the same thing in quotes, a joint or a controller.
    """

    consequence: str
    causes: tuple[str, ...]
    by_name: bool = False


_RULES = (
    _Rule("launch.param-command-failed", _DESCRIPTION),
    _Rule("doctor.spawn-fails", (*_DESCRIPTION, "launch.param-command-failed")),
    _Rule(
        "doctor.no-controller-manager",
        (
            *_DESCRIPTION, "doctor.spawn-fails", "doctor.world-missing", "control.hardware-joint",
            "launch.param-command-failed",
        ),
    ),
    _Rule(
        "doctor.joint-without-state",
        (
            *_DESCRIPTION, "control.hardware-joint", "doctor.controller-fails",
            "doctor.no-controller-manager", "doctor.spawn-fails", "doctor.world-missing",
            "launch.param-command-failed", "plugin.missing-joint",
        ),
    ),
    _Rule(
        "doctor.controller-fails",
        ("control.hardware-joint", "control.names-disagree", "parameters.controller-type"),
        by_name=True,
    ),
    _Rule(
        "control.names-disagree",
        ("control.hardware-joint", "plugin.missing-joint", "urdf.transmission-joint"),
        by_name=True,
    ),
    _Rule("urdf.transmission-joint", ("control.hardware-joint",), by_name=True),
    _Rule("plugin.wheel-geometry", ("robot.wheel-axis", "urdf.degrees")),
    _Rule("plugin.wheel-geometry", ("parameter.unknown",), by_name=True),
    _Rule("robot.wheel-axis", ("urdf.degrees",)),
    _Rule("inertia.box", ("robot.mesh-unit", "robot.size-mismatch"), by_name=True),
    _Rule("package.generations-mixed", ("package.build-type",)),
)  # fmt: skip


def causes_first(
    findings: Sequence[Diagnostic],
) -> tuple[tuple[Diagnostic, ...], tuple[Diagnostic, ...]]:
    """Part findings into those that stand for themselves and those that follow from them.

    A consequence is never worse than its cause: the exit code is that of the causes.

    Args:
        findings: in the order found.

    Returns:
        The causes and the consequences, each in the order found.
    """
    consequences = {item.code for item in findings}
    causes = {rule: _causes(rule, findings) for rule in _RULES if rule.consequence in consequences}
    follows = [any(_follows(item, rule, found) for rule, found in causes.items())
               for item in findings]  # fmt: skip
    alone = tuple(item for item, late in zip(findings, follows, strict=True) if not late)
    return alone, tuple(item for item, late in zip(findings, follows, strict=True) if late)


def _causes(rule: _Rule, findings: Sequence[Diagnostic]) -> dict[str, list[Diagnostic]]:
    """Return what may be a rule's cause, the worst first: by the names in it, or by no name."""
    found: dict[str, list[Diagnostic]] = {}
    for item in sorted(findings, key=lambda item: -item.severity):
        if any(_is_of(item.code, code) for code in rule.causes):
            for name in _names(item) if rule.by_name else {""}:
                found.setdefault(name, []).append(item)
    return found


def _follows(item: Diagnostic, rule: _Rule, causes: Mapping[str, Sequence[Diagnostic]]) -> bool:
    if rule.consequence != item.code:
        return False
    names = _names(item) if rule.by_name else {""}
    # One of the two worst is another one than the item itself.
    near = (cause for name in names for cause in causes.get(name, ())[:2])
    return any(cause is not item and cause.severity >= item.severity for cause in near)


def _is_of(code: str, wanted: str) -> bool:
    return code.startswith(wanted) if wanted.endswith(".") else code == wanted


def _names(item: Diagnostic) -> set[str]:
    return set(_QUOTED.findall(item.message))
