"""The command line of ``ros2 doctor``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from gazelle.cli.ros2.doctor.checks import Result, run_checks
from gazelle.cli.ros2.doctor.reports import Report, reports
from gazelle.cli.ros2.doctor.sight import Sight, look
from gazelle.cli.ros2.verbs import guarded

__all__ = ["main"]

_HELLO = (
    "hello: all nodes of the graph are on this machine; what ros2 doctor hello tries between "
    "machines has nothing to try"
)
_ABOUT = "Check ROS setup and other potential issues"
_MIN_WIDTH = 8


def main(argv: list[str]) -> int:
    """Run ``ros2 doctor``; its exit code is 0 also when checks fail, as the original's."""
    return guarded(lambda: _run(_parser().parse_args(argv)))


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
    sight = look(with_packages=not options.exclude_packages)
    if options.report:
        _print_reports(reports(sight))
        return 0
    results = run_checks(sight)
    failed = [one for one in results if _has_failed(one, warnings=options.include_warnings)]
    for one in results:
        for text in one.errors:
            print(f"{one.category}: UserWarning: ERROR: {text}", file=sys.stderr)
        for text in one.warnings:
            print(f"{one.category}: UserWarning: {text}", file=sys.stderr)
    _print_verdict(len(results), failed)
    if options.report_failed and failed:
        categories = {one.category for one in failed}
        _print_reports(one for one in reports(sight) if one.category in categories)
    _point_to_gazelle(sight)
    return 0


def _has_failed(result: Result, *, warnings: bool) -> bool:
    return bool(result.errors or (warnings and result.warnings))


def _print_verdict(total: int, failed: list[Result]) -> None:
    if failed:
        print(f"\n{len(failed)}/{total} check(s) failed\n")
        print("Failed modules:", *(one.category for one in failed))
    else:
        print(f"\nAll {total} checks passed\n")


def _print_reports(shown: Iterable[Report]) -> None:
    for report in shown:
        print("\n  ", report.name)
        longest = max((len(name) for name, _ in report.items), default=0)
        width = longest + 4 if longest >= _MIN_WIDTH else _MIN_WIDTH
        for name, text in report.items:
            print(f"{name:{width}}: {text}")


def _point_to_gazelle(sight: Sight) -> None:
    if sight.workspace is not None:
        print(
            "for what would go wrong in packages, robots, worlds and launch files: gazelle doctor",
            file=sys.stderr,
        )
