"""Which findings follow from others: whoever mends the cause mends them too.

One mistake shows in many places. A robot whose file is no XML cannot be spawned, so it has no
controllers, so nobody publishes its joints. The first of these is the one to read.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from gazelle.diagnostics import Diagnostic, Severity

__all__ = ["causes_first"]

_QUOTED = re.compile(r"'([^'\n]+)'")
_MAX_NAMES = 50
_WORD = re.compile(r"[\w-]+")
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
        by_line: both are in one line.
        is_milder: the cause may be less severe than what follows from it.
        by_fix: the consequence lacks what the cause's fix asks for: ``no 'joint' given``.
        asks: the cause's fix asks for this name; ``?`` for any.
    """

    consequence: str
    causes: tuple[str, ...]
    by_name: bool = False
    by_file: bool = False
    by_line: bool = False
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
    _Rule(
        "xml.unknown-attribute",
        ("urdf.geometry-incomplete", "urdf.inertial-incomplete", "xml.missing-attribute"),
        by_line=True,
    ),
    _Rule("sdf.bad-geometry", ("xml.unknown-tag",), by_line=True, asks="?"),
    _Rule("package.python-name", ("package.import-missing",), by_fix=True),
    _Rule("doctor.topic-type", ("package.import-missing",), by_name=True),
    _Rule("xacro.unknown-macro", ("xacro.file-missing",)),
    _Rule("xacro.undefined-name", ("xacro.file-missing",)),
    _Rule("control.parameter-file", ("launch.bad-yaml",), by_line=True),
    _Rule("doctor.controller-fails", ("control.parameter-file", "launch.bad-yaml")),
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
            "launch.package-missing", "launch_ros2.package-missing", "package.index-marker",
            "package.install-place",
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
    codes = {item.code for item in findings}
    causes = [
        _Causes.of(rule, findings)
        for rule in _RULES
        if any(_is_of(code, rule.consequence) for code in codes)
    ]
    found = [_cause_of(item, causes) for item in findings]
    worst: dict[int, Severity] = {}
    for item, cause in zip(findings, found, strict=True):
        if cause is not None:
            worst[id(cause)] = max(item.severity, worst.get(id(cause), cause.severity))
    alone = tuple(
        replace(item, severity=worst[id(item)]) if id(item) in worst else item
        for item, cause in zip(findings, found, strict=True)
        if cause is None
    )
    late = (item for item, cause in zip(findings, found, strict=True) if cause is not None)
    return alone, tuple(late)


@dataclass(slots=True)
class _Causes:
    """What may be the cause that a rule speaks of, the worst first.

    Attributes:
        by_name: by the names in quotes in them, or by no name.
        not_words: those of the names that are more than a word, such as paths.
    """

    rule: _Rule
    by_name: dict[str, list[Diagnostic]] = field(default_factory=dict)
    not_words: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, rule: _Rule, findings: Sequence[Diagnostic]) -> _Causes:
        made = cls(rule)
        for item in sorted(findings, key=lambda item: -item.severity):
            is_cause = any(_is_of(item.code, code) for code in rule.causes)
            if is_cause and (not rule.asks or f"'{rule.asks.strip('?')}" in item.fix):
                for name in made._names(item):
                    made.by_name.setdefault(name, []).append(item)
        made.not_words = [name for name in made.by_name if name and not _WORD.fullmatch(name)]
        return made

    def fitting(self, item: Diagnostic, words: set[str]) -> Iterator[Diagnostic]:
        """Yield what may be the cause of a finding that has these words."""
        rule = self.rule
        if not _is_of(item.code, rule.consequence):
            return
        known = self.by_name
        names = {""} & known.keys() or words & known.keys()
        names |= {name for name in self.not_words[:_MAX_NAMES] if name in item.message}
        for name in sorted(names):
            # One of the two worst is another one than the item itself.
            for cause in known[name][:2]:
                is_bad = rule.is_milder or cause.severity >= item.severity
                in_file = not rule.by_file or (
                    item.span is not None and item.span.file in cause.message
                )
                if cause is not item and is_bad and in_file and self._in_line(item, cause):
                    yield cause

    def _in_line(self, item: Diagnostic, cause: Diagnostic) -> bool:
        if not self.rule.by_line:
            return True
        one, other = item.span, cause.span
        return (
            one is not None
            and other is not None
            and (one.file, one.line) == (other.file, other.line)
        )

    def _names(self, item: Diagnostic) -> set[str]:
        if self.rule.by_name:
            return set(_QUOTED.findall(item.message))
        return set(_QUOTED.findall(item.fix)) if self.rule.by_fix else {""}


def _cause_of(item: Diagnostic, causes: Sequence[_Causes]) -> Diagnostic | None:
    words = set(_WORD.findall(item.message))
    return next((found for one in causes for found in one.fitting(item, words)), None)


def _is_of(code: str, wanted: str) -> bool:
    return code.startswith(wanted) if wanted.endswith(".") else code == wanted
