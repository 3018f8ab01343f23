"""Which findings follow from others: whoever mends the cause mends them too.

One mistake shows in many places. A robot whose file is no XML cannot be spawned, so it has no
controllers, so nobody publishes its joints. The first of these is the one to read.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
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
    follows = [any(_follows(item, other) for other in findings) for item in findings]
    causes = tuple(item for item, late in zip(findings, follows, strict=True) if not late)
    return causes, tuple(item for item, late in zip(findings, follows, strict=True) if late)


def _follows(item: Diagnostic, cause: Diagnostic) -> bool:
    if cause is item or cause.severity < item.severity:
        return False
    return any(
        rule.consequence == item.code
        and any(_is_of(cause.code, code) for code in rule.causes)
        and (not rule.by_name or bool(_names(item) & _names(cause)))
        for rule in _RULES
    )


def _is_of(code: str, wanted: str) -> bool:
    return code.startswith(wanted) if wanted.endswith(".") else code == wanted


def _names(item: Diagnostic) -> set[str]:
    return set(_QUOTED.findall(item.message))
