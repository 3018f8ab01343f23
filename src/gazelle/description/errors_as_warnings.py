"""Which mistakes the originals go on with: what Gazebo loads is loaded, with a warning."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from gazelle.description.urdfdom_emulation import element_of, verdict_of_element
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostic, Severity
from gazelle.diagnostics.catalogue import entry_for

__all__ = ["lenient_document", "lenient_robot", "strict"]

# Gazebo prints an error for each and loads the rest ("SDF is not valid, see errors above. This
# can lead to an unexpected behaviour."); joints fail alone ("LoadJoint Failed").
_DOCUMENT_CODES = frozenset(
    {
        "sdf.bad-inertia",
        "sdf.bad-joint",
        "sdf.duplicate-name",
        "sdf.frame-cycle",
        "sdf.unknown-frame",
        "sdf.unknown-joint-type",
        "xml.bad-number",
    }
)
_ROBOT_PREFIXES = ("urdf.", "xml.bad-number")


def lenient_document(findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings of an SDF document, as warnings where Gazebo goes on."""
    for item in findings:
        yield _lowered(item) if item.code in _DOCUMENT_CODES else item


def lenient_robot(robot: Tag, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings of a robot that became a model, as warnings where urdfdom takes it.

    urdfdom reads robots for every program of ROS and for Gazebo. What it refuses stays an error.

    Args:
        robot: the ``<robot>``.
        findings: what reading it reported.
    """
    kept = tuple(findings)
    has_errors = any(item.severity is Severity.ERROR for item in kept)
    is_taken = has_errors and verdict_of_element(element_of(robot)).robot is not None
    for item in kept:
        is_lowered = is_taken and item.code.startswith((*_ROBOT_PREFIXES, *_DOCUMENT_CODES))
        yield _lowered(item) if is_lowered else item


def strict(findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield findings with the catalogue's severity where a run was lenient.

    Mistakes of models that a file includes stay what they are: somebody else wrote those.
    """
    for item in findings:
        is_robot = item.code.startswith(_ROBOT_PREFIXES)
        is_included = item.code in _DOCUMENT_CODES and item.span is not None and item.span.via
        if (is_robot or item.code in _DOCUMENT_CODES) and not is_included:
            severity = Severity[entry_for(item.code).severity.upper()]
            yield replace(item, severity=max(item.severity, severity))
        else:
            yield item


def _lowered(item: Diagnostic) -> Diagnostic:
    return replace(item, severity=min(item.severity, Severity.WARNING))
