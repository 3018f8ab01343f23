"""``colcon build``."""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.cli.colcon.events import Console, Log
from gazelle.cli.colcon.package_selection import (
    add_package_options,
    chosen_packages,
    parser_for,
    split_cmake_arguments,
)
from gazelle.cli.compile_step import compile_step_for
from gazelle.workspace.building.build import BuildOptions, Outcome, build_package, run_jobs
from gazelle.workspace.building.packages import BuildError, SourcePackage
from gazelle.workspace.building.setup_scripts import write_prefix_scripts

__all__ = ["run"]

_LAYOUT_FILE = ".colcon_install_layout"
# Options of the original that change nothing here: taken, and said to do nothing.
_WITHOUT_EFFECT = {
    "--cmake-clean-cache": 0,
    "--cmake-clean-first": 0,
    "--cmake-force-configure": 0,
    "--cmake-target": 1,
    "--cmake-target-skip-unavailable": 0,
    "--cmake-jobs": 1,
    "--catkin-skip-building-tests": 0,
}


def run(argv: list[str], log_base: Path) -> int:
    """Build a workspace."""
    begin = time.monotonic()
    parser = _parser()
    rest, cmake = split_cmake_arguments(parser, argv[1:])
    options = parser.parse_args(rest)
    _say_without_effect(options)
    everything, chosen = chosen_packages(options)
    if not everything:
        places = ", ".join(str(path.absolute()) for path in options.base_paths)
        print(f"colcon build: there is no package.xml below {places}", file=sys.stderr)
    build = BuildOptions(
        options.build_base.absolute(),
        options.install_base.absolute(),
        options.merge_install,
        options.symlink_install,
        _definitions(cmake),
    )
    _prepare(build)
    console = Console(options.event_handlers)
    log = Log(log_base if console.writes_log else Path("/dev/null"), "build")
    console.listed([item.name for item in chosen], [item.name for item in everything])
    left = _build_all(everything, chosen, build, options, console, log)
    write_prefix_scripts(build.install_base, merged=build.merged, environ=os.environ)
    console.summary(time.monotonic() - begin, left)
    return next((item.code for item in console.outcomes if item.code), 0)


def _build_all(
    everything: Sequence[SourcePackage],
    chosen: Sequence[SourcePackage],
    build: BuildOptions,
    options: argparse.Namespace,
    console: Console,
    log: Log,
) -> tuple[str, ...]:
    def ended(outcome: Outcome) -> None:
        console.ended(outcome)
        log.keep(outcome)

    step = compile_step_for(chosen, build.definitions, command="colcon build")
    # Others of the workspace that this run leaves as they are have been built before.
    prefixes = dict.fromkeys(build.prefix(package.name) for package in everything)
    build = replace(build, prefixes=tuple(prefixes))
    return run_jobs(
        chosen,
        lambda package: build_package(package, build, step),
        everything=everything,
        workers=1 if options.executor == "sequential" else options.parallel_workers,
        started=console.started,
        ended=ended,
        continue_on_error=options.continue_on_error,
    )


def _parser() -> argparse.ArgumentParser:
    parser = parser_for("build", "Build the packages of a workspace.")
    add = parser.add_argument
    add("--build-base", type=Path, default=Path("build"), help="where records go (build)")
    add("--install-base", type=Path, default=Path("install"), help="where packages go (install)")
    add("--merge-install", action="store_true", help="one prefix for all packages")
    add("--symlink-install", action="store_true", help="link to the sources, do not copy them")
    add("--continue-on-error", action="store_true", help="go on when a package fails")
    add("--executor", choices=("parallel", "sequential"), default="parallel")
    add("--parallel-workers", type=int, default=os.cpu_count() or 1, metavar="NUMBER")
    add("--event-handlers", nargs="*", default=[], metavar="NAME+|NAME-")
    add("--cmake-args", nargs="*", metavar="-DNAME=VALUE", help="variables for CMakeLists.txt")
    for name, count in _WITHOUT_EFFECT.items():
        if count:
            add(name, help=argparse.SUPPRESS)
        else:
            add(name, action="store_true", help=argparse.SUPPRESS)
    add_package_options(parser)
    return parser


def _say_without_effect(options: argparse.Namespace) -> None:
    given = [name for name in _WITHOUT_EFFECT if getattr(options, name[2:].replace("-", "_"), None)]
    if given:
        text = f"colcon build: {', '.join(given)} has no effect here"
        print(text, file=sys.stderr)


def _definitions(argv: Sequence[str]) -> Mapping[str, str]:
    """Return the variables of ``-DNAME=VALUE`` and ``-DNAME:TYPE=VALUE``."""
    found = {}
    for word in argv:
        name, is_set, value = word.removeprefix("-D").partition("=")
        if word.startswith("-D") and is_set:
            found[name.partition(":")[0]] = value
    return found


def _prepare(build: BuildOptions) -> None:
    """Make the folders, and refuse an install space of the other layout."""
    layout = "merged" if build.merged else "isolated"
    file = build.install_base / _LAYOUT_FILE
    there = file.read_text(encoding="utf-8").strip() if file.is_file() else layout
    if there != layout:
        other = "remove" if build.merged else "add"
        raise BuildError(
            f"The install directory '{build.install_base}' was created with the layout '{there}'. "
            "Please remove the install directory, pick a different one or "
            f"{other} the '--merge-install' option."
        )
    try:
        for folder in (build.build_base, build.install_base):
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "COLCON_IGNORE").touch()
        file.write_text(f"{layout}\n", encoding="utf-8")
    except OSError as error:
        raise BuildError(f"cannot write '{error.filename}': {error.strerror}") from error
