"""``ros2 doctor`` and ``ros2 wtf``: what is there, and what looks wrong."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from collections.abc import Iterable
from typing import NamedTuple

from gazelle._version import __version__
from gazelle.cli.ros2.graph import types_by_name
from gazelle.cli.ros2.verbs import guarded
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor.packages import check_environment
from gazelle.graph import Entity, Graph, Kind, NoGraphError
from gazelle.workspace import Workspace

__all__ = [
    "main",
]

_SKIPPED = frozenset({"/parameter_events", "/rosout"})
_HELLO = (
    "hello: all nodes of the graph are on this machine; what ros2 doctor hello tries between "
    "machines has nothing to try"
)
_ABOUT = "Check ROS setup and other potential issues"
_MIN_WIDTH = 8


class _Sight(NamedTuple):
    """What was seen.

    Attributes:
        entities: of the graph.
        port: the graph's port, 0 when there is no graph.
        trouble: why there is no graph.
        workspace: None when packages are not looked at.
    """

    entities: tuple[Entity, ...] = ()
    port: int = 0
    trouble: str = ""
    workspace: Workspace | None = None


class _Result(NamedTuple):
    """What a check found."""

    category: str
    errors: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


class _Report(NamedTuple):
    """A section: which check it belongs to, its title, names and values."""

    category: str
    name: str
    items: tuple[tuple[str, object], ...]


def main(argv: list[str]) -> int:
    """Run ``ros2 doctor``; its exit code is 0 also when checks fail, as the original's."""
    return guarded(lambda: _run(_parser().parse_args(argv)))


def _look(*, with_packages: bool) -> _Sight:
    """Look at the graph, if there is one, and at the packages."""
    workspace = Workspace.discover() if with_packages else None
    try:
        with Graph.open(role="client") as graph:
            return _Sight(graph.entities(), graph.port, workspace=workspace)
    except NoGraphError as error:
        return _Sight(trouble=str(error).partition(" (")[0], workspace=workspace)


def _run_checks(sight: _Sight) -> list[_Result]:
    """Return what each check found, in the order of their names."""
    found = [_network(sight)]
    if sight.workspace is not None:
        found.append(_packages(sight.workspace))
    platform = Diagnostics()
    check_environment(os.environ, diagnostics=platform)
    return [*found, _from_diagnostics("platform", platform), _topic(sight)]


def _counted_topics(sight: _Sight) -> list[tuple[str, int, int]]:
    """Return the topics with how many publish and subscribe them."""
    topics = types_by_name(sight.entities, (Kind.PUBLISHER, Kind.SUBSCRIPTION))
    return [
        (name, _count(sight, name, Kind.PUBLISHER), _count(sight, name, Kind.SUBSCRIPTION))
        for name in topics
        if name not in _SKIPPED
    ]


def _reports(sight: _Sight) -> list[_Report]:
    """Return all sections in the order they are printed."""
    found = [_network_report(sight)]
    if sight.workspace is not None:
        packages = sorted(sight.workspace.packages.items())
        items = tuple((name, one.version or "no version") for name, one in packages)
        found.append(_Report("package", "PACKAGE VERSIONS", items))
    return [*found, _platform(), _middleware(), _ros2(), _topics(sight)]


def _network(sight: _Sight) -> _Result:
    return _Result("network", warnings=(sight.trouble,) if sight.trouble else ())


def _packages(workspace: Workspace) -> _Result:
    if not workspace.packages:
        return _Result("package", warnings=("there are no packages",))
    return _from_diagnostics("package", workspace.diagnostics)


def _topic(sight: _Sight) -> _Result:
    types = types_by_name(sight.entities, (Kind.PUBLISHER, Kind.SUBSCRIPTION))
    errors = tuple(
        f"Topic {name} has several types: {', '.join(type_names)}; its ends do not hear each other."
        for name, type_names in types.items()
        if len(type_names) > 1
    )
    warnings = []
    for name, publishers, subscriptions in _counted_topics(sight):
        if publishers and not subscriptions:
            warnings.append(f"Publisher without subscriber detected on {name}.")
        elif subscriptions and not publishers:
            warnings.append(f"Subscriber without publisher detected on {name}.")
    return _Result("topic", errors, tuple(warnings))


def _from_diagnostics(category: str, found: Iterable[Diagnostic]) -> _Result:
    items = list(found)
    errors = tuple(one.message for one in items if one.severity is Severity.ERROR)
    warnings = tuple(one.message for one in items if one.severity is Severity.WARNING)
    return _Result(category, errors, warnings)


def _count(sight: _Sight, name: str, kind: Kind) -> int:
    return sum(one.kind is kind and one.name == name for one in sight.entities)


def _network_report(sight: _Sight) -> _Report:
    items = (
        ("inet", "127.0.0.1"),
        ("graph's port", sight.port or "none: no graph is running"),
        ("ROS_DOMAIN_ID", os.environ.get("ROS_DOMAIN_ID", "0")),
    )
    return _Report("network", "NETWORK CONFIGURATION", items)


def _platform() -> _Report:
    items = (
        ("system", platform.system()),
        ("platform info", platform.platform()),
        ("release", platform.release()),
        ("processor", platform.processor() or platform.machine()),
    )
    return _Report("platform", "PLATFORM INFORMATION", items)


def _middleware() -> _Report:
    return _Report(
        "middleware", "RMW MIDDLEWARE", (("middleware name", "Gazelle's own, on Zenoh"),)
    )


def _ros2() -> _Report:
    items = (
        ("distribution name", os.environ.get("ROS_DISTRO", "not set")),
        ("gazelle version", __version__),
    )
    return _Report("platform", "ROS 2 INFORMATION", items)


def _topics(sight: _Sight) -> _Report:
    rows = _counted_topics(sight) or [("none", 0, 0)]
    items = tuple(
        item
        for name, publishers, subscriptions in rows
        for item in (
            ("topic", name),
            ("publisher count", publishers),
            ("subscriber count", subscriptions),
        )
    )
    return _Report("topic", "TOPIC LIST", items)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="ros2 doctor", description=_ABOUT)
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--report", "-r", action="store_true", help="Print all reports.")
    text = "Print reports of failed checks only."
    group.add_argument("--report-failed", "-rf", action="store_true", help=text)
    add = parser.add_argument
    text = "Exclude package checks or report."
    add("--exclude-packages", "-ep", action="store_true", help=text)
    text = "Include warnings as failed checks. Warnings are ignored by default."
    add("--include-warnings", "-iw", action="store_true", help=text)
    text = "hello: check communication between machines"
    add("verb", nargs="?", choices=("hello",), help=text)
    return parser


def _run(options: argparse.Namespace) -> int:
    if options.verb == "hello":
        print(_HELLO, file=sys.stderr)
        return 0
    sight = _look(with_packages=not options.exclude_packages)
    if options.report:
        _print_reports(_reports(sight))
        return 0
    results = _run_checks(sight)
    failed = [one for one in results if _has_failed(one, warnings=options.include_warnings)]
    for one in results:
        for text in one.errors:
            print(f"{one.category}: UserWarning: ERROR: {text}", file=sys.stderr)
        for text in one.warnings:
            print(f"{one.category}: UserWarning: {text}", file=sys.stderr)
    _print_verdict(len(results), failed)
    if options.report_failed and failed:
        categories = {one.category for one in failed}
        _print_reports(one for one in _reports(sight) if one.category in categories)
    _point_to_gazelle(sight)
    return 0


def _has_failed(result: _Result, *, warnings: bool) -> bool:
    return bool(result.errors or (warnings and result.warnings))


def _print_verdict(total: int, failed: list[_Result]) -> None:
    if failed:
        print(f"\n{len(failed)}/{total} check(s) failed\n")
        print("Failed modules:", *(one.category for one in failed))
    else:
        print(f"\nAll {total} checks passed\n")


def _print_reports(shown: Iterable[_Report]) -> None:
    for report in shown:
        print("\n  ", report.name)
        longest = max((len(name) for name, _ in report.items), default=0)
        width = longest + 4 if longest >= _MIN_WIDTH else _MIN_WIDTH
        for name, text in report.items:
            print(f"{name:{width}}: {text}")


def _point_to_gazelle(sight: _Sight) -> None:
    if sight.workspace is not None:
        print(
            "for what would go wrong in packages, robots, worlds and launch files: gazelle doctor",
            file=sys.stderr,
        )
