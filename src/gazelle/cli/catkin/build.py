"""``catkin build``."""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.catkin.config import summary
from gazelle.cli.catkin.profile import Profile, load_profile
from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.workspace.building.build import Outcome, run_jobs
from gazelle.workspace.building.catkin_space import build_catkin_package, write_space_scripts
from gazelle.workspace.building.packages import (
    BuildError,
    SourcePackage,
    find_packages,
    in_order,
    needed_by,
)

__all__ = ["run"]

_WIDTH = 40


def run(words: list[str]) -> int:
    """Build the packages named, or all."""
    options = _parser().parse_args([word for word in words[1:] if not word.startswith("-D")])
    pairs = (word[2:].partition("=") for word in words if word.startswith("-D"))
    definitions = {name.partition(":")[0]: value for name, _, value in pairs}
    profile = load_profile(options.workspace or Path.cwd(), may_make=True)
    begin = time.monotonic()
    print(summary(profile))
    everything, chosen = _packages(profile, options)
    took = time.monotonic() - begin
    print(f"[build] Found {len(everything)} packages in {took:.1f} seconds.", flush=True)
    outcomes: list[Outcome] = []

    def ended(outcome: Outcome) -> None:
        outcomes.append(outcome)
        _print_end(outcome)

    left = run_jobs(
        chosen,
        lambda item: build_catkin_package(
            item, profile.spaces, definitions, installs=profile.installs
        ),
        everything=everything,
        workers=options.jobs or os.cpu_count() or 1,
        started=lambda name: print(f"Starting  >>> {name}", flush=True),
        ended=ended,
        continue_on_error=options.continue_on_failure,
    )
    _write_spaces(profile)
    _print_summary(outcomes, left, time.monotonic() - begin)
    return 1 if any(outcome.code for outcome in outcomes) else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="catkin build", description="Builds a catkin workspace of Python and data packages."
    )
    add = parser.add_argument
    add("packages", nargs="*", metavar="PKGNAME", help="these packages and what they need")
    add("-w", "--workspace", type=Path, help="the workspace (the one around the current folder)")
    add("--this", action="store_true", help="the package around the current folder")
    add("--no-deps", action="store_true", help="only the packages named")
    add("-c", "--continue-on-failure", action="store_true", help="go on when a package fails")
    add("-j", "--jobs", type=int, help="how many packages at a time")
    add("--cmake-args", action="store_true", help="-DNAME=VALUE … follow")
    return parser


def _packages(
    profile: Profile, options: argparse.Namespace
) -> tuple[tuple[SourcePackage, ...], tuple[SourcePackage, ...]]:
    diagnostics = Diagnostics()
    source = profile.spaces.source
    if not source.is_dir():
        raise BuildError(f"the source space '{source}' does not exist")
    everything = in_order(find_packages([source], diagnostics))
    if len(diagnostics):
        render(diagnostics)
    names = list(options.packages)
    if options.this:
        here = Path.cwd()
        around = [item.name for item in everything if item.path in (here, *here.parents)]
        if not around:
            raise BuildError(f"--this: '{here}' is in no package of the workspace")
        names += around
    known = {item.name for item in everything}
    for name in names:
        if name not in known:
            hint = did_you_mean(name, known)
            text = f"Given package '{name}' is not in the workspace"
            raise BuildError(f"{text}; {hint}" if hint else text)
    wanted = set(names) if options.no_deps else needed_by(names, everything)
    return everything, tuple(item for item in everything if item.name in wanted or not names)


def _print_end(outcome: Outcome) -> None:
    if outcome.errors:
        lines = ["_" * 79, f"{'Errors' if outcome.code else 'Warnings'} << {outcome.name}"]
        print("\n".join([*lines, *outcome.errors, "." * 79]), file=sys.stderr, flush=True)
    words = "Failed    << " if outcome.code else "Finished  <<<"
    print(f"{words} {outcome.name:<{_WIDTH}} [ {outcome.duration_s:.1f} seconds ]", flush=True)


def _write_spaces(profile: Profile) -> None:
    spaces = profile.spaces
    try:
        spaces.build.mkdir(parents=True, exist_ok=True)
        (spaces.build / "CATKIN_IGNORE").touch()
        write_space_scripts(spaces.devel, (spaces.source,), os.environ)
        if profile.installs:
            write_space_scripts(spaces.install, (), os.environ)
    except OSError as error:
        raise BuildError(f"cannot write '{error.filename}': {error.strerror}") from error


def _print_summary(outcomes: Sequence[Outcome], left: Sequence[str], took_s: float) -> None:
    failed = [item.name for item in outcomes if item.code]
    good = len(outcomes) - len(failed)
    total = len(outcomes) + len(left)
    words = f"All {total} packages succeeded!" if good == total else (
        f"{good} of {total} packages succeeded.")  # fmt: skip
    warned = [item.name for item in outcomes if item.errors and not item.code]
    print(f"[build] Summary: {words}")
    for label, names in (("Warnings", warned), ("Abandoned", left), ("Failed", failed)):
        print(f"[build]   {label + ':':<11}{', '.join(names) or 'None.'}")
    print(f"[build] Runtime: {took_s:.1f} seconds total.", flush=True)
