"""``catkin_make``: a devel space, and an install space."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.compile_step import compile_step_for
from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.workspace.building.build import Outcome
from gazelle.workspace.building.catkin_space import (
    CatkinSpaces,
    build_catkin_package,
    write_space_scripts,
)
from gazelle.workspace.building.packages import (
    BuildError,
    SourcePackage,
    find_packages,
    in_order,
    needed_by,
)

__all__ = ["main"]

_RULE = "-- " + "~" * 49
_TARGETS = ("all", "install")
_WITHOUT_EFFECT = ("use_ninja", "use_nmake", "force_cmake", "no_color", "verbose", "make_args")


def main(argv: list[str]) -> int:
    """Build the workspace in the current folder."""
    options, targets, definitions = _read(argv)
    base = options.directory.absolute()
    spaces = CatkinSpaces(
        (base / (options.source or "src")).absolute(),
        (base / (options.build or "build")).absolute(),
        Path(definitions.get("CATKIN_DEVEL_PREFIX", base / "devel")).absolute(),
        Path(definitions.get("CMAKE_INSTALL_PREFIX", base / "install")).absolute(),
    )
    _check(base, spaces)
    for tokens, folder in zip(("Source", "Build", "Devel", "Install"), spaces, strict=True):
        print(f"{tokens} space: {folder}" if tokens != "Source" else
              f"Base path: {base}\nSource space: {folder}")  # fmt: skip
    everything, packages = _packages(spaces, options, definitions)
    outcomes = _build(
        packages, everything, spaces, definitions, installs="install" in targets, jobs=options.jobs
    )
    failed = [outcome for outcome in outcomes if outcome.code]
    if any(outcome.output for outcome in failed):
        # It came as far as the compiler.
        print('Invoking "make" failed', file=sys.stderr)
        return 1
    if failed:
        print("-- Configuring incomplete, errors occurred!")
        print('Invoking "cmake" failed', file=sys.stderr)
        return 1
    print(f"-- Configuring done\n-- Generating done\n-- Build files are in: {spaces.build}")
    if "install" in targets:
        print('Install the project...\n-- Install configuration: ""')
        print("\n".join(line for outcome in outcomes for line in outcome.output))
    return 0


def _read(argv: Sequence[str]) -> tuple[argparse.Namespace, list[str], dict[str, str]]:
    """Return options, targets and CMake's variables; these may stand anywhere, as ``-DNAME=…``."""
    parser = argparse.ArgumentParser(prog="catkin_make", description="Builds a catkin workspace.")
    add = parser.add_argument
    add("-C", "--directory", type=Path, default=Path(), help="the workspace (current folder)")
    add("--source", help="source space (src)")
    add("--build", help="build space (build)")
    add("--pkg", nargs="+", default=[], help="only these packages")
    add("--only-pkg-with-deps", nargs="+", default=[], help="these packages and what they need")
    add("-j", "--jobs", nargs="?", type=int, const=0, default=0, help="compilers at a time")
    add("-l", "--load-average", nargs="?", help=argparse.SUPPRESS)
    add("--cmake-args", action="store_true", help="-DNAME=VALUE … follow")
    for name in _WITHOUT_EFFECT:
        add("--" + name.replace("_", "-"), action="store_true", help=argparse.SUPPRESS)
    add("targets", nargs="*", help="all, install")
    tokens = [word for word in argv if not word.startswith("-D")]
    pairs = (word[2:].partition("=") for word in argv if word.startswith("-D"))
    definitions = {name.partition(":")[0]: value for name, _, value in pairs}
    options = parser.parse_intermixed_args(tokens)
    unknown = [name for name in options.targets if name not in _TARGETS]
    if unknown:
        hint = did_you_mean(unknown[0], _TARGETS) or f"there are {', '.join(_TARGETS)}"
        parser.error(f"No rule to make target '{unknown[0]}'; {hint}")
    given = [name for name in (*_WITHOUT_EFFECT, "load_average") if getattr(options, name)]
    if given:
        listed = ", ".join("--" + name.replace("_", "-") for name in given)
        print(f"catkin_make: {listed} has no effect here", file=sys.stderr)
    return options, options.targets, definitions


def _check(base: Path, spaces: CatkinSpaces) -> None:
    if (base / "package.xml").is_file():
        raise BuildError(
            f'The specified base path "{base}" contains a package but "catkin_make" must be '
            "invoked in the root of workspace"
        )
    if not spaces.source.is_dir():
        raise BuildError(f'The specified source space "{spaces.source}" does not exist')


def _packages(
    spaces: CatkinSpaces, options: argparse.Namespace, definitions: dict[str, str]
) -> tuple[tuple[SourcePackage, ...], tuple[SourcePackage, ...]]:
    """Return all packages of the workspace, and those to build, in order."""
    diagnostics = Diagnostics()
    found = in_order(find_packages([spaces.source], diagnostics))
    if len(diagnostics):
        render(diagnostics)
    foreign = [item.name for item in found if item.build_type != "catkin"]
    if foreign:
        raise BuildError(
            "This workspace contains non-catkin packages in it, and catkin cannot build a "
            f"non-homogeneous workspace without isolation: {', '.join(foreign)}; 'colcon build' "
            "builds them all, or put CATKIN_IGNORE into their folders"
        )
    known = {item.name for item in found}
    wanted = [*options.pkg, *options.only_pkg_with_deps]
    for name in wanted:
        if name not in known:
            hint = did_you_mean(name, known)
            raise BuildError(f"Packages {name} not found in the workspace; {hint}".rstrip("; "))
    names = set(options.pkg) | needed_by(options.only_pkg_with_deps, found) if wanted else known
    white = set(filter(None, definitions.get("CATKIN_WHITELIST_PACKAGES", "").split(";")))
    black = set(definitions.get("CATKIN_BLACKLIST_PACKAGES", "").split(";"))
    return found, tuple(
        item for item in found
        if item.name in names and item.name not in black and (not white or item.name in white)
    )  # fmt: skip


def _build(
    packages: Sequence[SourcePackage],
    everything: Sequence[SourcePackage],
    spaces: CatkinSpaces,
    definitions: dict[str, str],
    *,
    installs: bool,
    jobs: int,
) -> list[Outcome]:
    print(f"{_RULE}\n-- ~~  traversing {len(packages)} packages in topological order:")
    print("".join(f"-- ~~  - {item.name}\n" for item in packages) + _RULE, flush=True)
    outcomes = []
    step = compile_step_for(packages, definitions, command="catkin_make", said=_say, jobs=jobs)
    try:
        for item in packages:
            print(f"-- +++ processing catkin package: '{item.name}'")
            print(f"-- ==> add_subdirectory({item.path.relative_to(spaces.source)})", flush=True)
            outcomes.append(
                build_catkin_package(
                    item,
                    spaces,
                    definitions,
                    installs=installs,
                    compile_step=step,
                    workspace=everything,
                )
            )
            if outcomes[-1].errors:
                print("\n".join(outcomes[-1].errors), file=sys.stderr, flush=True)
        spaces.build.mkdir(parents=True, exist_ok=True)
        (spaces.build / "CATKIN_IGNORE").touch()
        (spaces.source.parent / ".catkin_workspace").touch()
        write_space_scripts(spaces.devel, (spaces.source,), os.environ)
        if installs:
            write_space_scripts(spaces.install, (), os.environ)
    except OSError as error:
        raise BuildError(f"cannot write '{error.filename}': {error.strerror}") from error
    return outcomes


def _say(line: str) -> None:
    print(line, flush=True)
