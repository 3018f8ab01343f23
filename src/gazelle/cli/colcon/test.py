"""``colcon test`` and ``colcon test-result``: the Python tests of packages."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.colcon.events import Console, Log
from gazelle.cli.colcon.package_selection import add_package_options, chosen_packages, parser_for
from gazelle.cli.colcon.results import read_results
from gazelle.cli.colcon.testing import package_environment, test_package
from gazelle.workspace.building.build import Outcome, run_jobs

__all__ = ["run"]


def run(words: list[str], log_base: Path) -> int:
    """Run the verb that the first word names."""
    return _test(words[1:], log_base) if words[0] == "test" else _result(words[1:])


def _test(words: Sequence[str], log_base: Path) -> int:
    begin = time.monotonic()
    parser = parser_for("test", "Run the Python tests of packages.")
    add = parser.add_argument
    add("--build-base", type=Path, default=Path("build"), help="where results go (build)")
    add("--install-base", type=Path, default=Path("install"), help="where packages are (install)")
    add("--return-code-on-test-failure", action="store_true", help="end with 1 when a test fails")
    add("--parallel-workers", type=int, default=os.cpu_count() or 1, metavar="NUMBER")
    add("--event-handlers", nargs="*", default=[], metavar="NAME+|NAME-")
    add("--pytest-args", nargs="*", default=[], metavar="ARG", help="arguments for pytest")
    add_package_options(parser)
    options = parser.parse_args(words)
    everything, chosen = chosen_packages(options)
    console = Console(options.event_handlers)
    log = Log(log_base if console.writes_log else Path("/dev/null"), "test")
    environ = package_environment(options.install_base.absolute(), os.environ)

    def ended(outcome: Outcome) -> None:
        console.ended(outcome)
        log.keep(outcome)

    left = run_jobs(
        chosen,
        lambda item: test_package(
            item, options.build_base.absolute() / item.name, environ, options.pytest_args
        ),
        everything=everything,
        workers=options.parallel_workers,
        started=console.started,
        ended=ended,
        continue_on_error=True,
    )
    failed = [name for name in (item.name for item in chosen)
              if read_results(options.build_base / name)[0].is_bad]  # fmt: skip
    console.summary(time.monotonic() - begin, left)
    if failed:
        count = "1 package" if len(failed) == 1 else f"{len(failed)} packages"
        print(f"  {count} had test failures: {' '.join(failed)}")
    bad = any(outcome.code for outcome in console.outcomes)
    return 1 if bad or (failed and options.return_code_on_test_failure) else 0


def _result(words: Sequence[str]) -> int:
    parser = parser_for("test-result", "Show a summary of test results.")
    parser.add_argument("--test-result-base", type=Path, default=Path("build"))
    parser.add_argument("--all", action="store_true", help="files without failures too")
    parser.add_argument("--verbose", action="store_true", help="what failed")
    options = parser.parse_args(words)
    if not options.test_result_base.is_dir():
        print(f"the test result base '{options.test_result_base}' does not exist", file=sys.stderr)
        return 1
    total, files = read_results(options.test_result_base)
    for file, counts, failures in files:
        if counts.is_bad or options.all:
            print(f"{os.path.relpath(file)}: {counts}")
        for text in failures if options.verbose else ():
            print(f"- {text}")
    if files and (total.is_bad or options.all):
        print()
    print(f"Summary: {total}")
    return 1 if total.is_bad else 0
