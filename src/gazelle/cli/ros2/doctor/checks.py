"""The checks of ``ros2 doctor``."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import NamedTuple

from gazelle.cli.ros2.doctor.sight import Sight
from gazelle.cli.ros2.graph import types_by_name
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor.packages import check_environment
from gazelle.graph import Kind
from gazelle.workspace import Workspace

__all__ = ["Result", "counted_topics", "run_checks"]

_SKIPPED = frozenset({"/parameter_events", "/rosout"})


class Result(NamedTuple):
    """What a check found."""

    category: str
    errors: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def run_checks(sight: Sight) -> list[Result]:
    """Return what each check found, in the order of their names."""
    found = [_network(sight)]
    if sight.workspace is not None:
        found.append(_packages(sight.workspace))
    platform = Diagnostics()
    check_environment(os.environ, diagnostics=platform)
    return [*found, _from_diagnostics("platform", platform), _topic(sight)]


def counted_topics(sight: Sight) -> list[tuple[str, int, int]]:
    """Return the topics with how many publish and subscribe them."""
    topics = types_by_name(sight.entities, (Kind.PUBLISHER, Kind.SUBSCRIPTION))
    return [
        (name, _count(sight, name, Kind.PUBLISHER), _count(sight, name, Kind.SUBSCRIPTION))
        for name in topics
        if name not in _SKIPPED
    ]


def _network(sight: Sight) -> Result:
    return Result("network", warnings=(sight.trouble,) if sight.trouble else ())


def _packages(workspace: Workspace) -> Result:
    if not workspace.packages:
        return Result("package", warnings=("there are no packages",))
    return _from_diagnostics("package", workspace.diagnostics)


def _topic(sight: Sight) -> Result:
    types = types_by_name(sight.entities, (Kind.PUBLISHER, Kind.SUBSCRIPTION))
    errors = tuple(
        f"Topic {name} has several types: {', '.join(words)}; its ends do not hear each other."
        for name, words in types.items()
        if len(words) > 1
    )
    warnings = []
    for name, publishers, subscriptions in counted_topics(sight):
        if publishers and not subscriptions:
            warnings.append(f"Publisher without subscriber detected on {name}.")
        elif subscriptions and not publishers:
            warnings.append(f"Subscriber without publisher detected on {name}.")
    return Result("topic", errors, tuple(warnings))


def _from_diagnostics(category: str, found: Iterable[Diagnostic]) -> Result:
    items = list(found)
    errors = tuple(one.message for one in items if one.severity is Severity.ERROR)
    warnings = tuple(one.message for one in items if one.severity is Severity.WARNING)
    return Result(category, errors, warnings)


def _count(sight: Sight, name: str, kind: Kind) -> int:
    return sum(one.kind is kind and one.name == name for one in sight.entities)
