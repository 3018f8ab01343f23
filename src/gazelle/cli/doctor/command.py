"""The command line: what is examined, and in which form the report is printed."""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING

from gazelle.cli.doctor.progress import progress
from gazelle.diagnostics import Severity
from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from gazelle.doctor import Report

__all__ = ["main"]

_NOTHING_EXAMINED = 2
_EPILOG = """what TARGET may be:
  PACKAGE or FOLDER      everything in it: manifest, launch files, robots, worlds, parameters
  FILE                   a robot (URDF, xacro, SDF), a world, model.config, YAML, a launch file
  PACKAGE FILE.launch    a launch, as roslaunch takes it; name:=value are its arguments
  nothing                the package or the workspace of the current folder

The report is read from its end: the last line counts, above it stand errors, then warnings.

exit code: 0 nothing worse than a notice, 1 warnings, 2 errors or no such target
"""


def main(argv: list[str]) -> int:
    """Examine a target and print the report."""
    parser = _parser()
    tokens = [word for word in argv if not _is_argument(word)]
    options = parser.parse_args(tokens)
    arguments = dict(word.split(":=", 1) for word in argv if _is_argument(word))
    from gazelle.doctor import Options, examine

    chosen = Options(arguments=arguments, probe=options.probe, world=options.world)
    start_s = time.perf_counter()
    if (options.fix or options.fix_all) and (options.json or options.sarif):
        parser.error("--fix prints a diff: it does not go with --json or --sarif")
    if options.yes and not (options.fix or options.fix_all):
        parser.error("--yes goes with --fix or --fix-all")
    try:
        if options.fix or options.fix_all:
            from gazelle.cli.doctor.fixing import fix

            only_certain = not options.fix_all
            return fix(options.target, chosen, only_certain=only_certain, is_agreed=options.yes)
        with progress() as say:
            report = examine(options.target, options=chosen, progress=say)
    except GazelleError as error:
        print(f"gazelle doctor: {error}", file=sys.stderr)
        return _NOTHING_EXAMINED
    _show(report, options, time.perf_counter() - start_s)
    return report.exit_code


def _show(report: Report, options: argparse.Namespace, seconds: float) -> None:
    least = Severity.WARNING if options.quiet else Severity[options.least.upper()]
    if options.json:
        from gazelle.cli.doctor.report_json import json_text

        print(json_text(report, least))
    elif options.sarif:
        from gazelle.cli.doctor.sarif import sarif_text

        print(sarif_text(report, least))
    else:
        from gazelle.cli.doctor.report_text import Level, print_report

        level = Level.FULL if options.verbose else Level.NORMAL
        level = Level.BRIEF if options.quiet and not options.verbose else level
        print_report(report, level=level, tables=options.tables, least=least, seconds=seconds)


def _is_argument(word: str) -> bool:
    return ":=" in word and not word.startswith("-")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle doctor",
        usage="gazelle doctor [options] [TARGET] [name:=value ...]",
        description="find what would go wrong before anything is started",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("target", nargs="*", metavar="TARGET", help="see below")
    form = parser.add_mutually_exclusive_group()
    form.add_argument(
        "--json", action="store_true", help="print the report as JSON, and nothing else"
    )
    form.add_argument(
        "--sarif", action="store_true", help="print SARIF 2.1.0 for code scanning and editors"
    )
    add("--fix", action="store_true", help="mend what is certain: shows a diff, then asks")
    add("--fix-all", action="store_true", help="what is one of several ways or an estimate, too")
    add("--yes", action="store_true", help="with --fix: write without asking")
    add("--probe", action="store_true", help="run short simulations too: drift, wheels, contacts")
    add("--world", default="empty", metavar="W", help="world for a robot on its own (empty)")
    add(
        "--least",
        choices=[str(item) for item in Severity],
        default=str(Severity.INFO),
        help="leave out findings below this severity",
    )
    add("--tables", action="store_true", help="all tables, for a package those of each launch too")
    add("-v", "--verbose", action="store_true", help="notices whole, what follows, and tables")
    add("-q", "--quiet", action="store_true", help="warnings and errors only, a line each")
    return parser
