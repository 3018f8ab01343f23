"""Which findings follow from others: whoever mends the cause mends them too.

One mistake shows in many places. A robot whose file is no XML cannot be spawned, so it has no
controllers, so nobody publishes its joints. The first of these is the one to read.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
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
        by_name: the consequence names what the cause has in quotes: a joint, a controller, a
            package.
        by_file: the cause names the file that the consequence is in.
        is_milder: the cause may be less severe than what follows from it.
        by_fix: the consequence lacks what the cause's fix asks for: ``no 'joint' given``.
        asks: the cause's fix asks for this name; ``?`` for any.
    """

    consequence: str
    causes: tuple[str, ...]
    by_name: bool = False
    by_file: bool = False
    is_milder: bool = False
    by_fix: bool = False
    asks: str = ""


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
    # What reads like the name of a plug-in that there is was to be one.
    _Rule("doctor.no-controller-manager", ("plugin.unknown",), is_milder=True),
    _Rule("doctor.joint-without-state", ("plugin.unknown",), asks="?"),
    _Rule("doctor.topic-elsewhere", ("doctor.topic-misspelt",), by_name=True),
    _Rule(
        "doctor.remap-unused",
        (
            *_DESCRIPTION, "doctor.spawn-fails", "doctor.world-missing",
            "launch.param-command-failed", "xml.missing-attribute",
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
    _Rule(
        "inertia.box",
        ("robot.mesh-unit", "robot.size-mismatch", "robot.size-unit"),
        by_name=True,
    ),
    _Rule("launch_ros2.not-installed", ("package.not-installed",)),
    _Rule("inertia.density", ("robot.size-unit",), by_name=True),
    _Rule("inertia.units", ("robot.size-unit",), by_name=True),
    _Rule("launch.arg-undeclared", ("xml.unknown-tag",), is_milder=True, asks="arg"),
    _Rule("launch.arg-missing", ("launch.arg-unused",), is_milder=True, by_fix=True),
    _Rule("launch.bad-attribute", ("xml.lenient",), is_milder=True),
    _Rule("launch.arg-undeclared", ("launch.bad-attribute",)),
    _Rule(
        "doctor.no-controller-manager",
        ("parameter.unknown",),
        is_milder=True,
        asks="robotNamespace",
    ),
    _Rule("doctor.controller-fails", ("parameter.unknown",), is_milder=True, by_fix=True),
    _Rule(
        "doctor.controller-fails", ("urdf.transmission-class",), is_milder=True, by_name=True
    ),
    _Rule(
        "control.hardware-interface-unknown",
        ("urdf.transmission-class",),
        is_milder=True,
        by_name=True,
    ),
    _Rule("control.transmission-type", ("urdf.transmission-class",), by_name=True),
    _Rule("package.generations-mixed", ("package.build-type",)),
    _Rule("urdf.child-missing", ("urdf.duplicate-link",), by_name=True),
    _Rule("urdf.parent-missing", ("urdf.duplicate-link",), by_name=True),
    _Rule("urdf.material-undefined", ("xacro.include-left-out",)),
    _Rule("xacro.include-left-out", ("package.names",), by_name=True, is_milder=True),
    *(
        _Rule(code, ("package.names",), by_name=True, is_milder=True)
        for code in (
            "doctor.packages-elsewhere", "doctor.world-missing", "launch.include-missing",
            "launch.package-missing", "launch_ros2.package-missing", "package.install-place",
            "package.scripts-folder", "urdf.collision-mesh-missing", "urdf.mesh-missing",
            "xacro.file-missing", "xacro.package-missing", "xml.unreadable",
        )
    ),
    *(
        _Rule(code, ("doctor.description-not-expanded",), by_file=True)
        for code in ("inertia.", "load.", "robot.", "urdf.", "xacro.", "xml.")
    ),
    _Rule("doctor.spawn-fails", ("doctor.description-not-expanded",)),
    _Rule("doctor.no-controller-manager", ("doctor.description-not-expanded",)),
    _Rule("doctor.controller-fails", ("control.names-disagree",), by_name=True, is_milder=True),
    _Rule("doctor.controller-fails", ("parameters.controller-type",), by_name=True, is_milder=True),
)  # fmt: skip


def causes_first(
    findings: Sequence[Diagnostic],
) -> tuple[tuple[Diagnostic, ...], tuple[Diagnostic, ...]]:
    """Part findings into those that stand for themselves and those that follow from them.

    Where a consequence is worse than its cause, the cause is told as severely: the exit code is
    that of the causes.

    Args:
        findings: in the order found.

    Returns:
        The causes and the consequences, each in the order found.
    """
    found = [
        next((other for other in findings if _follows(item, other)), None) for item in findings
    ]
    causes = tuple(
        _as_severe(item, findings, found)
        for item, cause in zip(findings, found, strict=True)
        if cause is None
    )
    late = (item for item, cause in zip(findings, found, strict=True) if cause is not None)
    return causes, tuple(late)


def _as_severe(
    cause: Diagnostic, findings: Sequence[Diagnostic], found: Sequence[Diagnostic | None]
) -> Diagnostic:
    """Raise a cause to what follows from it."""
    late = (item.severity for item, of in zip(findings, found, strict=True) if of is cause)
    worst = max(late, default=cause.severity)
    return replace(cause, severity=worst) if worst > cause.severity else cause


def _follows(item: Diagnostic, cause: Diagnostic) -> bool:
    if cause is item:
        return False
    return any(
        _is_of(item.code, rule.consequence)
        and any(_is_of(cause.code, code) for code in rule.causes)
        and (rule.is_milder or cause.severity >= item.severity)
        and (not rule.by_name or _names_of(cause.message, item))
        and (not rule.by_fix or _names_of(cause.fix, item))
        and (not rule.asks or f"'{rule.asks.strip('?')}" in cause.fix)
        and (not rule.by_file or (item.span is not None and item.span.file in cause.message))
        for rule in _RULES
    )


def _is_of(code: str, wanted: str) -> bool:
    return code.startswith(wanted) if wanted.endswith(".") else code == wanted


def _names_of(text: str, item: Diagnostic) -> bool:
    """Tell whether a finding has a name that stands in quotes in its cause's words."""
    return any(
        re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", item.message)
        for name in _QUOTED.findall(text)
    )
